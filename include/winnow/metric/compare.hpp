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

/// The mean of f(value, value of each reference) over all pixels and channels.  One NaN or infinite value in any image
/// makes it NaN: no metric hides what is in an image.
template <class F, class... References>
double mean_over_values(const F& f, const source& x, const References&... references) {
    (check_comparable(x, references), ...);
    double sum = 0;
    for (int c = 0; c < x.channels; ++c)
        for (int j = 0; j < x.size.height; ++j)
            for (int i = 0; i < x.size.width; ++i) {
                const auto at = [&](const source& s) { return s.channel(c).at(i, j); };
                if (!is_finite(at(x)) || !(is_finite(at(references)) && ...))
                    return std::numeric_limits<double>::quiet_NaN();
                sum += f(at(x), at(references)...);
            }
    return sum / (static_cast<double>(x.size.pixels()) * x.channels);
}

}  // namespace winnow::metric
