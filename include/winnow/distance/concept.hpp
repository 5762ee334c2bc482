// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a distance is.
#include <concepts>
#include <winnow/core/expression.hpp>
#include <winnow/core/math.hpp>
#include <winnow/core/role.hpp>
#include <winnow/frame/pixel_pair.hpp>

namespace winnow {

/// How unlike are two pixels?  Never positive for identical pixels; negative where noise explains more than is seen.
template <class D>
concept distance_policy = plays<D, role::distance> &&
    requires(const D d, const pixel_pair<float, typename D::reads>& pq) {
    { d(pq) } -> std::same_as<float>;
};

}  // namespace winnow
