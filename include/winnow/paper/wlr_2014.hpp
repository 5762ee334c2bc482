// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// WLR: the colour as a linear function of features around each pixel, in the coordinates and with the bandwidth of the
/// least estimated error.
/// Moon, Carr, Yoon, "Adaptive Rendering based on Weighted Local Regression", 2014.
#include <winnow/filter/filter.hpp>
#include <winnow/paper/wlr_2014_kernel.hpp>

namespace winnow::paper {

/// The estimate of the squared error that comes with a fit: its variance and its squared bias.  Both are estimates, the
/// second without its own noise: where there is no bias the sum may be below 0.
struct wlr_error {
    using role = role::estimator;
    using reads = planes<>;
    static constexpr bool reports = true;
    static constexpr bool needs_halves = false;
    static constexpr bool needs_derivative = false;

    float operator()(const pixel_estimate&) const { return 0; }
};
static_assert(estimator_policy<wlr_error>);

/// Features: the buffers beside the colour; with the two image coordinates, those of the list planes<albedo_t,
/// normal_t, depth_t> make the nine regressors of the paper.
///
/// Reads the colour, the variance of its mean, the features, and the variances of their means as far as they are there:
/// a feature without is taken for exact.  Not convex: results may leave the range of the window.
template <class Features>
struct wlr_of;

template <guide... Feature>
struct wlr_of<planes<Feature...>> {
    using features = planes<Feature...>;
    using reads = planes<color_t, variance_of<color_t>, Feature...>;
    using optional = planes<variance_of<Feature>...>;

    wlr_numbers numbers{};

    template <frame_with<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }
    template <frame_with<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory) const {
        const auto over = as_sweep();
        numbers.check();
        detail::bind_sweep(over, with_exact_features<Frame>{in}, std::span(&out, 1), memory.buffers);
        const wlr_selection selection(numbers.largest_bandwidth, wlr_regressors<features>::count);
        run_tiles(kernel(selection, executor), over, memory, executor.workers(),
                  [&](int count, const auto& work) { executor.dispatch(count, work); });
    }
    bool operator==(const wlr_of&) const = default;

    friend int halo(const wlr_of& f) { return halo(f.as_sweep()) + static_cast<int>(3 * f.numbers.smoothing + 0.5f); }
    template <executor_policy Executor>
    friend run_plan plan(const wlr_of& f, extent size, const Executor& executor, int values = 3) {
        sweep_buffers buffers;
        buffers.size = size;
        buffers.values.resize(static_cast<std::size_t>(values));
        const wlr_selection selection(f.numbers.largest_bandwidth, wlr_regressors<features>::count);
        run_plan p = plan_tiles(f.kernel(selection, executor), f.as_sweep(), buffers, executor.workers());
        p.halo = halo(f);
        return p;
    }

private:
    /// What is staged.
    struct what_is_read {
        using reads = planes<color_t, variance_of<color_t>, Feature..., variance_of<Feature>...>;
    };
    auto as_sweep() const {
        return sweep<window::square, wlr_error, what_is_read>{{.radius = numbers.radius}, {}, border::clip, {}};
    }

    template <class Executor>
    auto kernel(const wlr_selection& selection, const Executor& executor) const {
        const auto given = executor.kernel();
        extent tile{1 << 20, 16};
        if constexpr (requires { given.largest_tile; }) tile = given.largest_tile;
        return wlr_kernel<typename decltype(executor.kernel())::real, features>{numbers, selection, tile};
    }

    /// The frame, with a variance of 0 for features that have none.
    template <class Frame>
    struct with_exact_features {
        const Frame& in;

        template <guide H>
        static constexpr bool has(H) {
            return contains<H, optional> || Frame::has(H{});
        }
        template <guide H>
        source find(H) const {
            const source layer = in.find(H{});
            if constexpr (contains<H, optional>) {
                static constexpr float nothing = 0;
                if (!layer) return image_view<const float>(&nothing, in.find(color).size, H::channels, strides{});
            }
            return layer;
        }
        auto filtered() const { return detail::filtered_guide(in); }
    };
};

using wlr = wlr_of<planes<albedo_t, normal_t, depth_t>>;

constexpr wlr make_wlr(wlr_numbers n = {}) { return {n}; }

}  // namespace winnow::paper
