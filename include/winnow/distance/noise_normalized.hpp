// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Squared difference less the part that noise explains, in units of that noise.
/// Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012, section 4;
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, Eq. 1.
#include <winnow/core/error.hpp>
#include <winnow/distance/concept.hpp>

namespace winnow::distance {

/// Mean over channels of
///     ((g(p) - g(q))^2 - (Var[p] + min(Var[p], Var[q]))) / (epsilon + k^2 (Var[p] + Var[q])),
/// where Var is the variance of the pixel mean.  No unit.  Negative where the difference is less than noise makes it.
template <guide G>
struct noise_normalized {
    using role = role::distance;
    using reads = planes<G, variance_of<G>>;

    float k = 0.45f;         ///< sensitivity: larger forgives more
    float epsilon = 1e-10f;  ///< variance below which a difference counts as real, in squared units of the guide

    /// No channel says more than this: keeps the clash of two noise-free pixels finite.
    static constexpr float largest = 1e4f;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return Real(1.0f / G::channels) * math::sum_over<G::channels>([&](auto c) WINNOW_HD_LAMBDA {
                   const Real var_p = pq.p(variance_of<G>{}, c);
                   const Real var_q = pq.q(variance_of<G>{}, c);
                   const Real difference = pq.p(G{}, c) - pq.q(G{}, c);
                   // Subtracting Var[q] in full would reward a q that is noisier than p.
                   const Real unexplained = difference * difference - (var_p + math::min(var_p, var_q));
                   const Real scale = math::reciprocal(Real(k * k) * (var_p + var_q) + Real(epsilon));
                   return math::min(unexplained * scale, Real(largest));
               });
    }
    bool operator==(const noise_normalized&) const = default;

    /// Within these bounds the denominator stays in the range of math::reciprocal.
    void check() const {
        if (!(k >= 1e-3f && k <= 1e6f))
            fail("noise_normalized: k is " + std::to_string(k) + ", it must be between 0.001 and 1e6");
        if (!(epsilon >= 1e-30f && epsilon <= 1e10f))
            fail("noise_normalized: epsilon is " + std::to_string(epsilon) + ", it must be between 1e-30 and 1e10");
    }
};
static_assert(distance_policy<noise_normalized<color_t>>);

/// The numbers of noise_normalized, for use with designators:  noise_normalized(color, {.k = 1}).
struct noise_normalized_numbers {
    float k = 0.45f;
    float epsilon = 1e-10f;
};

}  // namespace winnow::distance

namespace winnow {

template <guide G>
constexpr auto noise_normalized(G, distance::noise_normalized_numbers numbers = {}) {
    return distance::noise_normalized<G>{numbers.k, numbers.epsilon};
}

}  // namespace winnow
