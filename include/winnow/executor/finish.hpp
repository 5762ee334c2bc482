// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The last step of every CPU executor: sums become means, means become results and errors.
#include <winnow/executor/stage.hpp>
#include <winnow/frame/pixel_estimate.hpp>

namespace winnow {

/// Below this sum of weights a pixel has no neighbour that counts, not even itself: it keeps its value.
inline constexpr float no_weight = 1e-30f;

/// What is known of the x-th pixel of a row, after one weight's sums are done.
///     filtered(v, x)    value v, filtered;            input(v, x)       the same before
///     derivative(c, x)  dF / du of channel c;         variance(c, x)    of channel c
///     support(x)        the sum of weights
///     sum(k, x)         sum k of the estimator;       pixel(x)          the pixel itself, as a pair with itself
///     weight            the policy
/// What the estimator does not need and nobody asked for is not asked for here.
template <class Estimator, class Row>
void write_row(const sweep_buffers& buffers, const Estimator& estimator, int weight, rectangle tile, int y,
               const Row& row) {
    const auto write = [&](const target& to, const auto& value) {
        if (to)
            for (int x = tile.x0; x < tile.x1; ++x) to.set(x, y, value(x));
    };
    const int values = static_cast<int>(buffers.values.size()), channels = buffers.channels;
    for (int v = 0; v < values; ++v)
        write(buffers.results[weight * values + v], [&](int x) { return row.filtered(v, x); });
    write(buffers.supports[weight], [&](int x) { return row.support(x); });
    constexpr int sums = detail::sums_of<Estimator>;
    if constexpr (sums > 0)
        write(buffers.errors[weight], [&](int x) {
            float sum[sums];
            for (int k = 0; k < sums; ++k) sum[k] = row.sum(k, x);
            return estimator(row.weight, row.support(x), sum, row.pixel(x));
        });
    else
        for (int c = 0; c < channels; ++c) {
            if constexpr (Estimator::needs_derivative)
                write(buffers.derivatives[weight * channels + c], [&](int x) { return row.derivative(c, x); });
            if constexpr (Estimator::reports)
                write(buffers.errors[weight * channels + c], [&](int x) {
                    pixel_estimate e{.input = row.input(c, x), .filtered = row.filtered(c, x)};
                    if constexpr (Estimator::needs_halves) {
                        e.half_a = row.filtered(channels + c, x);
                        e.half_b = row.filtered(2 * channels + c, x);
                    }
                    if constexpr (Estimator::needs_derivative) {
                        e.variance = row.variance(c, x);
                        e.derivative = row.derivative(c, x);
                    }
                    return estimator(e);
                });
        }
}

}  // namespace winnow
