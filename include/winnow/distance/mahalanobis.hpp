// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The distance of two means in units of how their samples spread, direction by direction.
/// Mahalanobis, "On the Generalised Distance in Statistics", 1936; of world positions in pixels: Moon et al., "Noise
/// Reduction on G-Buffers for Monte Carlo Filtering", 2017, Eq. 4.
#include <winnow/distance/concept.hpp>
#include <winnow/frame/precision.hpp>

namespace winnow::distance {

/// (g(q) - g(p))^T (A_p + A_q) (g(q) - g(p)), where A is the inverse of the covariance of the samples of g in a pixel.
/// No unit.
template <guide G>
struct mahalanobis {
    using role = role::distance;
    using reads = planes<G, precision_of<G>>;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return scaled_difference<G, pixel_pair<Real, Planes>>(pq).squared_distance();
    }
    bool operator==(const mahalanobis&) const = default;
};
static_assert(distance_policy<mahalanobis<position_t>>);

}  // namespace winnow::distance

namespace winnow {

template <guide G>
constexpr auto mahalanobis(G) {
    return distance::mahalanobis<G>{};
}

}  // namespace winnow
