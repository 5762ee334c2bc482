// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How SIMD lanes run a sweep: tile by tile, offset by offset.
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
    using real = lanes;  ///< what it computes with

    static constexpr extent usual_tile{128, 64};
    extent largest_tile = usual_tile;

    static constexpr int group = offset_group::largest;

    template <class Sweep>
    extent tile_size(const Sweep& sweep, const sweep_buffers& buffers) const {
        // Where little around a tile is staged with it, a flat one keeps more of its sums in the near caches.
        const bool flat = largest_tile == usual_tile && winnow::margin(sweep, buffers.size) <= 4;
        const extent wanted = flat ? extent{256, 16} : largest_tile;
        const int width = detail::ceil_div(std::max(1, buffers.size.width), lanes::size) * lanes::size;
        const int largest = detail::ceil_div(std::max(1, wanted.width), lanes::size) * lanes::size;
        return {std::min(largest, width), std::max(1, std::min(wanted.height, buffers.size.height))};
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
        float* const behind = memory.planes + memory.step.row * staged.region.size().height;
        std::fill(behind, behind + lanes::size + group * window_step(sweep), 0.0f);
        std::fill(memory.sums, memory.sums + memory.sums_count, 0.0f);

        const auto ahead = patches_of(sweep, buffers, memory.tile);
        const auto shared = shared_of(sweep);
        const offset_weights of_offset(shared.weights());
        const int values = static_cast<int>(buffers.values.size());
        const int reach = window_reach(sweep, buffers.size);
        for (int f = 0; f < buffers.frames; ++f) {
            const std::ptrdiff_t to_frame = f * planes_of_frame<Sweep>(buffers) * memory.step.plane;
            for (int dy = -reach; dy <= reach; ++dy) {
                const window_row row = row_of_window(sweep, buffers.size, dy);
                const int groups = detail::ceil_div(row.count, group);
                for (int g = 0; g < groups; ++g) {
                    const int begin = row.count * g / groups, end = row.count * (g + 1) / groups;
                    const offset_group offsets{row.first + begin * row.step, end - begin, row.step, dy, to_frame};
                    ahead.start(tile, offsets, memory.patches);
                    const auto table = of_offset.template table<lanes>(offsets);
                    for (int y = tile.y0; y < tile.y1; ++y) {
                        ahead.row(staged, tile, offsets, y, memory.patches);
                        accumulate(sweep, shared, of_offset, table, values, memory, staged, tile, offsets, y, ahead);
                    }
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
        // Behind the last row there is room for a last batch and a last group.
        m.planes = take(m.step.row * (m.tile.height + 2 * m.margin) + lanes::size + group * window_step(sweep));
        m.sums_count = std::ptrdiff_t{Sweep::count * sums_of_weight<Sweep>(values)} * m.tile.width * m.tile.height;
        m.sums = take(m.sums_count);
        m.patches = take(ahead.floats());
        m.bytes = offset;
        return m;
    }

    template <class Sweep>
    static auto shared_of(const Sweep& sweep) {
        using varied = varied_in<Sweep>;
        const auto weights = detail::look_up_all<detail::is_patch, varied>(sweep.weights);
        return shared_distances<varied, std::remove_const_t<decltype(weights)>>(weights,
                                                                                prepared_patches_of<Sweep>::places);
    }
    template <class Sweep>
    static prepared_patches_of<Sweep> patches_of(const Sweep& sweep, const sweep_buffers& buffers, extent tile) {
        return {detail::collect_all<detail::is_patch>(sweep.weights), buffers.size, tile, sweep.rule,
                decltype(shared_of(sweep))::count};
    }

    /// Whether weight k changes with the buffer of the derivative.
    template <class Sweep, int K>
    static constexpr bool varies =
        detail::varies_with<std::tuple_element_t<K, decltype(Sweep::weights)>, varied_in<Sweep>>;
    /// The sums of one weight: w, then w u of each value, then, where derivatives are wanted, dw and dw u + w(p,p) of
    /// each channel, then those of the estimator.
    template <class Sweep>
    static int sums_of_weight(int values) {
        return 1 + values + 2 * detail::channels_of<varied_in<Sweep>> + sums_in<Sweep>;
    }

    /// Whether any does.
    template <class Sweep>
    static constexpr bool any_varies = []<int... K>(std::integer_sequence<int, K...>) {
        return (varies<Sweep, K> || ...);
    }
    (std::make_integer_sequence<int, Sweep::count>{});

    /// Adds the neighbours at the offsets to the sums of row y.
    template <class Sweep, class Shared, class OfOffset, class Table, class Ahead>
    static void accumulate(const Sweep& sweep, const Shared& shared, const OfOffset& of_offset, const Table& table,
                           int values, const parts& memory, const staged_tile& staged, rectangle tile,
                           offset_group offsets, int y, const Ahead& ahead) {
        using reads = typename Sweep::reads;
        using varied = varied_in<Sweep>;
        constexpr int channels = detail::channels_of<varied>;
        const std::ptrdiff_t next = std::ptrdiff_t{memory.tile.width} * memory.tile.height, plane = memory.step.plane;
        const int centre = offsets.centre();
        for (int x = 0; x < tile.x1 - tile.x0; x += lanes::size) {
            const float* p = staged.at(0, tile.x0 + x, y);
            const float* q = offsets.q(p, staged.step);
            const auto pair = [&]<class Real>(std::type_identity<Real>, int i) WINNOW_HD_LAMBDA {
                return pixel_pair<Real, reads>(
                    p, q + i * offsets.step, staged.step, offsets.dx(i), offsets.dy,
                    prepared{ahead.at(memory.patches, i, x), ahead.width(), table[static_cast<std::size_t>(i)].data()});
            };
            // Both at once, because terms are often made of the same parts as distances, and stored last: stores would
            // keep what depends on p alone from being computed once.
            constexpr int terms = sums_in<Sweep>;
            lanes distances[Shared::count + 1][group], term[terms + 1][group];
            for (int i = 0; i < offsets.size(); ++i) {
                shared.for_each([&](int place, const auto& distance) WINNOW_HD_LAMBDA {
                    distances[place - Ahead::places][i] = distance(pair(std::type_identity<lanes>{}, i));
                });
                if constexpr (terms > 0) {
                    lanes of_pair[terms];
                    sweep.estimator.terms(pair(std::type_identity<lanes>{}, i), of_pair);
                    const lanes covered = lanes::load(q + i * offsets.step);
                    for (int k = 0; k < terms; ++k) term[k][i] = of_pair[k] * covered;
                }
            }
            shared.for_each([&](int place, const auto&) WINNOW_HD_LAMBDA {
                for (int i = 0; i < offsets.size(); ++i)
                    distances[place - Ahead::places][i].store(ahead.at(memory.patches, i, x) + place * ahead.width());
            });

            lanes w[Sweep::count][group], dw[channels + 1][Sweep::count][group];
            float* sums[Sweep::count];
            detail::for_each_node(of_offset.weights(), [&](const auto& weight, auto k) WINNOW_HD_LAMBDA {
                sums[k] =
                    memory.sums + k * sums_of_weight<Sweep>(values) * next + (y - tile.y0) * memory.tile.width + x;
                for (int i = 0; i < offsets.size(); ++i)
                    if constexpr (varies<Sweep, k>) {
                        const auto varying = weight(pair(std::type_identity<differential<lanes, varied>>{}, i));
                        w[k][i] = varying.value();
                        // A pixel's weight for itself is the same whatever its value.
                        for (int c = 0; c < channels; ++c) dw[c][k][i] = i == centre ? lanes(0.0f) : varying.slope(c);
                    } else {
                        w[k][i] = weight(pair(std::type_identity<lanes>{}, i));
                        for (int c = 0; c < channels; ++c) dw[c][k][i] = lanes(0.0f);
                    }
                // A group that is not full goes on with weights of 0.
                for (int i = offsets.size(); i < group; ++i) {
                    w[k][i] = lanes(0.0f);
                    for (int c = 0; c < channels; ++c) dw[c][k][i] = lanes(0.0f);
                }
            });

            const float* const value = q + (1 + reads::count) * plane;
            const auto add_plane = [&](const auto& weights, const float* u, std::ptrdiff_t to) WINNOW_HD_LAMBDA {
                add(
                    weights, [&](int i) WINNOW_HD_LAMBDA { return lanes::load(u + i * offsets.step); }, sums,
                    to * next);
            };
            add_plane(w, q, 0);  // the coverage: only neighbours that exist count
            for (int v = 0; v < values; ++v) add_plane(w, value + v * plane, 1 + v);
            for (int c = 0; c < (any_varies<Sweep> ? channels : 0); ++c) {
                add_plane(dw[c], q, 1 + values + 2 * c);
                add_plane(dw[c], value + c * plane, 2 + values + 2 * c);
            }
            for (int k = 0; k < terms; ++k) {
                for (int i = offsets.size(); i < group; ++i) term[k][i] = lanes(0.0f);
                add(
                    w, [&](int i) WINNOW_HD_LAMBDA { return term[k][i]; }, sums,
                    (1 + values + 2 * channels + k) * next);
            }
            if constexpr (channels > 0)
                if (centre >= 0)
                    for (int k = 0; k < Sweep::count; ++k)
                        for (int c = 0; c < channels; ++c) {
                            float* const to = sums[k] + (2 + values + 2 * c) * next;
                            (lanes::load(to) + w[k][centre]).store(to);
                        }
        }
    }

    /// Of each weight k:  sums[k] += w[k][0] u(0) + w[k][1] u(1) + ..., a whole group.
    template <int Weights, class Value>
    WINNOW_HD static void add(const lanes (&w)[Weights][group], const Value& u, float* const (&sums)[Weights],
                              std::ptrdiff_t plane) {
        lanes s[Weights];
        for (int k = 0; k < Weights; ++k) s[k] = lanes::load(sums[k] + plane);
        for (int i = 0; i < group; ++i) {
            const lanes x = u(i);
            for (int k = 0; k < Weights; ++k) s[k] = lanes::fma(w[k][i], x, s[k]);
        }
        for (int k = 0; k < Weights; ++k) s[k].store(sums[k] + plane);
    }

    /// One row of one weight's sums; see write_row.
    template <class Sweep, class Weight>
    struct row {
        const Weight& weight;
        const staged_tile& staged;
        const float* sums;
        std::ptrdiff_t next;
        int values, x0, y;

        float at(int plane, int x) const { return sums[plane * next + x - x0]; }
        float sum(int k, int x) const { return at(1 + values + 2 * detail::channels_of<varied_in<Sweep>> + k, x); }
        auto pixel(int x) const {
            return pixel_pair<float, typename Sweep::reads>(staged.at(0, x, y), staged.at(0, x, y), staged.step, 0, 0);
        }
        float support(int x) const { return at(0, x); }
        float filtered(int v, int x) const {
            const float total = support(x);
            return total > no_weight ? at(1 + v, x) / total : input(v, x);
        }
        float derivative(int c, int x) const {
            const float total = support(x);
            if (!(total > no_weight)) return 1;
            return (at(2 + values + 2 * c, x) - filtered(c, x) * at(1 + values + 2 * c, x)) / total;
        }
        float input(int v, int x) const { return *staged.at(1 + Sweep::reads::count + v, x, y); }
        float variance(int c, int x) const {
            return *staged.at(1 + slot_of<variance_of<varied_in<Sweep>>>(typename Sweep::reads{}) + c, x, y);
        }
    };

    template <class Sweep>
    static void finish(const Sweep& sweep, const sweep_buffers& buffers, const parts& memory, const staged_tile& staged,
                       rectangle tile) {
        const int values = static_cast<int>(buffers.values.size());
        const std::ptrdiff_t next = std::ptrdiff_t{memory.tile.width} * memory.tile.height;
        detail::for_each_node(sweep.weights, [&](const auto& weight, auto k) {
            for (int y = tile.y0; y < tile.y1; ++y)
                write_row(buffers, sweep.estimator, k, tile, y,
                          row<Sweep, std::remove_cvref_t<decltype(weight)>>{
                              weight, staged,
                              memory.sums + k * sums_of_weight<Sweep>(values) * next +
                                  (y - tile.y0) * std::ptrdiff_t{memory.tile.width},
                              next, values, tile.x0, y});
        });
    }
};

}  // namespace winnow::executor
