// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The last step of every CPU executor: sums become means, means become results and errors.
#include <winnow/executor/stage.hpp>
#include <winnow/frame/pixel_estimate.hpp>

namespace winnow {

/// Below this sum of weights a pixel has no neighbour that counts, not even itself: it keeps its value.
inline constexpr float no_weight = 1e-30f;

/// Writes the pixels of one weight's row: filtered(v, x) is the filtered value v of the x-th pixel, input(v, x) what it
/// was before.  Filtered planes are written where somebody asked for them.
template <class Estimator, class Filtered, class Input>
void write_row(const sweep_buffers& buffers, const Estimator& estimator, int weight, rectangle tile, int y,
               const Filtered& filtered, const Input& input) {
    const int values = static_cast<int>(buffers.values.size());
    for (int v = 0; v < values; ++v)
        if (const target& to = buffers.results[weight * values + v])
            for (int x = tile.x0; x < tile.x1; ++x) to.set(x, y, filtered(v, x));
    for (int c = 0; c < buffers.channels; ++c)
        if (const target& to = buffers.errors[weight * buffers.channels + c])
            for (int x = tile.x0; x < tile.x1; ++x) {
                pixel_estimate e{.input = input(c, x), .filtered = filtered(c, x)};
                if constexpr (Estimator::needs_halves) {
                    e.half_a = filtered(buffers.channels + c, x);
                    e.half_b = filtered(2 * buffers.channels + c, x);
                }
                to.set(x, y, estimator(e));
            }
}

}  // namespace winnow
