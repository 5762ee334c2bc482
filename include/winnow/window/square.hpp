// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// All offsets with |dx|, |dy| <= radius.
#include <winnow/core/error.hpp>
#include <winnow/window/concept.hpp>

namespace winnow::window {

struct square {
    using role = role::window;

    int radius = 10;  ///< in pixels; the window is 2 radius + 1 wide

    constexpr int reach() const { return radius; }
    constexpr int half_width(int) const { return radius; }
    bool operator==(const square&) const = default;

    void check() const {
        if (radius < 0) fail("window: radius is " + std::to_string(radius) + ", it must be 0 or more");
    }
};
static_assert(window_policy<square>);

}  // namespace winnow::window
