// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A weight that several filters of one sweep have in common.
#include <winnow/weight/concept.hpp>

namespace winnow::weight {

/// The same weight, evaluated once a pair of pixels for all candidates that hold it: at the price of one exponential
/// more than where exponents are added, and worth it where the rest depends on the offset alone.
template <weight_policy W>
struct shared {
    using role = role::weight;
    using reads = typename W::reads;
    using shares = W;

    W inner;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return inner(pq);
    }
    bool operator==(const shared&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto w) { return shared<decltype(w)>{w}; }, inner);
    }
};

}  // namespace winnow::weight

namespace winnow {

template <weight_policy W>
constexpr auto shared(W inner) {
    return weight::shared<W>{inner};
}

}  // namespace winnow
