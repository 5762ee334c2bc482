// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The largest of two distances, and their sum.  `max(a, b, c)` folds from the left.
#include <winnow/distance/concept.hpp>

namespace winnow::distance {

template <distance_policy A, distance_policy B>
struct max_of {
    using role = role::distance;
    using reads = joined<typename A::reads, typename B::reads>;

    A a;
    B b;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return math::max(a(pq), b(pq));
    }
    bool operator==(const max_of&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto x, auto y) { return max_of<decltype(x), decltype(y)>{x, y}; }, a, b);
    }
};

template <distance_policy A, distance_policy B>
struct sum_of {
    using role = role::distance;
    using reads = joined<typename A::reads, typename B::reads>;

    A a;
    B b;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return a(pq) + b(pq);
    }
    bool operator==(const sum_of&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto x, auto y) { return sum_of<decltype(x), decltype(y)>{x, y}; }, a, b);
    }
};

/// a + b, found by argument-dependent lookup.
template <distance_policy A, distance_policy B>
constexpr auto operator+(A a, B b) {
    return sum_of<A, B>{a, b};
}

}  // namespace winnow::distance

namespace winnow {

template <distance_policy A>
constexpr A max(A a) {
    return a;
}
template <distance_policy A, distance_policy B>
constexpr auto max(A a, B b) {
    return distance::max_of<A, B>{a, b};
}
template <distance_policy A, distance_policy B, distance_policy... More>
requires(sizeof...(More) > 0) constexpr auto max(A a, B b, More... more) { return max(max(a, b), more...); }

}  // namespace winnow
