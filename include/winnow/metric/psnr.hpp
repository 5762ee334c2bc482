// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Peak signal-to-noise ratio, as a display shows the images.
#include <winnow/image/srgb.hpp>
#include <winnow/metric/compare.hpp>

namespace winnow::metric {

/// 10 log10(1 / MSE) in decibels, where both images are cut to [0, 1] and go through the sRGB curve first, so that the
/// peak is 1.  Infinite for images that look the same; NaN where a value is not finite.
inline double psnr(source x, source reference) {
    const double error = mean_over_values(
        [](float a, float b) {
            const double difference = srgb(a) - srgb(b);
            return difference * difference;
        },
        x, reference);
    return error == 0 ? std::numeric_limits<double>::infinity() : -10 * std::log10(error);
}

}  // namespace winnow::metric
