// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The larger of the distances along both axes, in pixels: cutoff(chessboard, r) is 1 in a square of radius r.
#include <winnow/distance/concept.hpp>

namespace winnow::distance {

struct chessboard {
    using role = role::distance;
    using reads = planes<>;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        const Real x = pq.dx(), y = pq.dy();
        return math::max(math::max(x, -x), math::max(y, -y));
    }
    bool operator==(const chessboard&) const = default;
};
static_assert(distance_policy<chessboard>);

}  // namespace winnow::distance

namespace winnow {
inline constexpr distance::chessboard chessboard{};
}
