// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a display shows.
#include <cmath>

namespace winnow {

/// Linear radiance as a display shows it: cut to [0, 1], then the sRGB curve (IEC 61966-2-1).  NaN shows as 0.
inline double srgb(double linear) {
    const double cut = linear > 0 ? std::fmin(linear, 1.0) : 0.0;
    return cut <= 0.0031308 ? 12.92 * cut : 1.055 * std::pow(cut, 1 / 2.4) - 0.055;
}

}  // namespace winnow
