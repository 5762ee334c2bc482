// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The noise that is left, from half buffers filtered with the same weights.
#include <winnow/estimator/concept.hpp>

namespace winnow::estimator {

/// (A - B)^2 / 4: with equal halves A and B of a mean an unbiased estimate of its variance.  It sees noise, not the
/// bias of the filter; one pixel alone is a draw from a wide distribution, so average it.
struct residual_variance {
    using role = role::estimator;
    using reads = planes<>;
    static constexpr bool reports = true;
    static constexpr bool needs_halves = true;
    static constexpr bool needs_derivative = false;

    float operator()(const pixel_estimate& x) const {
        const float half_difference = (x.half_a - x.half_b) / 2;
        return half_difference * half_difference;
    }
    bool operator==(const residual_variance&) const = default;
};
static_assert(estimator_policy<residual_variance>);

}  // namespace winnow::estimator
