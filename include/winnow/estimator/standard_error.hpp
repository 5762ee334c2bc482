// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The noise that is left, from half buffers filtered with the same weights.
#include <winnow/estimator/concept.hpp>

namespace winnow::estimator {

/// |A - B| / 2: with equal halves A and B of a mean, (A - B)^2 / 4 is an unbiased estimate of its variance.  It sees
/// noise, not the bias of the filter; one pixel alone is a draw from a wide distribution, so average its square.
struct standard_error {
    using role = role::estimator;
    static constexpr bool reports = true;
    static constexpr bool needs_halves = true;

    float operator()(const pixel_estimate& x) const {
        const float difference = x.half_a - x.half_b;
        return (difference < 0 ? -difference : difference) / 2;
    }
    bool operator==(const standard_error&) const = default;
};
static_assert(estimator_policy<standard_error>);

}  // namespace winnow::estimator
