// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The distance of a feature, relative to its residual noise and its local contrast.
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, section 5.
#include <winnow/core/error.hpp>
#include <winnow/distance/concept.hpp>

namespace winnow::distance {

/// With sums over the channels of the feature f,
///     (sum (f(p) - f(q))^2 - sum (Var[p] + min(Var[p], Var[q]))) / (k^2 max(tau, sum Var[p], sum |Grad[p]|^2)).
/// No unit.  The feature is expected in unit range; Var is the variance that is left in it.
template <guide G>
struct cross_feature {
    using role = role::distance;
    using reads = planes<G, variance_of<G>, gradient_of<G>>;

    float k = 0.6f;     ///< sensitivity: larger forgives more
    float tau = 1e-3f;  ///< squared contrast below which a difference does not matter, in squared units of the feature

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        const auto sum = [&](const auto& term) WINNOW_HD_LAMBDA { return math::sum_over<G::channels>(term); };
        const Real unexplained = sum([&](auto c) WINNOW_HD_LAMBDA {
            const Real difference = pq.p(G{}, c) - pq.q(G{}, c), var_p = pq.p(variance_of<G>{}, c);
            return difference * difference - (var_p + math::min(var_p, pq.q(variance_of<G>{}, c)));
        });
        const Real noise = sum([&](auto c) WINNOW_HD_LAMBDA { return pq.p(variance_of<G>{}, c); });
        const Real contrast = sum([&](auto c) WINNOW_HD_LAMBDA { return pq.p(gradient_of<G>{}, c); });
        return unexplained * math::reciprocal(math::max(math::max(noise, contrast), Real(tau)) * Real(k * k));
    }
    bool operator==(const cross_feature&) const = default;

    /// Within these bounds the denominator stays in the range of math::reciprocal.
    void check() const {
        if (!(k >= 1e-3f && k <= 1e6f))
            fail("cross_feature: k is " + std::to_string(k) + ", it must be between 0.001 and 1e6");
        if (!(tau >= 1e-30f && tau <= 1e10f))
            fail("cross_feature: tau is " + std::to_string(tau) + ", it must be between 1e-30 and 1e10");
    }
};
static_assert(distance_policy<cross_feature<normal_t>>);

/// The numbers of cross_feature, for use with designators:  cross(albedo, {.tau = 1e-4f}).
struct cross_feature_numbers {
    float k = 0.6f;
    float tau = 1e-3f;
};

}  // namespace winnow::distance

namespace winnow {

template <guide G>
constexpr auto cross(G, distance::cross_feature_numbers numbers = {}) {
    return distance::cross_feature<G>{numbers.k, numbers.tau};
}

}  // namespace winnow
