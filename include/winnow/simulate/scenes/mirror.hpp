// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Sixty coloured balls, a lattice of thin bars and a mirror ball before a plane mirror and a glossy wall.  Half of
/// what is seen is seen at the second hit.
#include <algorithm>
#include <vector>
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Reflections with as much detail as what they reflect.
struct mirror {
    static std::string name() { return "mirror"; }
    static std::string summary() { return "coloured balls and thin bars before a mirror and a glossy wall"; }
    using shows = effects<effect::mirror, effect::glossy, effect::global_illumination, effect::area_light>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, frustum, ellipsoid> s;
        s.camera_at = [](double) {
            return camera{.eye = {1.9, -5.2, 2.3}, .target = {-0.42, 0.3, 0.85}, .field_of_view = 46};
        };
        s.bounces = 5;
        const vec3 X = vec3::UnitX(), Y = vec3::UnitY(), Z = vec3::UnitZ();

        // A room open towards the viewer: a mirror at the back, a glossy wall on the left.
        const int white = s.add({.name = "white", .albedo = {0.75, 0.73, 0.70}});
        s.add(quad({-3, -6, 0}, 6 * X, 8.5 * Y), s.add({.name = "floor", .albedo = {0.45, 0.43, 0.42}}));
        s.add(quad({-3, -6, 3.6}, 8.5 * Y, 6 * X), white);
        s.add(quad({3, -6, 0}, 8.5 * Y, 3.6 * Z), s.add({.name = "right wall", .albedo = {0.60, 0.38, 0.22}}));
        s.add(quad({-3, 2.5, 0}, 6 * X, 3.6 * Z), white);
        // Behind the viewer, for the mirrors: stripes.
        const int blue = s.add({.name = "blue", .albedo = {0.18, 0.30, 0.48}});
        for (int i = 0; i < 12; ++i) s.add(quad({-3 + 0.5 * i, -6, 0}, 3.6 * Z, 0.5 * X), i % 2 == 0 ? blue : white);
        const int dark = s.add({.name = "frame", .albedo = {0.08, 0.06, 0.05}});
        s.add_box({0.2, 2.47, 1.45}, {2.3, 0.03, 1.3}, dark);
        s.add(quad({-2, 2.43, 0.25}, 4.4 * X, 2.4 * Z), s.add({.name = "mirror", .f0 = grey(0.9)}));
        // A GGX alpha of 0.05.
        s.add(
            quad({-3, -6, 0}, 8.5 * Y, 3.6 * Z),
            s.add(
                {.name = "glossy wall", .albedo = {0.06, 0.08, 0.11}, .f0 = {0.62, 0.66, 0.70}, .roughness = 0.2236}));

        // Balls on the floor where there is room for them.
        const auto random = [](int i, int k) { return value_noise(vec3(i, k, 5)); };
        std::vector<ellipsoid> balls{sphere({0.75, 0.55, 0.62}, 0.62)};
        s.add(balls[0], s.add({.name = "mirror ball", .f0 = {0.92, 0.90, 0.86}}));
        for (int i = 0; balls.size() < 61; ++i) {
            const double r = 0.09 + 0.2 * random(i, 0) * random(i, 1), turn = 2 * pi * random(i, 2);
            const double far = 1.9 * std::sqrt(random(i, 3));
            const vec3 at(far * std::cos(turn), 0.2 + 0.95 * far * std::sin(turn), r);
            const auto apart = [&](const ellipsoid& b) { return (b.centre() - at).norm() > b.radii().x() + r + 0.02; };
            if (!std::all_of(balls.begin(), balls.end(), apart)) continue;
            balls.push_back(sphere(at, r));
            const rgb hue = 0.5 + 0.5 * (2 * pi * (random(i, 4) + rgb(0, 0.33, 0.67))).cos();
            s.add(balls.back(), s.add({.name = "ball", .albedo = 0.08 + 0.72 * hue}));
        }

        // A lattice of bars before the glossy wall.
        const int brass = s.add({.name = "bar", .albedo = {0.75, 0.55, 0.22}});
        for (int i = 0; i <= 8; ++i) {
            const double y = -2 + 0.5 * i;
            s.add(frustum({-2.5, y, 0}, {-2.5, y, 2.4}, 0.022, 0.022), brass);
        }
        for (int i = 0; i < 5; ++i) {
            const double z = 0.4 + 0.5 * i;
            s.add(frustum({-2.5, -2, z}, {-2.5, 2, z}, 0.022, 0.022), brass);
        }

        const int lamp = s.add({.name = "lamp", .emission = rgb(1.0, 0.94, 0.85) * 6.5});
        s.add(quad({-2.2, -1.4, 3.58}, 2.6 * Y, 2.2 * X), lamp);
        s.add(quad({0.6, -4.8, 3.58}, 2 * Y, 1.8 * X), lamp);
        return s;
    }
};

}  // namespace winnow::simulate::scenes
