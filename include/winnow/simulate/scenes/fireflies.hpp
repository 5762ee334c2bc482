// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A Cornell box with a dim lamp in the ceiling and a spark behind a glossy panel, a thousand times as bright, which
/// paths find by chance: in the mirror ball, in the panel and on glossy metal.  Single samples outshine a whole pixel.
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Outliers, for filters that must survive them.
struct fireflies {
    static std::string name() { return "fireflies"; }
    static std::string summary() { return "a Cornell box with a tiny, very bright light: outliers"; }
    using shows =
        effects<effect::fireflies, effect::glossy, effect::mirror, effect::global_illumination, effect::area_light>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, ellipsoid> s;
        s.camera_at = [](double) { return camera{.eye = {0, -3.9, 1.0}, .target = {0, 0, 0.93}, .field_of_view = 42}; };
        s.bounces = 6;
        const vec3 X = vec3::UnitX(), Y = vec3::UnitY(), Z = vec3::UnitZ();
        const int white = s.add({.name = "white", .albedo = grey(0.73)});
        s.add(quad({-1.25, -1, 0}, 2.5 * X, 2 * Y), white);
        s.add(quad({-1.25, -1, 2}, 2 * Y, 2.5 * X), white);
        s.add(quad({-1.25, 1, 0}, 2.5 * X, 2 * Z), white);
        s.add(quad({-1.25, -1, 0}, 2 * Y, 2 * Z), s.add({.name = "red", .albedo = {0.63, 0.06, 0.05}}));
        s.add(quad({1.25, -1, 0}, 2 * Z, 2 * Y), s.add({.name = "green", .albedo = {0.14, 0.45, 0.09}}));

        const int panel = s.add({.name = "panel", .albedo = grey(0.08), .f0 = grey(0.6), .roughness = 0.3});
        s.add_box({-0.62, 0.0, 0.42}, {0.34, 0.02, 0.42}, panel, 0, 0.8);
        s.add(sphere({0.62, -0.05, 0.38}, 0.38), s.add({.name = "mirror ball", .f0 = {0.92, 0.91, 0.88}}));
        s.add(ellipsoid({0.12, 0.5, 0.55}, {0.28, 0.28, 0.55}),
              s.add({.name = "brass", .albedo = {0.05, 0.04, 0.02}, .f0 = {0.85, 0.65, 0.30}, .roughness = 0.35}));
        s.add_box({-0.1, -0.55, 0.12}, {0.12, 0.12, 0.12}, white, 0, 0.5);

        s.add(quad({-0.3, -0.3, 1.99}, 0.6 * Y, 0.6 * X),
              s.add({.name = "lamp", .emission = rgb(1.0, 0.85, 0.65) * 8}));
        // Thousands of times as bright as the walls, and chosen less often than the lamp: what it lights is noisy, too.
        s.add(sphere({-0.85, 0.55, 0.3}, 0.02),
              s.add({.name = "spark", .emission = rgb(0.75, 0.88, 1.0) * 1.1e3, .selection = 0.5}));
        return s;
    }
};

}  // namespace winnow::simulate::scenes
