// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What an estimator is.
#include <concepts>
#include <winnow/core/role.hpp>
#include <winnow/frame/pixel_estimate.hpp>
#include <winnow/frame/pixel_pair.hpp>

namespace winnow {

namespace detail {
template <class E>
concept tells_what_it_needs = plays<E, role::estimator> && requires {
    typename E::reads;
    { E::reports } -> std::convertible_to<bool>;
    { E::needs_halves } -> std::convertible_to<bool>;
    { E::needs_derivative } -> std::convertible_to<bool>;
};
}  // namespace detail

/// An estimator that judges a pixel as a whole, from sums of its own over the neighbours:  sum_q w(p,q) t(p,q) for each
/// of its terms t, worked out together with the filter's.
template <class E>
concept summing_estimator = detail::tells_what_it_needs<E> && E::sums >
0 && !E::needs_halves && !E::needs_derivative &&
    requires(const E e, const pixel_pair<float, typename E::reads>& pq, float* terms) {
    e.terms(pq, terms);
};

/// How wrong is the result?  An estimate of the squared error of one channel of one pixel, or of the pixel as a whole,
/// right on average: it may be negative.  An estimator that needs the derivative reads the buffer that is filtered, and
/// its variance.
template <class E>
concept estimator_policy = summing_estimator<E> ||
    (detail::tells_what_it_needs<E>&& requires(const E e, const pixel_estimate& x) {
        { e(x) } -> std::same_as<float>;
    });

}  // namespace winnow
