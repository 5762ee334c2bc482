// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Squared Euclidean distance between the values of a guide.
#include <winnow/distance/concept.hpp>

namespace winnow::distance {

/// sum over channels of (g(p) - g(q))^2, in squared units of the guide.
template <guide G>
struct squared_difference {
    using role = role::distance;
    using reads = planes<G>;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return math::sum_over<G::channels>([&](auto c)
                                               WINNOW_HD_LAMBDA { return math::square(pq.p(G{}, c) - pq.q(G{}, c)); });
    }
    bool operator==(const squared_difference&) const = default;
};
static_assert(distance_policy<squared_difference<color_t>>);

}  // namespace winnow::distance

namespace winnow {

/// l2(albedo): the squared Euclidean distance of two albedos.
template <guide G>
constexpr auto l2(G) {
    return distance::squared_difference<G>{};
}

}  // namespace winnow
