// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// exp(-d / (2 sigma^2)) of a squared distance.
#include <winnow/core/error.hpp>
#include <winnow/weight/concept.hpp>

namespace winnow::weight {

/// A negative distance counts as 0.  sigma is in the unit of the distance's root; at sigma 0 only pixels at distance 0
/// count.
template <distance_policy D>
struct gaussian {
    using role = role::weight;
    using reads = typename D::reads;

    D distance;
    float sigma = 1.0f;

    template <class Real, class Planes>
    WINNOW_HD Real exponent(const pixel_pair<Real, Planes>& pq) const {
        const float width = 2 * sigma * sigma;
        return math::max(Real(0), distance(pq)) * math::reciprocal(Real(width > 1e-30f ? width : 1e-30f));
    }
    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return math::exp_neg(exponent(pq));
    }
    bool operator==(const gaussian&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([s = sigma](auto d) { return gaussian<decltype(d)>{d, s}; }, distance);
    }

    void check() const {
        if (!(sigma >= 0)) fail("gaussian: sigma is " + std::to_string(sigma) + ", it must be 0 or more");
    }
};

}  // namespace winnow::weight

namespace winnow {

template <distance_policy D>
constexpr auto gaussian(D distance, float sigma) {
    return weight::gaussian<D>{distance, sigma};
}

}  // namespace winnow
