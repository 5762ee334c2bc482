// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Errors against two independent references: their own noise cancels in the mean.
#include <winnow/metric/compare.hpp>

namespace winnow::metric {

/// The mean of (x - r1)(x - r2) over pixels and channels: what `mse` is against a reference without noise, on average.
/// May be negative where the image is as good as the references.  NaN where a value is not finite.
inline double mse(source x, source r1, source r2) {
    return mean_over_values([](double a, double b, double c) { return (a - b) * (a - c); }, x, r1, r2);
}

/// The same relative to the brightness of both: the mean of (x - r1)(x - r2) / (((r1 + r2) / 2)^2 + epsilon).
inline double relative_mse(source x, source r1, source r2, double epsilon = 0.01) {
    if (!(epsilon > 0)) fail("relative_mse: epsilon is " + std::to_string(epsilon) + ", it must be above 0");
    const auto relative = [epsilon](double a, double b, double c) {
        const double y = (b + c) / 2;
        return (a - b) * (a - c) / (y * y + epsilon);
    };
    return mean_over_values(relative, x, r1, r2);
}

}  // namespace winnow::metric
