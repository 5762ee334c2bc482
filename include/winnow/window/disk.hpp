// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// All offsets with dx^2 + dy^2 <= radius^2.
#include <winnow/core/error.hpp>
#include <winnow/window/concept.hpp>

namespace winnow::window {

struct disk {
    using role = role::window;

    int radius = 10;  ///< in pixels

    constexpr int reach() const { return radius; }
    constexpr int half_width(int dy) const {
        const long long r = radius, y = dy, free = r * r - y * y;
        int half = -1;
        for (long long x = 0; x * x <= free; ++x) ++half;
        return half;
    }
    bool operator==(const disk&) const = default;

    void check() const {
        if (radius < 0) fail("window: radius is " + std::to_string(radius) + ", it must be 0 or more");
    }
};
static_assert(window_policy<disk>);

}  // namespace winnow::window
