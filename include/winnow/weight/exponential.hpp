// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// exp(-max(0, d)): a distance that is already in the right unit becomes a weight.
#include <winnow/weight/concept.hpp>

namespace winnow::weight {

template <distance_policy D>
struct exponential {
    using role = role::weight;
    using reads = typename D::reads;

    D distance;

    template <class Real, class Planes>
    WINNOW_HD Real exponent(const pixel_pair<Real, Planes>& pq) const {
        // In this order a NaN stays one, and exp_neg gives it no weight.
        return math::max(Real(0), distance(pq));
    }
    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return math::exp_neg(exponent(pq));
    }
    bool operator==(const exponential&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto d) { return exponential<decltype(d)>{d}; }, distance);
    }
};

}  // namespace winnow::weight

namespace winnow {

template <distance_policy D>
constexpr auto exponential(D distance) {
    return weight::exponential<D>{distance};
}

}  // namespace winnow
