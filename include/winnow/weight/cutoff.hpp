// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// 1 up to a limit, 0 beyond it.
#include <winnow/core/error.hpp>
#include <winnow/weight/concept.hpp>

namespace winnow::weight {

template <distance_policy D>
struct cutoff {
    using role = role::weight;
    using reads = typename D::reads;

    D distance;
    float limit = 1.0f;  ///< in the unit of the distance

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        // min turns a NaN into a number beyond every limit: it gets no weight.
        return math::select(Real(limit) < math::min(distance(pq), Real(3e38f)), Real(0), Real(1));
    }
    bool operator==(const cutoff&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([l = limit](auto d) { return cutoff<decltype(d)>{d, l}; }, distance);
    }

    void check() const {
        if (!(limit >= 0)) fail("cutoff: limit is " + std::to_string(limit) + ", it must be 0 or more");
    }
};

}  // namespace winnow::weight

namespace winnow {

template <distance_policy D>
constexpr auto cutoff(D distance, float limit) {
    return weight::cutoff<D>{distance, limit};
}

}  // namespace winnow
