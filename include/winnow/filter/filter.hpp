// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A filter: the sum over neighbours  F(p) = sum_q w(p,q) u(q) / sum_q w(p,q), as a value.
#include <winnow/estimator/none.hpp>
#include <winnow/executor/serial.hpp>
#include <winnow/filter/bind.hpp>
#include <winnow/weight/concept.hpp>
#include <winnow/window/square.hpp>

namespace winnow {

/// What is computed is in the type and its numbers; who runs it is an argument of the call.
///     filter{gaussian(spatial, 3) * gaussian(l2(albedo), 0.1f), window::square{.radius = 7}}
template <class Weight, class Window = window::square, class Estimator = estimator::none>
struct filter {
    // Not in the line above: clang 14 does not give the reason for a constraint there.
    static_assert(weight_policy<Weight>);
    static_assert(window_policy<Window>);
    static_assert(estimator_policy<Estimator>);
    using reads = joined<typename Weight::reads, typename Estimator::reads>;

    Weight weight;
    Window window{};
    Estimator estimator{};
    winnow::border border = winnow::border::clip;

    /// Filters the colour of `in` into `out`.  Throws invalid_input before any work if buffers or numbers do not fit.
    /// Non-finite pixels are replaced by the mean of their finite neighbours (see `diagnose`, which counts them).
    template <frame_to_filter<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }
    /// The same with the caller's workspace: from the second run of the same size on, nothing is allocated.
    template <frame_to_filter<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory) const {
        detail::run_sweep(as_sweep(), in, std::span(&out, 1), executor, memory);
    }

    /// The same filter with another estimator, window or border.
    template <estimator_policy E>
    constexpr auto with(E e) const {
        return filter<Weight, Window, E>{weight, window, e, border};
    }
    template <window_policy W>
    constexpr auto with(W w) const {
        return filter<Weight, W, Estimator>{weight, w, estimator, border};
    }
    constexpr filter with(winnow::border b) const { return {weight, window, estimator, b}; }

    auto as_sweep() const {
        return sweep<Window, Estimator, Weight>{window, estimator, border, std::tuple<Weight>(weight)};
    }
    bool operator==(const filter&) const = default;
};

template <weight_policy W, window_policy Window = window::square, estimator_policy E = estimator::none>
filter(W, Window = {}, E = {}, border = border::clip) -> filter<W, Window, E>;

/// What runs as one sweep: a filter, or several over one window.
template <class F>
concept single_sweep = requires(const F f) {
    f.as_sweep();
};

/// How far from a pixel its result can depend on the input, in pixels.
template <single_sweep F>
int halo(const F& f) {
    return halo(f.as_sweep());
}

/// What a run over an image of this size will take; `values` counts the planes to filter: 3 for the colour, 6 more with
/// halves, and those of further layers.
template <single_sweep F, executor_policy Executor>
run_plan plan(const F& f, extent size, const Executor& executor, int values = 3) {
    sweep_buffers buffers;
    buffers.size = size;
    buffers.values.resize(values);
    return plan_tiles(executor.kernel(), f.as_sweep(), buffers, executor.workers());
}

}  // namespace winnow
