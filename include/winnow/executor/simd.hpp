// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// One thread and its SIMD lanes.
#include <winnow/executor/concept.hpp>
#include <winnow/executor/offset_major.hpp>

namespace winnow::executor {

/// One thread, all its lanes.
struct simd {
    using role = role::executor;
    extent tile = offset_major::usual_tile;  ///< pixels worked on at a time: a matter of cache, never of results

    offset_major kernel() const { return {tile}; }
    int workers() const { return 1; }
    template <class Work>
    void dispatch(int count, const Work& work) const {
        for (int i = 0; i < count; ++i) work(i);
    }
};
static_assert(executor_policy<simd>);

}  // namespace winnow::executor
