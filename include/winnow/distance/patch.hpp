// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The mean of a distance over a square patch around both pixels.
/// Buades, Coll, Morel, "A Review of Image Denoising Algorithms, with a New One", 2005.
#include <winnow/core/error.hpp>
#include <winnow/distance/concept.hpp>

namespace winnow {

namespace detail {
/// The mean of policy(p + n, q + n) over the offsets |n| <= radius at which both pixels exist.
template <class Policy, class Real, class Planes>
WINNOW_HD Real mean_over_patch(const Policy& policy, int radius, const pixel_pair<Real, Planes>& pq) {
    Real sum(0), count(0);
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            const auto shifted = pq.shifted(x, y);
            const Real covered = shifted.covered();
            sum = math::fma(covered, policy(shifted), sum);
            count = count + covered;
        }
    return sum / math::max(count, Real(1));
}
}  // namespace detail

namespace distance {

/// (1/|N|) sum over n in N of D(p + n, q + n), where N holds the offsets of the (2 radius + 1)^2 patch at which both
/// pixels exist.  As a policy it is evaluated pixel by pixel, at a cost that grows with the patch; executors that know
/// it from its `prepares` work it out ahead for a whole tile, at a cost that does not.
template <distance_policy D>
struct patch {
    using role = role::distance;
    using reads = typename D::reads;
    using prepares = D;

    D inner;
    int radius = 3;  ///< in pixels

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return detail::mean_over_patch(inner, radius, pq);
    }
    bool operator==(const patch&) const = default;

    template <class F>
    constexpr auto decompose(F f) const {
        return f([r = radius](auto d) { return patch<decltype(d)>{d, r}; }, inner);
    }
    /// How far beyond p and q it looks.
    int reach() const { return radius; }

    void check() const {
        if (radius < 0) fail("patch: radius is " + std::to_string(radius) + ", it must be 0 or more");
    }
};

/// The numbers of a patch, for use with designators:  patch(d, {.radius = 1}).
struct patch_numbers {
    int radius = 3;
};

}  // namespace distance

template <distance_policy D>
constexpr auto patch(D inner, distance::patch_numbers numbers = {}) {
    return distance::patch<D>{inner, numbers.radius};
}

}  // namespace winnow
