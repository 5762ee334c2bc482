// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a weight is.
#include <winnow/distance/concept.hpp>

namespace winnow {

/// How much does q count for p?  0 <= w(pq) <= 1, and 1 for identical pixels.
template <class W>
concept weight_policy = plays<W, role::weight> && requires(const W w, const pixel_pair<float, typename W::reads>& pq) {
    { w(pq) } -> std::same_as<float>;
};

/// A weight of the form exp(-x) that can tell its x >= 0.  Minima and products of such weights are again of this form,
/// with the larger x and the sum of both: one exponential in all.
template <class W>
concept exponential_weight = weight_policy<W> && requires(const W w, const pixel_pair<float, typename W::reads>& pq) {
    { w.exponent(pq) } -> std::same_as<float>;
};

}  // namespace winnow
