// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Stein's unbiased risk estimate, with the exact derivative of the filter.
/// Stein, "Estimation of the Mean of a Multivariate Normal Distribution", 1981;
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, Eq. 5.
#include <winnow/estimator/concept.hpp>

namespace winnow::estimator {

/// (F - u)^2 - Var + 2 Var dF/du: for Gaussian noise of variance Var its mean is that of the squared error of F, noise
/// and bias together.  One pixel deviates from it by several times its value, so average it.  The variance is held
/// fixed; that it comes from the samples itself is not seen.
template <guide G = color_t>
struct sure {
    using role = role::estimator;
    using reads = planes<G, variance_of<G>>;
    using varies = G;  ///< with respect to which buffer the derivative is
    static constexpr bool reports = true;
    static constexpr bool needs_halves = false;
    static constexpr bool needs_derivative = true;

    float operator()(const pixel_estimate& x) const {
        const float change = x.filtered - x.input;
        return change * change - x.variance + 2 * x.variance * x.derivative;
    }
    bool operator==(const sure&) const = default;
};
static_assert(estimator_policy<sure<>>);

}  // namespace winnow::estimator
