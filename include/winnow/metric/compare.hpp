// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What all metrics share: two images of one size, looked at value by value.
#include <cmath>
#include <limits>
#include <string>
#include <winnow/core/error.hpp>
#include <winnow/image/plane.hpp>

namespace winnow::metric {

/// Throws invalid_input unless both images have pixels, and the same number of them and of channels.
inline void check_comparable(const source& x, const source& reference) {
    if (x.size != reference.size)
        fail("the image is " + to_string(x.size) + ", the reference is " + to_string(reference.size));
    if (x.channels != reference.channels)
        fail("the image has " + std::to_string(x.channels) + " channels, the reference has " +
             std::to_string(reference.channels));
    if (!x || !reference || x.size.width < 1 || x.size.height < 1 || x.channels < 1)
        fail("the image is " + to_string(x.size) + ": there is nothing to compare");
}

/// The mean of f(value, reference value) over all pixels and channels.  One NaN or infinite value in either image makes
/// it NaN: no metric hides what is in an image.
template <class F>
double mean_over_values(const source& x, const source& reference, const F& f) {
    check_comparable(x, reference);
    double sum = 0;
    for (int c = 0; c < x.channels; ++c) {
        const source a = x.channel(c), b = reference.channel(c);
        for (int j = 0; j < x.size.height; ++j)
            for (int i = 0; i < x.size.width; ++i) {
                const float value = a.at(i, j), wanted = b.at(i, j);
                if (!is_finite(value) || !is_finite(wanted)) return std::numeric_limits<double>::quiet_NaN();
                sum += f(value, wanted);
            }
    }
    return sum / (static_cast<double>(x.size.pixels()) * x.channels);
}

}  // namespace winnow::metric
