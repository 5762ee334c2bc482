// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Squared standardized Euclidean distance: every channel in units of its own noise.
/// Li, Wu, Chuang, "SURE-based Optimization for Adaptive Sampling and Reconstruction", 2012, Eq. 6.
#include <winnow/core/error.hpp>
#include <winnow/distance/concept.hpp>

namespace winnow::distance {

/// sum over channels of
///     (g(p) - g(q))^2 / max(spread (Var[p] + Var[q]), floor),
/// where Var is the variance of the pixel mean.  No unit.  A channel that is noise throughout does not tell pixels
/// apart; one without noise does, in units of the floor.
template <guide G>
struct standardized {
    using role = role::distance;
    using reads = planes<G, variance_of<G>>;

    float floor = 1e-2f;  ///< variance below which noise does not matter, in squared units of the guide
    float spread = 1;     ///< 1: noise is that of the mean; the number of samples: that of one sample

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return math::sum_over<G::channels>([&](auto c) WINNOW_HD_LAMBDA {
            const Real noise = Real(spread) * (pq.p(variance_of<G>{}, c) + pq.q(variance_of<G>{}, c));
            return math::square(pq.p(G{}, c) - pq.q(G{}, c)) * math::reciprocal(math::max(noise, Real(floor)));
        });
    }
    bool operator==(const standardized&) const = default;

    /// Within these bounds the denominator stays in the range of math::reciprocal.
    void check() const {
        if (!(floor >= 1e-30f && floor <= 1e10f))
            fail("standardized: floor is " + std::to_string(floor) + ", it must be between 1e-30 and 1e10");
        if (!(spread >= 0 && spread <= 1e6f))
            fail("standardized: spread is " + std::to_string(spread) + ", it must be between 0 and 1e6");
    }
};
static_assert(distance_policy<standardized<normal_t>>);

/// The numbers of standardized, for use with designators:  standardized(normal, {.floor = 1e-3f}).
struct standardized_numbers {
    float floor = 1e-2f;
    float spread = 1;
};

}  // namespace winnow::distance

namespace winnow {

template <guide G>
constexpr auto standardized(G, distance::standardized_numbers numbers = {}) {
    return distance::standardized<G>{numbers.floor, numbers.spread};
}

}  // namespace winnow
