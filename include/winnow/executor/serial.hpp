// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The definition: pixel by pixel, neighbour by neighbour, as the formula stands.
#include <winnow/executor/concept.hpp>
#include <winnow/executor/finish.hpp>
#include <winnow/frame/differential.hpp>

namespace winnow::executor {

/// For each pixel p and each weight w of the sweep:  F(p) = sum_q w(p,q) u(q) / sum_q w(p,q), in Real arithmetic; and,
/// where the estimator needs it,  dF/du = (w(p,p) + sum_q dw u(q) - F sum_q dw) / sum_q w,  with dw = dw(p,q) / du(p).
template <class Real>
struct pixel_major {
    using real = Real;  ///< what it computes with

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
               sizeof(Real) * results_of<Sweep>(buffers) * tile.width;
    }

    template <class Sweep>
    void operator()(const Sweep& sweep, const sweep_buffers& buffers, rectangle tile, std::byte* scratch) const {
        const rectangle region = tile.grown(margin(sweep, buffers.size));
        const int planes = staged_planes<Sweep>(buffers), values = static_cast<int>(buffers.values.size());
        const staged_tile staged{region,
                                 reinterpret_cast<float*>(scratch),
                                 {region.size().width, std::ptrdiff_t{region.size().width} * planes}};
        stage(sweep, buffers, staged);
        Real* results =
            reinterpret_cast<Real*>(scratch + detail::aligned(sizeof(float) * region.size().pixels() * planes));

        int index = 0;
        const auto filter_all = [&](const auto& weight) {
            for (int y = tile.y0; y < tile.y1; ++y) {
                for (int x = tile.x0; x < tile.x1; ++x)
                    filter_pixel(sweep, weight, buffers, staged, x, y,
                                 results + results_of<Sweep>(buffers) * (x - tile.x0));
                write_row(buffers, sweep.estimator, index, tile, y,
                          row<Sweep, std::remove_cvref_t<decltype(weight)>>{
                              weight, staged, results, results_of<Sweep>(buffers), values, tile.x0, y});
            }
            ++index;
        };
        std::apply([&](const auto&... weight) { (filter_all(weight), ...); }, sweep.weights);
    }

private:
    template <class Sweep>
    static constexpr int channels = detail::channels_of<varied_in<Sweep>>;

    /// Of one pixel: the filtered values, the sum of weights, the derivatives, the estimator's sums.
    template <class Sweep>
    static int results_of(const sweep_buffers& buffers) {
        return static_cast<int>(buffers.values.size()) + 1 + channels<Sweep> + sums_in<Sweep>;
    }

    template <class Sweep, class Weight>
    struct row {
        const Weight& weight;
        const staged_tile& staged;
        const Real* results;
        int pitch, values, x0, y;

        float at(int i, int x) const { return static_cast<float>(results[pitch * (x - x0) + i]); }
        float filtered(int v, int x) const { return at(v, x); }
        float support(int x) const { return at(values, x); }
        float derivative(int c, int x) const { return at(values + 1 + c, x); }
        float sum(int k, int x) const { return at(values + 1 + channels<Sweep> + k, x); }
        auto pixel(int x) const {
            return pixel_pair<float, typename Sweep::reads>(staged.at(0, x, y), staged.at(0, x, y), staged.step, 0, 0);
        }
        float input(int v, int x) const { return *staged.at(1 + Sweep::reads::count + v, x, y); }
        float variance(int c, int x) const {
            return *staged.at(1 + slot_of<variance_of<varied_in<Sweep>>>(typename Sweep::reads{}) + c, x, y);
        }
    };

    template <class Sweep, class Weight>
    static void filter_pixel(const Sweep& sweep, const Weight& weight, const sweep_buffers& buffers,
                             const staged_tile& staged, int x, int y, Real* results) {
        using varied = varied_in<Sweep>;
        const int values = static_cast<int>(buffers.values.size());
        const auto value = [&](int v, int i, int j) { return Real(*staged.at(1 + Sweep::reads::count + v, i, j)); };
        Real total = 0, own = 0, slopes[channels<Sweep> + 1] = {}, slopes_of_sums[channels<Sweep> + 1] = {};
        Real* const own_sums = results + values + 1 + channels<Sweep>;
        std::fill(results, results + results_of<Sweep>(buffers), Real(0));
        const auto add = [&](int f, int dx, int dy) {
            const int frame = f * planes_of_frame<Sweep>(buffers);
            const float* q = staged.at(frame, x + dx, y + dy);
            if (*q == 0) return;  // no pixel there
            const auto of_q = [&](int v) { return value(frame + v, x + dx, y + dy); };
            const auto of = [&]<class Number>(std::type_identity<Number>) {
                return pixel_pair<Number, typename Sweep::reads>(staged.at(0, x, y), q, staged.step, dx, dy);
            };
            const bool own_pixel = f == 0 && dx == 0 && dy == 0;
            Real w;
            if constexpr (detail::varies_with<Weight, varied>) {
                const auto pair = of(std::type_identity<differential<Real, varied>>{});
                const auto varying = weight(f == 0 ? pair : pair.to_other_frame());
                w = varying.value();
                // A pixel's weight for itself is the same whatever its value.
                for (int c = 0; c < (own_pixel ? 0 : channels<Sweep>); ++c) {
                    slopes[c] += varying.slope(c);
                    slopes_of_sums[c] += varying.slope(c) * of_q(c);
                }
            } else {
                w = weight(of(std::type_identity<Real>{}));
            }
            if (own_pixel) own = w;
            total += w;
            for (int v = 0; v < values; ++v) results[v] += w * of_q(v);
            if constexpr (sums_in < Sweep >> 0) {
                Real terms[sums_in<Sweep>];
                sweep.estimator.terms(of(std::type_identity<Real>{}), terms);
                for (int k = 0; k < sums_in<Sweep>; ++k) own_sums[k] += w * terms[k];
            }
        };
        const int reach = window_reach(sweep, buffers.size);
        for (int f = 0; f < buffers.frames; ++f)
            for (int dy = -reach; dy <= reach; ++dy) {
                const window_row row = row_of_window(sweep, buffers.size, dy);
                for (int i = 0; i < row.count; ++i) add(f, row.first + i * row.step, dy);
            }
        const bool weighted = total > Real(no_weight);
        for (int v = 0; v < values; ++v) results[v] = weighted ? results[v] / total : value(v, x, y);
        results[values] = total;
        for (int c = 0; c < channels<Sweep>; ++c)
            results[values + 1 + c] = weighted ? (own + slopes_of_sums[c] - results[c] * slopes[c]) / total : Real(1);
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
