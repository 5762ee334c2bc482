// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The balls, seen from a camera that goes around them once in 64 frames: every surface is uncovered and covered, and
/// reflections move unlike what reflects them.
#include <winnow/simulate/scenes/balls.hpp>

namespace winnow::simulate::scenes {

/// A turn around the balls.
struct orbit {
    static std::string name() { return "orbit"; }
    static std::string summary() { return "once around the balls in 64 frames"; }
    using shows = balls::shows;
    static constexpr int frames = 64;  ///< then it begins again

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, disc, ellipsoid> s;
        balls::arrange(s);
        s.camera_at = [](double time) {
            const double turn = 2 * pi * time / frames - pi / 2;
            return camera{
                .eye = {8.3 * std::cos(turn), 8.3 * std::sin(turn), 2.9}, .target = {0, 0, 0.75}, .field_of_view = 44};
        };
        return s;
    }
};

}  // namespace winnow::simulate::scenes
