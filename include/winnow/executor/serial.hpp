// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The definition: pixel by pixel, neighbour by neighbour, as the formula stands.
#include <winnow/executor/concept.hpp>
#include <winnow/executor/finish.hpp>

namespace winnow::executor {

/// For each pixel p and each weight w of the sweep:  F(p) = sum_q w(p,q) u(q) / sum_q w(p,q), in Real arithmetic.
template <class Real>
struct pixel_major {
    int tile_rows = 16;  ///< rows that are staged at a time

    template <class Sweep>
    extent tile_size(const Sweep&, const sweep_buffers& buffers) const {
        return {std::max(1, buffers.size.width), tile_rows};
    }

    template <class Sweep>
    std::size_t scratch_bytes(const Sweep& sweep, const sweep_buffers& buffers) const {
        const extent tile = tile_size(sweep, buffers);
        const extent region = rectangle{0, 0, tile.width, tile.height}.grown(margin(sweep, buffers.size)).size();
        return detail::aligned(sizeof(float) * region.pixels() * staged_planes<Sweep>(buffers)) +
               sizeof(Real) * buffers.values.size() * tile.width;
    }

    template <class Sweep>
    void operator()(const Sweep& sweep, const sweep_buffers& buffers, rectangle tile, std::byte* scratch) const {
        const rectangle region = tile.grown(margin(sweep, buffers.size));
        const int planes = staged_planes<Sweep>(buffers), values = static_cast<int>(buffers.values.size());
        const staged_tile staged{region,
                                 reinterpret_cast<float*>(scratch),
                                 {region.size().width, std::ptrdiff_t{region.size().width} * planes}};
        stage(sweep, buffers, staged);
        Real* filtered =
            reinterpret_cast<Real*>(scratch + detail::aligned(sizeof(float) * region.size().pixels() * planes));

        const auto value = [&](int v, int x, int y) { return *staged.at(1 + Sweep::reads::count + v, x, y); };
        const auto filter_pixel = [&](const auto& weight, int x, int y, Real* sums) {
            using pair = pixel_pair<Real, typename Sweep::reads>;
            Real total = 0;
            std::fill(sums, sums + values, Real(0));
            const int reach = window_reach(sweep, buffers.size);
            for (int dy = -reach; dy <= reach; ++dy) {
                const int half = window_half_width(sweep, buffers.size, dy);
                for (int dx = -half; dx <= half; ++dx) {
                    const float* q = staged.at(0, x + dx, y + dy);
                    if (*q == 0) continue;  // no pixel there
                    const Real w = weight(pair(staged.at(0, x, y), q, staged.step, dx, dy));
                    total += w;
                    for (int v = 0; v < values; ++v) sums[v] += w * Real(value(v, x + dx, y + dy));
                }
            }
            for (int v = 0; v < values; ++v) sums[v] = total > Real(no_weight) ? sums[v] / total : Real(value(v, x, y));
        };

        int index = 0;
        const auto filter_all = [&](const auto& weight) {
            for (int y = tile.y0; y < tile.y1; ++y) {
                for (int x = tile.x0; x < tile.x1; ++x) filter_pixel(weight, x, y, filtered + values * (x - tile.x0));
                write_row(
                    buffers, sweep.estimator, index, tile, y,
                    [&](int v, int x) { return static_cast<float>(filtered[values * (x - tile.x0) + v]); },
                    [&](int v, int x) { return value(v, x, y); });
            }
            ++index;
        };
        std::apply([&](const auto&... weight) { (filter_all(weight), ...); }, sweep.weights);
    }
};

/// One thread, no tricks.  serial<double> is what every other executor is tested against.
template <class Real = float>
struct serial {
    using role = role::executor;

    pixel_major<Real> kernel() const { return {}; }
    int workers() const { return 1; }
    template <class Work>
    void dispatch(int count, const Work& work) const {
        for (int i = 0; i < count; ++i) work(i);
    }
};
static_assert(executor_policy<serial<>>);

}  // namespace winnow::executor
