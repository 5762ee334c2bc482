// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What an estimator is.
#include <concepts>
#include <winnow/core/role.hpp>
#include <winnow/frame/pixel_estimate.hpp>
#include <winnow/frame/planes.hpp>

namespace winnow {

/// How wrong is the result?  An estimate of the squared error of one channel of one pixel, right on average: it may be
/// negative.  An estimator that needs the derivative reads the buffer that is filtered, and its variance.
template <class E>
concept estimator_policy = plays<E, role::estimator> && requires(const E e, const pixel_estimate& x) {
    typename E::reads;
    { E::reports } -> std::convertible_to<bool>;
    { E::needs_halves } -> std::convertible_to<bool>;
    { E::needs_derivative } -> std::convertible_to<bool>;
    { e(x) } -> std::same_as<float>;
};

}  // namespace winnow
