// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// exp(-d / (2 h^2)) of a squared distance, with a bandwidth h of its own in each pixel.
#include <winnow/weight/concept.hpp>

namespace winnow {
WINNOW_GUIDE(bandwidth, 1);  ///< of a filter in this pixel, in the unit of the root of its distance
}

namespace winnow::weight {

/// The bandwidth is that of p: the weight is not symmetric.  A negative distance counts as 0.  Where the bandwidth is
/// below `identity` only p itself counts.
template <distance_policy D, guide Bandwidth>
struct local_gaussian {
    using role = role::weight;
    using reads = joined<typename D::reads, planes<Bandwidth>>;
    static constexpr float identity = 1e-3f;

    D distance;

    template <class Real, class Planes>
    WINNOW_HD Real exponent(const pixel_pair<Real, Planes>& pq) const {
        const Real h = pq.p(Bandwidth{}), away = pq.dx() * pq.dx() + pq.dy() * pq.dy();
        const Real scaled =
            math::max(Real(0), distance(pq)) * math::reciprocal(Real(2) * math::square(math::max(h, Real(identity))));
        return math::select(h < Real(identity), away * Real(math::last_exponent), scaled);
    }
    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return math::exp_neg(exponent(pq));
    }
    bool operator==(const local_gaussian&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto d) { return local_gaussian<decltype(d), Bandwidth>{d}; }, distance);
    }
};

}  // namespace winnow::weight

namespace winnow {

/// gaussian(mahalanobis(position), bandwidth)
template <distance_policy D, guide Bandwidth>
constexpr auto gaussian(D distance, Bandwidth) {
    return weight::local_gaussian<D, Bandwidth>{distance};
}

}  // namespace winnow
