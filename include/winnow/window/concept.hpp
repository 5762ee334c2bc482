// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a window is.
#include <concepts>
#include <winnow/core/role.hpp>

namespace winnow {

/// Which neighbours are asked?  All offsets (dx, dy) with |dy| <= reach() and |dx| <= half_width(dy); a negative half
/// width means none in that row.  Symmetric in dx and dy, and it holds (0, 0).  A window with holes has, besides,
/// int step() const: of these offsets only those count of which dx and dy are multiples of it.
template <class W>
concept window_policy = plays<W, role::window> && requires(const W w, int dy) {
    { w.reach() } -> std::same_as<int>;
    { w.half_width(dy) } -> std::same_as<int>;
};

/// How many frames before and after the current one a window looks at: 0, unless it has  int frames_around() const.
template <window_policy W>
constexpr int frames_around(const W& window) {
    if constexpr (requires { window.frames_around(); }) return window.frames_around();
    else return 0;
}

/// How far apart the offsets of a window are: 1, unless it has  int step() const.
template <window_policy W>
constexpr int step(const W& window) {
    if constexpr (requires { window.step(); }) return window.step();
    else return 1;
}

/// The number of offsets in a window, of one frame.
template <window_policy W>
constexpr long long area(const W& window) {
    long long count = 0;
    for (int dy = -window.reach(); dy <= window.reach(); ++dy)
        if (const int half = window.half_width(dy); half >= 0 && dy % step(window) == 0)
            count += 2LL * (half / step(window)) + 1;
    return count;
}

}  // namespace winnow
