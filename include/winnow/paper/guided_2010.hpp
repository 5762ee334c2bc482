// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The guided filter: in every window the colour is a linear function of noise-free features.
/// He, Sun, Tang, "Guided Image Filtering", 2010 and 2013; for rendering: Bauszat, Eisemann, Magnor, "Guided Image
/// Filtering for Interactive High-quality Global Illumination", 2011.
#include <winnow/paper/guided_2010_regression.hpp>
#include <winnow/paper/guided_2010_tiles.hpp>

namespace winnow::paper {

struct guided_numbers {
    static constexpr float least_epsilon = 1e-4f;  ///< below it, guides that depend on each other blur in rounding

    int radius = 8;         ///< of the windows, in pixels; a pixel is filtered from twice as far
    float epsilon = 1e-3f;  ///< variance of a guide below which it explains nothing, in squared units of the guide

    void check() const {
        if (!(epsilon >= least_epsilon))
            fail("guided filter: epsilon is " + std::to_string(epsilon) + ", it must be at least " +
                 std::to_string(least_epsilon));
    }
    bool operator==(const guided_numbers&) const = default;
};

/// Guides: the buffers that explain the colour, in unit range (see unit_range), for instance planes<normal_t, depth_t>.
/// The result is a linear function of the colour: halves and further layers are filtered by the same one.
template <class Guides, class Estimator = estimator::none>
struct guided_of {
    static_assert(estimator_policy<Estimator>);
    static_assert(!Estimator::needs_derivative && !summing_estimator<Estimator>,
                  "the guided filter has neither weights nor a derivative; use with(estimator::residual_variance{})");
    using reads = Guides;

    guided_numbers numbers{};
    Estimator estimator{};

    /// Filters the colour of `in` into `out`.  Throws invalid_input before any work if buffers or numbers do not fit.
    template <frame_to_filter<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }
    /// The same with the caller's workspace: from the second run of the same size on, nothing is allocated.
    template <frame_to_filter<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory) const {
        numbers.check();
        if (out.derivative() || out.support()) fail("the guided filter has neither weights nor derivatives to report");
        const auto regression = as_regression();
        regression.window.check();
        winnow::detail::bind_sweep(regression, in, std::span(&out, 1), memory.buffers);
        run_tiles(kernel(executor.kernel()), regression, memory, executor.workers(),
                  [&](int count, const auto& work) { executor.dispatch(count, work); });
    }

    template <estimator_policy E>
    constexpr auto with(E e) const {
        return guided_of<Guides, E>{numbers, e};
    }
    auto as_regression() const {
        return guided_regression<Guides, Estimator>{{numbers.radius}, numbers.epsilon, estimator};
    }
    /// By tiles where the executor has lanes, else by the definition.
    template <class Kernel>
    static auto kernel(const Kernel& of_executor) {
        using real = typename Kernel::real;
        if constexpr (std::is_floating_point_v<real>) return guided_pixel_by_pixel<real>{};
        else return guided_by_tiles<real>{of_executor.largest_tile};
    }
    bool operator==(const guided_of&) const = default;
};

template <class Guides, class Estimator>
int halo(const guided_of<Guides, Estimator>& f) {
    return halo(f.as_regression());
}

/// What a run over an image of this size will take; `values` counts the planes to filter.
template <class Guides, class Estimator, executor_policy Executor>
run_plan plan(const guided_of<Guides, Estimator>& f, extent size, const Executor& executor, int values = 3) {
    sweep_buffers buffers;
    buffers.size = size;
    buffers.values.resize(static_cast<std::size_t>(values));
    return plan_tiles(f.kernel(executor.kernel()), f.as_regression(), buffers, executor.workers());
}

/// The guides that renderers have of the first hit.
using guided = guided_of<planes<normal_t, depth_t>>;

}  // namespace winnow::paper
