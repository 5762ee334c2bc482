// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The effects of a lens and of a shutter with nothing else in the image, which is known in closed form: something in
/// focus that moves, and something at rest out of focus.
#include <algorithm>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Before a bright background, a defocused edge on the left and a black plane that moves on the right.  In an image of
/// 256x192 all rows are alike, and column x has the radiance `expected(x)` at frame 0.
struct ramp {
    static std::string name() { return "ramp"; }
    static std::string summary() { return "a defocused edge and a moving plane; the image is known in closed form"; }
    using shows = effects<effect::depth_of_field, effect::translation>;

    // Columns are numbers from 0 to 256; pixel x goes from x to x + 1.
    static constexpr double edge = 62.3;                   ///< the resting plane is on the left of this column
    static constexpr double blur = 12;                     ///< radius of the circle over which it is spread
    static constexpr double left = 116.5, right = 168.25;  ///< of the moving plane when the shutter opens
    static constexpr double speed = 40;                    ///< columns to the right while it is open

    static rgb background() { return {0.9, 0.7, 0.4}; }  ///< radiances
    static rgb foreground() { return {0.1, 0.2, 0.5}; }

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad> s;
        // At depth 1 the image is 1 wide, so that at depth z a column is z / 256.
        s.camera_at = [](double) {
            return camera{.field_of_view = 2 * std::atan(0.5) * 180 / pi, .lens_radius = lens, .focus = focus};
        };
        const auto plane = [](double z, double from, double to) {
            const double x = (from - 128) * z / 256, width = (to - from) * z / 256;
            return quad({x, z, -z}, {width, 0, 0}, {0, 0, 2 * z});
        };
        const int bright = s.add(material{.name = "background", .emission = background()});
        const int dim = s.add(material{.name = "foreground", .emission = foreground()});
        const int black = s.add(material{.name = "moving"});
        const int moving = s.add(motion{.velocity = {speed * focus / 256, 0, 0}});
        s.add(plane(8, -256, 512), bright);
        s.add(plane(near, -256, edge), dim);
        s.add(plane(focus, left, right), black, moving);
        return s;
    }

    /// The share of column x that a plane covers which ends at `edge` on its right.  A point out of focus is spread
    /// evenly over a disc: what lies beyond t radii of it is 1/2 - (asin t + t sqrt(1 - t^2)) / pi.
    static double defocused(int x) {
        const auto integral = [](double t) {  // from -infinity to t, of what is not covered
            if (t <= -1) return 0.0;
            if (t >= 1) return t;
            const double root = std::sqrt(1 - t * t);
            return t / 2 + (t * std::asin(t) + root - root * root * root / 3) / pi;
        };
        return 1 - blur * (integral((x + 1 - edge) / blur) - integral((x - edge) / blur));
    }

    /// The share of column x, and of the time, that the moving plane covers: a ramp from 0 to 1 over the way of an end.
    static double moved(int x) {
        const auto passed = [&](double end) {  // how much of column x is on the right of an end that moves
            const auto integral = [](double t) { return t <= 0 ? 0 : t >= 1 ? t - 0.5 : t * t / 2; };
            return speed * (integral((x + 1 - end) / speed) - integral((x - end) / speed));
        };
        return passed(left) - passed(right);
    }

    static rgb expected(int x) {
        const double covered = defocused(x);
        return covered * foreground() + (1 - covered - moved(x)) * background();
    }

private:
    static constexpr double focus = 4, near = 2;
    static constexpr double lens = blur / 256 / (1 / near - 1 / focus);  ///< c = R |1 / z_f - 1 / z| f, f = 256
};

}  // namespace winnow::simulate::scenes
