// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Simple work on all rows of an image, by the executor that runs a filter.
#include <algorithm>
#include <cstdint>
#include <winnow/executor/concept.hpp>

namespace winnow {

/// The number of bands of rows that an executor works on at once.
template <executor_policy Executor>
int bands(const Executor& executor, extent size) {
    return std::max(1, std::min(executor.workers(), size.height));
}

/// Calls f(band, y0, y1) for bands of rows y0 <= y < y1 that together are the image, on the executor's workers.
template <executor_policy Executor, class F>
void for_each_band(const Executor& executor, extent size, const F& f) {
    const int count = bands(executor, size);
    executor.dispatch(count, [&](int band) {
        const auto row = [&](std::int64_t b) { return static_cast<int>(b * size.height / count); };
        f(band, row(band), row(band + 1));
    });
}

/// Calls f(y) for each row.
template <executor_policy Executor, class F>
void for_each_row(const Executor& executor, extent size, const F& f) {
    for_each_band(executor, size, [&](int, int y0, int y1) {
        for (int y = y0; y < y1; ++y) f(y);
    });
}

}  // namespace winnow
