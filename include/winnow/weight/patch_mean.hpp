// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The mean of a weight over a square patch around both pixels: a pixel counts if its surroundings count.
/// Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012, as released by its authors.
#include <winnow/distance/patch.hpp>
#include <winnow/weight/concept.hpp>

namespace winnow::weight {

/// (1/|N|) sum over n in N of W(p + n, q + n), where N holds the offsets of the (2 radius + 1)^2 patch at which both
/// pixels exist.  Executors work it out ahead, as they do distance::patch.
template <weight_policy W>
struct patch_mean {
    using role = role::weight;
    using reads = typename W::reads;
    using prepares = W;

    W inner;
    int radius = 3;  ///< in pixels

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return detail::mean_over_patch(inner, radius, pq);
    }
    bool operator==(const patch_mean&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([r = radius](auto w) { return patch_mean<decltype(w)>{w, r}; }, inner);
    }
    /// How far beyond p and q it looks.
    int reach() const { return radius; }

    void check() const {
        if (radius < 0) fail("patch_mean: radius is " + std::to_string(radius) + ", it must be 0 or more");
    }
};

}  // namespace winnow::weight

namespace winnow {

template <weight_policy W>
constexpr auto patch_mean(W inner, distance::patch_numbers numbers = {}) {
    return weight::patch_mean<W>{inner, numbers.radius};
}

}  // namespace winnow
