// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The five taps (1, 4, 6, 4, 1) / 16 that refine a cubic B-spline, along both axes.
#include <winnow/core/error.hpp>
#include <winnow/weight/concept.hpp>

namespace winnow::weight {

/// With taps `step` pixels apart, of each axis 1, 2/3 and 1/6 for the taps 0, 1 and 2, and 0 beyond: the parabola
/// 1 - t / 4 - t^2 / 12 goes through all three.
struct b3_spline {
    using role = role::weight;
    using reads = planes<>;

    int step = 1;  ///< in pixels

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        const Real per_pixel(1.0f / static_cast<float>(step));
        const auto along = [&](const Real& d) WINNOW_HD_LAMBDA {
            const Real t = math::max(d, -d) * per_pixel;
            return math::max(Real(1) - t * (Real(0.25f) + t * Real(1.0f / 12)), Real(0));
        };
        return along(pq.dx()) * along(pq.dy());
    }
    bool operator==(const b3_spline&) const = default;

    void check() const {
        if (step < 1) fail("b3_spline: step is " + std::to_string(step) + ", it must be 1 or more");
    }
};
static_assert(weight_policy<b3_spline>);

}  // namespace winnow::weight
