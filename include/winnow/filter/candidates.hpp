// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Several filters over one window in one sweep: the planes are staged once, and patches over the same distance share
/// its evaluation.
#include <array>
#include <winnow/filter/filter.hpp>

namespace winnow {

/// candidates{first, second, third}(in, {out1, out2, out3}, executor) gives what the filters give one by one, in less
/// time: bit for bit on lanes, and on serial up to a compiler's freedom to fuse a * b + c; that holds for lanes too
/// where a distance that several filters have in common is the term of a sum.  They must agree in window, border and
/// estimator.
template <class Window, class Estimator, class... Weights>
class candidates {
public:
    using reads = joined<typename Weights::reads..., typename Estimator::reads>;
    static constexpr std::size_t count = sizeof...(Weights);

    candidates(const filter<Weights, Window, Estimator>&... filters)
        : sweep_{first(filters...).window, first(filters...).estimator, first(filters...).border,
                 std::tuple<Weights...>(filters.weight...)} {
        if (!((filters.window == sweep_.window && filters.border == sweep_.rule) && ...))
            fail("candidates: the filters differ in window or border");
    }

    template <frame_to_filter<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const std::array<output, count>& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, std::span<const output, count>(out), executor, memory);
    }
    template <frame_to_filter<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, std::span<const output, count> out, const Executor& executor,
                    workspace& memory) const {
        detail::run_sweep(sweep_, in, std::span<const output>(out), executor, memory);
    }

    const auto& as_sweep() const { return sweep_; }

private:
    template <class First, class... More>
    static const First& first(const First& f, const More&...) {
        return f;
    }

    sweep<Window, Estimator, Weights...> sweep_;
};

}  // namespace winnow
