// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Mean squared error relative to the brightness of the reference.
/// Rousselle, Knaus, Zwicker, "Adaptive Sampling and Reconstruction using Greedy Error Minimization", 2011.
#include <winnow/metric/compare.hpp>

namespace winnow::metric {

/// The mean of (x - y)^2 / (y^2 + epsilon) over pixels and channels, no unit; NaN where a value is not finite.  The
/// literature uses an epsilon of 0.01 or of 0.001: state which.
inline double relative_mse(source x, source reference, double epsilon = 0.01) {
    if (!(epsilon > 0)) fail("relative_mse: epsilon is " + std::to_string(epsilon) + ", it must be above 0");
    return mean_over_values([epsilon](double a, double b) { return (a - b) * (a - b) / (b * b + epsilon); }, x,
                            reference);
}

}  // namespace winnow::metric
