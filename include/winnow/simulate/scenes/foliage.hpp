// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A tree in front of a stone wall, in the sun: leaves smaller than the window of any filter, in light that has come
/// through leaves, some of them blurred by the lens.  Normals, depths and textures are nearly as noisy as the colours.
#include <array>
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// 3000 triangles as leaves on 12 branches.
struct foliage {
    static std::string name() { return "foliage"; }
    static std::string summary() { return "3000 leaf triangles in the sun before a stone wall, with depth of field"; }
    using shows = effects<effect::depth_of_field, effect::area_light, effect::texture, effect::global_illumination>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, triangle, frustum, ellipsoid> s;
        // The branches that come nearest are blurred over 8 pixels, the wall over 2; see scenes::chess.
        s.camera_at = [](double) {
            return camera{
                .eye = {0.3, -6, 1.7}, .target = {0, 0, 1.75}, .field_of_view = 40, .lens_radius = 0.09, .focus = 5.8};
        };
        s.sky = [](const vec3& d) -> rgb { return rgb(0.40, 0.46, 0.52) + std::abs(d.z()) * rgb(-0.20, -0.10, 0.16); };
        s.bounces = 3;
        const int sun = s.add(material{.name = "sun", .emission = {7600, 6500, 4900}});
        s.add(sphere({-22, -22, 26}, 0.8), sun);

        const auto stones = [](const place& p) -> rgb {
            // Courses of stones, each broken elsewhere; edges and joints are crooked.
            const double crooked = 0.08 * (value_noise(4 * p.rest) - 0.5);
            const double z = (p.rest.z() + crooked) / 0.42, course = std::floor(z);
            const double x = (p.rest.x() + crooked) / (0.55 + 0.3 * value_noise({course, 0, 7})) + 0.37 * course;
            const double stone = std::floor(x), from_side = std::min(x - stone, stone + 1 - x);
            const double from_course = std::min(z - course, course + 1 - z);
            if (std::min(1.5 * from_side, from_course) < 0.06) return grey(0.10 + 0.1 * value_noise(20 * p.rest));
            const rgb tint = rgb(0.34, 0.31, 0.27) + value_noise({stone, course, 3}) * rgb(0.10, 0.04, -0.04);
            return (0.7 + 0.6 * value_noise({stone, course, 1}) * fractal_noise(3 * p.rest, 4)) * tint;
        };
        const auto earth = [](const place& p) -> rgb { return fractal_noise(8 * p.rest, 4) * rgb(0.42, 0.36, 0.18); };
        const auto rind = [](const place& p) -> rgb {
            return (0.3 + fractal_noise({14 * p.rest.x(), 14 * p.rest.y(), 4 * p.rest.z()}, 3)) * rgb(0.30, 0.22, 0.15);
        };
        // The rib is where v is 0; veins go out from it at an angle.
        const auto veins = [](const place& p) -> rgb {
            const bool vein = p.uv.y() < 0.06 || std::abs(std::remainder(7 * (p.uv.x() - 0.3 * p.uv.y()), 1)) < 0.1;
            return grey(vein ? 1.0 : 0.72);
        };
        const int wall = s.add(material{.name = "wall", .albedo = grey(1), .texture = stones});
        const int ground = s.add(material{.name = "ground", .albedo = grey(1), .texture = earth});
        const int bark = s.add(material{.name = "bark", .albedo = grey(1), .texture = rind});
        const std::array leaf_colours{rgb(0.20, 0.42, 0.07), rgb(0.30, 0.50, 0.08), rgb(0.12, 0.32, 0.09),
                                      rgb(0.62, 0.46, 0.06), rgb(0.66, 0.22, 0.05)};
        std::array<int, 5> leaf{};
        for (std::size_t i = 0; i < leaf.size(); ++i)
            leaf[i] = s.add(material{.name = "leaf", .albedo = leaf_colours[i], .texture = veins});

        s.add(quad({-9, 2.2, 0}, {18, 0, 0}, {0, 0, 8}), wall);
        s.add(quad({-9, -9, 0}, {18, 0, 0}, {0, 11.2, 0}), ground);
        s.add(frustum({-1.7, 0.5, 0}, {-1.5, 0.4, 4.5}, 0.24, 0.13), bark);

        // On the lattice, value_noise is a hash.
        const auto chance = [](int branch, int number, int what) { return value_noise(vec3(branch, number, what)); };
        const auto between = [](double low, double high, double share) { return low + share * (high - low); };
        for (int b = 0; b < 12; ++b) {
            const vec3 from(-1.6, 0.45, 0.5 + 0.27 * b);
            const double azimuth = between(-1.2, 0.4, (5 * b % 12 + chance(b, 0, 0)) / 12);
            const double length = between(2.8, 4.2, chance(b, 0, 1)), rise = between(0, 0.45, chance(b, 0, 2));
            const vec3 along = vec3(std::cos(azimuth), std::sin(azimuth), rise).normalized();
            s.add(frustum(from, from + length * along, 0.06, 0.01), bark);
            const basis around(along);
            for (int i = 1; i <= 125; ++i) {
                const double turn = 2 * pi * chance(b, i, 0), size = between(0.20, 0.36, chance(b, i, 1));
                const vec3 stem = from + between(0.2, 1.0, chance(b, i, 2)) * length * along;
                const vec3 out = around.to_world({std::cos(turn), std::sin(turn), 0.5}) - 0.4 * vec3::UnitZ();
                const vec3 rib = out.normalized();
                const vec3 tilt(between(-0.8, 0.8, chance(b, i, 3)), between(-1.2, 0.2, chance(b, i, 4)), 1);
                const vec3 side = rib.cross(tilt).normalized(), up = side.cross(rib);
                // Two triangles, folded along the rib.
                const vec3 base = stem + 0.3 * size * rib, tip = base + size * rib;
                const vec3 middle = base + size * (0.4 * rib + 0.08 * up), half_width = 0.28 * size * side;
                const double hue = chance(b, i, 5);
                const int colour = leaf[hue < 0.9 ? static_cast<std::size_t>(hue / 0.3) : hue < 0.97 ? 3 : 4];
                s.add(triangle(base, tip, middle + half_width), colour);
                s.add(triangle(base, tip, middle - half_width), colour);
            }
        }
        return s;
    }
};

}  // namespace winnow::simulate::scenes
