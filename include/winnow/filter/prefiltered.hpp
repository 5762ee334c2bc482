// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A filter behind a pre-filter that cleans its features.
#include <array>
#include <winnow/filter/passes.hpp>
#include <winnow/frame/cleaned.hpp>

namespace winnow {

/// prefiltered{prefilter, filter}(in, out, executor, memory): the filter, which knows nothing of it, is given the frame
/// with the features that the pre-filter has cleaned.
///
/// A pre-filter has the list of its features, `using features = planes<...>`, and what it needs of a frame, `reads`;
///     prefilter(in, executor, memory)
/// gives the cleaned features, in this order, in images of `memory.clean`.
template <class Prefilter, class Filter>
struct prefiltered {
    using features = typename Prefilter::features;
    using reads = typename Prefilter::reads;

    Prefilter prefilter;
    Filter filter;

    template <frame_with<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }
    /// `more` is what the filter takes besides.
    template <frame_with<reads> Frame, executor_policy Executor, class... More>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory,
                    const More&... more) const {
        static_assert(!is_frame_sequence<Frame>, "the frames of a sequence are cleaned one by one");
        memory.progress.enter_filter(0, share);
        const cleaned_frame<Frame, features> cleaned{in, prefilter(in, executor, memory)};
        memory.progress.enter_filter(share, 1);
        filter(cleaned, out, executor, memory, more...);
        memory.progress.enter_filter(0, 1);
    }
    bool operator==(const prefiltered&) const = default;

    friend int halo(const prefiltered& f) { return halo(f.prefilter) + halo(f.filter); }

private:
    static constexpr float share = 0.2f;  ///< of the time, about; progress shows it
};
template <class Prefilter, class Filter>
prefiltered(Prefilter, Filter) -> prefiltered<Prefilter, Filter>;

/// What a run will take; `more` is what the plan of the filter takes besides.
template <class Prefilter, class Filter, executor_policy Executor, class... More>
run_plan plan(const prefiltered<Prefilter, Filter>& f, extent size, const Executor& executor, More... more) {
    const run_plan before = plan(f.prefilter, size, executor);
    run_plan p = plan(f.filter, size, executor, more...);
    p.scratch_bytes = std::max(p.scratch_bytes, before.scratch_bytes);
    p.image_bytes += before.image_bytes;
    p.passes += before.passes;
    p.halo = halo(f);
    return p;
}

}  // namespace winnow
