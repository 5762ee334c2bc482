// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The smaller of two weights, and their product.  `min(a, b, c)` folds from the left.
#include <winnow/weight/concept.hpp>

namespace winnow::weight {

template <weight_policy A, weight_policy B>
struct min_of {
    using role = role::weight;
    using reads = joined<typename A::reads, typename B::reads>;

    A a;
    B b;

    /// min(exp(-x), exp(-y)) = exp(-max(x, y)).
    template <class Real, class Planes>
    WINNOW_HD Real
    exponent(const pixel_pair<Real, Planes>& pq) const requires exponential_weight<A> && exponential_weight<B> {
        return math::max(a.exponent(pq), b.exponent(pq));
    }
    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        if constexpr (exponential_weight<A> && exponential_weight<B>) return math::exp_neg(exponent(pq));
        else return math::min(a(pq), b(pq));
    }
    bool operator==(const min_of&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto x, auto y) { return min_of<decltype(x), decltype(y)>{x, y}; }, a, b);
    }
};

template <weight_policy A, weight_policy B>
struct product_of {
    using role = role::weight;
    using reads = joined<typename A::reads, typename B::reads>;

    A a;
    B b;

    /// exp(-x) exp(-y) = exp(-(x + y)).
    template <class Real, class Planes>
    WINNOW_HD Real
    exponent(const pixel_pair<Real, Planes>& pq) const requires exponential_weight<A> && exponential_weight<B> {
        return a.exponent(pq) + b.exponent(pq);
    }
    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        if constexpr (exponential_weight<A> && exponential_weight<B>) return math::exp_neg(exponent(pq));
        else return a(pq) * b(pq);
    }
    bool operator==(const product_of&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto x, auto y) { return product_of<decltype(x), decltype(y)>{x, y}; }, a, b);
    }
};

/// a * b, found by argument-dependent lookup.
template <weight_policy A, weight_policy B>
constexpr auto operator*(A a, B b) {
    return product_of<A, B>{a, b};
}

}  // namespace winnow::weight

namespace winnow {

template <weight_policy A, weight_policy B>
constexpr auto min(A a, B b) {
    return weight::min_of<A, B>{a, b};
}
template <weight_policy A, weight_policy B, weight_policy... More>
requires(sizeof...(More) > 0) constexpr auto min(A a, B b, More... more) { return min(min(a, b), more...); }

}  // namespace winnow
