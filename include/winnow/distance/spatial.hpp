// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Squared distance in the image plane, in pixels squared.
#include <winnow/distance/concept.hpp>

namespace winnow::distance {

struct spatial {
    using role = role::distance;
    using reads = planes<>;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return pq.dx() * pq.dx() + pq.dy() * pq.dy();
    }
    bool operator==(const spatial&) const = default;
};
static_assert(distance_policy<spatial>);

}  // namespace winnow::distance

namespace winnow {
inline constexpr distance::spatial spatial{};
}
