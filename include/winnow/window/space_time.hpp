// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A square in each of several frames of an animation, at the same place in all.
/// Buades, Coll, Morel, "Nonlocal Image and Movie Denoising", 2008.
#include <winnow/core/error.hpp>
#include <winnow/window/concept.hpp>

namespace winnow::window {

/// The square window of the current frame, and the same of up to `frames` frames before it and after it, as far as the
/// frame_sequence has them.
struct space_time {
    using role = role::window;

    int radius = 10;  ///< in pixels
    int frames = 1;   ///< on either side

    constexpr int reach() const { return radius; }
    constexpr int half_width(int) const { return radius; }
    constexpr int frames_around() const { return frames; }
    bool operator==(const space_time&) const = default;

    void check() const {
        if (radius < 0 || frames < 0)
            fail("window: the radius is " + std::to_string(radius) + ", of " + std::to_string(frames) +
                 " frames on either side; they must be 0 or more");
    }
};
static_assert(window_policy<space_time>);

}  // namespace winnow::window
