// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Mean squared error.
#include <winnow/metric/compare.hpp>

namespace winnow::metric {

/// The mean of (x - y)^2 over pixels and channels, in squared units of the image; NaN where a value is not finite.
inline double mse(source x, source reference) {
    return mean_over_values([](double a, double b) { return (a - b) * (a - b); }, x, reference);
}

}  // namespace winnow::metric
