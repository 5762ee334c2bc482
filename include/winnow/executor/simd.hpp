// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// SIMD lanes, tile by tile, offset by offset.
#include <winnow/executor/concept.hpp>
#include <winnow/executor/finish.hpp>
#include <winnow/executor/lanes.hpp>
#include <winnow/executor/patches.hpp>

namespace winnow::executor {

/// The schedule, for one tile in the cache:
///     for each row of offsets, a few offsets at a time
///         for each row of pixels
///             work out the patch distances at these offsets                                      (patches.hpp)
///             for each batch of pixels: the weights at these offsets, then all sums of w and of w u
/// What depends on p alone is computed once for all offsets of a group, each sum is kept in a register over them, and a
/// row of pixels with its neighbours stays in the first cache.
/// Each pixel meets its neighbours in the same order whatever the tile: the bits do not depend on tiles or threads.
struct offset_major {
    extent largest_tile{128, 64};

    /// Offsets per group; each takes a register for its weight.
    static constexpr int group = 8;

    template <class Sweep>
    extent tile_size(const Sweep&, const sweep_buffers& buffers) const {
        const int width = detail::ceil_div(std::max(1, buffers.size.width), lanes::size) * lanes::size;
        const int largest = detail::ceil_div(std::max(1, largest_tile.width), lanes::size) * lanes::size;
        return {std::min(largest, width), std::max(1, std::min(largest_tile.height, buffers.size.height))};
    }

    template <class Sweep>
    std::size_t scratch_bytes(const Sweep& sweep, const sweep_buffers& buffers) const {
        return memory_of(sweep, buffers, nullptr).bytes;
    }

    template <class Sweep>
    void operator()(const Sweep& sweep, const sweep_buffers& buffers, rectangle tile, std::byte* scratch) const {
        const auto memory = memory_of(sweep, buffers, scratch);
        const staged_tile staged{tile.grown(memory.margin), memory.planes, memory.step};
        stage(sweep, buffers, staged);
        std::fill(memory.sums, memory.sums + memory.sums_count, 0.0f);

        const auto ahead = patches_of(sweep, buffers, memory.tile);
        const auto weights = detail::without_patches(sweep.weights);
        const int values = static_cast<int>(buffers.values.size());
        const int reach = window_reach(sweep, buffers.size);
        for (int dy = -reach; dy <= reach; ++dy) {
            const int half = window_half_width(sweep, buffers.size, dy);
            const int groups = detail::ceil_div(2 * half + 1, group);
            for (int g = 0; g < groups; ++g) {
                const offset_group offsets{-half + (2 * half + 1) * g / groups,
                                           -half + (2 * half + 1) * (g + 1) / groups, dy};
                ahead.start(tile, offsets, memory.patches);
                for (int y = tile.y0; y < tile.y1; ++y) {
                    ahead.row(staged, tile, offsets, y, memory.patches);
                    accumulate<Sweep>(weights, values, memory, staged, tile, offsets, y, ahead);
                }
            }
        }
        finish(sweep, buffers, memory, staged, tile);
    }

private:
    /// The parts of the scratch memory; nothing is read behind a null base.
    struct parts {
        extent tile;
        int margin;
        pitch step;
        float* planes;
        float* sums;
        std::ptrdiff_t sums_count;
        float* patches;
        std::size_t bytes;
    };

    template <class Sweep>
    parts memory_of(const Sweep& sweep, const sweep_buffers& buffers, std::byte* base) const {
        parts m;
        m.tile = tile_size(sweep, buffers);
        const auto ahead = patches_of(sweep, buffers, m.tile);
        m.margin = std::max(winnow::margin(sweep, buffers.size), window_reach(sweep, buffers.size) + ahead.reach());
        const int values = static_cast<int>(buffers.values.size());
        // A batch may start at the last pixel of the region.  Rows an odd number of cache lines apart spread over the
        // sets of the cache.
        const std::ptrdiff_t line = scratch_memory::alignment / sizeof(float);
        m.step.plane = detail::ceil_div(m.tile.width + 2 * m.margin + lanes::size, line) * line;
        m.step.row = m.step.plane * staged_planes<Sweep>(buffers);
        if (m.step.row / line % 2 == 0) m.step.row += line;
        std::size_t offset = 0;
        const auto take = [&](std::size_t count) {
            float* part = base ? reinterpret_cast<float*>(base + offset) : nullptr;  // a plan has no memory
            offset += detail::aligned(sizeof(float) * count);
            return part;
        };
        m.planes = take(m.step.row * (m.tile.height + 2 * m.margin) + lanes::size);
        m.sums_count = static_cast<std::ptrdiff_t>(Sweep::count) * (1 + values) * m.tile.width * m.tile.height;
        m.sums = take(m.sums_count);
        m.patches = take(ahead.floats());
        m.bytes = offset;
        return m;
    }

    template <class Sweep>
    static prepared_patches_of<Sweep> patches_of(const Sweep& sweep, const sweep_buffers& buffers, extent tile) {
        return {detail::patches_in(sweep.weights), buffers.size, tile, group, sweep.rule};
    }

    /// Adds the neighbours at the offsets to the sums of row y.
    template <class Sweep, class Weights, class Ahead>
    static void accumulate(const Weights& weights, int values, const parts& memory, const staged_tile& staged,
                           rectangle tile, offset_group offsets, int y, const Ahead& ahead) {
        using reads = typename Sweep::reads;
        for (int x = 0; x < tile.x1 - tile.x0; x += lanes::size) {
            const float* p = staged.at(0, tile.x0 + x, y);
            const float* q = p + offsets.first + offsets.dy * staged.step.row;
            float* sum = memory.sums + (y - tile.y0) * memory.tile.width + x;
            const auto add = [&](const auto& weight) {
                lanes w[group];
                for (int i = 0; i < offsets.size(); ++i)
                    w[i] = weight(pixel_pair<lanes, reads>(p, q + i, staged.step, offsets.first + i, offsets.dy,
                                                           ahead.at(memory.patches, i, x)));
                sum = add_neighbours(w, offsets.size(), q, reads::count, values, memory, sum);
            };
            std::apply([&](const auto&... weight) { (add(weight), ...); }, weights);
        }
    }

    /// Adds count weights to the sum of weights, and the weighted values to theirs; returns where the next sums lie.
    static float* add_neighbours(const lanes* w, int count, const float* q, int guides, int values, const parts& memory,
                                 float* sum) {
        float* end = sum;
        [&]<int... Less>(std::integer_sequence<int, Less...>) {
            ((count == Less + 1 ? void(end = add_exactly<Less + 1>(w, q, guides, values, memory, sum)) : void()), ...);
        }
        (std::make_integer_sequence<int, group>{});
        return end;
    }
    template <int Count>
    static float* add_exactly(const lanes* w, const float* q, int guides, int values, const parts& memory, float* sum) {
        lanes weight[Count];  // a copy that no store can alias: it stays in registers
        for (int i = 0; i < Count; ++i) weight[i] = w[i];
        const std::ptrdiff_t next = std::ptrdiff_t{memory.tile.width} * memory.tile.height, plane = memory.step.plane;
        const float* u = q;  // the coverage: only neighbours that exist count
        for (int v = -1; v < values; ++v, sum += next, u = q + (1 + guides + v) * plane) {
            lanes s = lanes::load(sum);
            for (int i = 0; i < Count; ++i) s = lanes::fma(weight[i], lanes::load(u + i), s);
            s.store(sum);
        }
        return sum;
    }

    template <class Sweep>
    static void finish(const Sweep& sweep, const sweep_buffers& buffers, const parts& memory, const staged_tile& staged,
                       rectangle tile) {
        const int values = static_cast<int>(buffers.values.size());
        const std::ptrdiff_t next = memory.tile.width * memory.tile.height;
        for (int k = 0; k < Sweep::count; ++k)
            for (int y = tile.y0; y < tile.y1; ++y) {
                float* sums = memory.sums + k * (1 + values) * next + (y - tile.y0) * memory.tile.width;
                const auto input = [&](int v, int x) { return *staged.at(1 + Sweep::reads::count + v, x, y); };
                write_row(
                    buffers, sweep.estimator, k, tile, y,
                    [&](int v, int x) {
                        const float total = sums[x - tile.x0];
                        return total > no_weight ? sums[(1 + v) * next + x - tile.x0] / total : input(v, x);
                    },
                    input);
            }
    }
};

/// One thread, all its lanes.
struct simd {
    using role = role::executor;
    extent tile{128, 64};  ///< pixels worked on at a time: a matter of cache, never of results

    offset_major kernel() const { return {tile}; }
    int workers() const { return 1; }
    template <class Work>
    void dispatch(int count, const Work& work) const {
        for (int i = 0; i < count; ++i) work(i);
    }
};
static_assert(executor_policy<simd>);

}  // namespace winnow::executor
