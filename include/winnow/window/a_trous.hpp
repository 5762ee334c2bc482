// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A square with holes: the same number of neighbours at every level, twice as far apart at each.
/// Holschneider, Kronland-Martinet, Morlet, Tchamitchian, "A Real-Time Algorithm for Signal Analysis with the Help of
/// the Wavelet Transform", 1989.
#include <winnow/core/error.hpp>
#include <winnow/window/concept.hpp>

namespace winnow::window {

/// The offsets (2^level i, 2^level j) with |i|, |j| <= radius.
struct a_trous {
    using role = role::window;

    int level = 0;
    int radius = 2;  ///< in taps

    constexpr int step() const { return 1 << level; }
    constexpr int reach() const { return radius << level; }
    constexpr int half_width(int) const { return reach(); }
    bool operator==(const a_trous&) const = default;

    void check() const {
        if (level < 0 || level > 16)
            fail("window: level is " + std::to_string(level) + ", it must be between 0 and 16");
        if (radius < 0 || radius > 1000)
            fail("window: radius is " + std::to_string(radius) + ", it must be between 0 and 1000 taps");
    }
};
static_assert(window_policy<a_trous>);

}  // namespace winnow::window
