// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Two mirror rings and a glass ball on a white table, lit by one small lamp.  The bright curves that they throw come
/// by photons; normals and albedo do not know of them, and the density of photons does.
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Caustics: a nephroid in each ring, a focus under the glass.
struct rings {
    static std::string name() { return "rings"; }
    static std::string summary() { return "mirror rings and a glass ball under a small lamp: caustics"; }
    using shows = effects<effect::caustics, effect::mirror, effect::area_light>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, frustum, ellipsoid> s;
        s.camera_at = [](double) {
            return camera{.eye = {0.4, -5.8, 5.8}, .target = {0.1, -0.15, 0.1}, .field_of_view = 40};
        };
        s.photons_per_sample = 3;

        // A table of tiles in two shades.
        const int light = s.add({.name = "light tile", .albedo = {0.80, 0.78, 0.74}});
        const int dark = s.add({.name = "dark tile", .albedo = {0.66, 0.63, 0.58}});
        for (int y = -5; y < 8; ++y)
            for (int x = -8; x < 8; ++x) {
                const vec3 corner(1.2 * x, 1.2 * y, 0);
                s.add(quad(corner, 1.2 * vec3::UnitX(), 1.2 * vec3::UnitY()), (x + y) % 2 == 0 ? light : dark);
            }

        const auto ring = [&](double x, double y, double radius, double height, int material) {
            // The inside, the outside, and a bevel that joins them.
            const double edge = 0.04;
            const vec3 base(x, y, 0), bevel(x, y, height - edge), top(x, y, height);
            s.add(frustum(base, top, radius, radius), material);
            s.add(frustum(base, bevel, radius + edge, radius + edge), material);
            s.add(frustum(bevel, top, radius + edge, radius), material);
        };
        const int silver = s.add({.name = "silver", .f0 = {0.93, 0.92, 0.90}});
        const int gold = s.add({.name = "gold", .f0 = {0.95, 0.72, 0.35}});
        ring(-1.15, 0.45, 1.5, 0.75, silver);
        ring(1.35, -1.2, 0.85, 0.5, gold);

        const int glass = s.add({.name = "glass", .ior = 1.5});
        s.add(sphere({1.75, 1.0, 0.62}, 0.62), glass);

        // Something to be mirrored.
        const auto ball = [&](double x, double y, double radius, const rgb& albedo) {
            s.add(sphere({x, y, radius}, radius), s.add({.name = "paint", .albedo = albedo}));
        };
        ball(-2.35, -1.45, 0.22, {0.75, 0.16, 0.10});
        ball(-0.5, -1.75, 0.16, {0.12, 0.35, 0.70});
        ball(1.95, 2.0, 0.25, {0.15, 0.50, 0.22});
        ball(2.75, 0.1, 0.18, {0.80, 0.55, 0.12});

        // A square lamp from the left that looks at the table's middle.
        const vec3 lamp(-4.9, -0.9, 3.4);
        const basis frame(-lamp.normalized());
        s.add(quad(lamp - 0.15 * (frame.s + frame.t), 0.3 * frame.s, 0.3 * frame.t),
              s.add({.name = "lamp", .emission = rgb(1.0, 0.93, 0.82) * 850}));
        s.sky = [](const vec3& direction) { return rgb(rgb(0.10, 0.13, 0.20) * (0.5 + 0.5 * direction.z())); };
        return s;
    }
};

}  // namespace winnow::simulate::scenes
