// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What an estimator is.
#include <concepts>
#include <winnow/core/role.hpp>
#include <winnow/frame/pixel_estimate.hpp>

namespace winnow {

/// How wrong is the result?  Never negative; 0 where nothing speaks of an error.
template <class E>
concept estimator_policy = plays<E, role::estimator> && requires(const E e, const pixel_estimate& x) {
    { E::reports } -> std::convertible_to<bool>;
    { E::needs_halves } -> std::convertible_to<bool>;
    { e(x) } -> std::same_as<float>;
};

}  // namespace winnow
