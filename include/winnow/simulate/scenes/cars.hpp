// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A street in the evening sun: a parked taxi, a car that turns off and one that races by.  Striped as they are, they
/// smear along their own ways, and their wheels around: a filter must blur with the motion, and neither across it nor
/// over what stands still next to it.
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Three cars at 0, 12 and 40 pixels a shutter, in an image of 256x192.
struct cars {
    static std::string name() { return "cars"; }
    static std::string summary() { return "three cars at 0, 12 and 40 pixels a shutter, stripes and turning wheels"; }
    using shows = effects<effect::translation, effect::rotation, effect::area_light, effect::texture>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, disc> s;
        s.camera_at = [](double) {
            return camera{.eye = {2.2, -13, 6.2}, .target = {0.1, 0.2, 0.75}, .field_of_view = 37};
        };
        s.sky = [](const vec3& d) -> rgb { return rgb(0.15, 0.22, 0.36) + std::abs(d.z()) * rgb(0.02, 0.05, 0.14); };
        // Low, from beyond the left edge: long shadows.
        const int lamp = s.add(material{.name = "lamp", .emission = {106, 85, 57}});
        s.add(quad({-15, -8, 5}, {0, 5, 0}, {1.5, 0, 4}), lamp);

        const auto road = [](const place& p) -> rgb {
            const double x = p.rest.x(), y = p.rest.y();
            const bool dash = std::abs(y + 0.35) < 0.09 && stripe(x / 1.1) == 0;
            const bool crossing = x > -4.6 && x < -2.4 && stripe((y + 0.2) / 0.55) == 0;
            const bool worn = value_noise(5 * p.rest) < 0.3;
            if ((dash || crossing) && !worn) return {0.70, 0.68, 0.63};
            return grey(0.18 + 0.24 * fractal_noise(11 * p.rest, 4));
        };
        const auto flagstones = [](const place& p) -> rgb {
            const double x = p.rest.x() / 0.8, y = p.rest.y() / 0.8;
            const double joint = std::min(std::abs(std::remainder(x, 1)), std::abs(std::remainder(y, 1)));
            const double stone = 0.7 + 0.15 * checker(x, y) + 0.15 * value_noise(9 * p.rest);
            return (joint < 0.025 ? 0.3 : stone) * rgb(0.62, 0.59, 0.54);
        };
        const auto bricks = [](const place& p) -> rgb {
            const double x = p.rest.x(), z = p.rest.z(), bay = std::abs(std::remainder(x, 3.2));
            if (bay < 1.1 && z > 0.8 && z < 2.6) {
                if (bay > 1.02 || bay < 0.03 || z < 0.88 || z > 2.52) return {0.75, 0.72, 0.62};
                const bool blind = z > 1.1 + 1.3 * value_noise({std::floor(x / 1.6), 3, 0});
                return blind ? (stripe(z / 0.06) == 0 ? 1 : 0.45) * rgb(0.60, 0.52, 0.36) : rgb(0.03, 0.05, 0.07);
            }
            // Every other row is shifted by half a brick.
            const double row = std::floor(z / 0.2), along = x / 0.5 + 0.5 * stripe(row), brick = std::floor(along);
            if (z - 0.2 * row < 0.025 || along - brick < 0.05) return {0.55, 0.50, 0.45};
            return (0.6 + 0.5 * value_noise({7.3 * brick, 3.1 * row, 0.5})) * rgb(0.50, 0.20, 0.13);
        };
        const int street = s.add(material{.name = "street", .albedo = grey(1), .texture = road});
        const int pavement = s.add(material{.name = "pavement", .albedo = grey(1), .texture = flagstones});
        const int wall = s.add(material{.name = "wall", .albedo = grey(1), .texture = bricks});
        s.add(quad({-20, -14, 0}, {40, 0, 0}, {0, 18.6, 0}), street);
        s.add_box({0, 6.1, 0.08}, {20, 1.5, 0.08}, pavement);
        s.add(quad({-20, 7.6, 0}, {40, 0, 0}, {0, 0, 9}), wall);

        const auto windows = [](const place& p) -> rgb {
            const bool pillar = std::abs(std::remainder(2.2 * p.uv.x() + 0.1, 1)) < 0.04;
            return pillar ? grey(0.5) : rgb(0.04, 0.06, 0.08);
        };
        const auto grille = [](const place& p) -> rgb { return grey(stripe(14 * p.uv.x()) == 0 ? 0.63 : 0.1); };
        const auto spokes = [](const place& p) -> rgb {
            const double r = p.uv.norm();
            if (r > 0.74) return grey(r > 0.86 && r < 0.9 ? 0.4 : 0.025);  // the tyre
            return grey(r > 0.64 || r < 0.16 || spoke(p.uv, 10) == 0 ? 0.8 : 0.03);
        };
        const int glass = s.add(material{.name = "glass", .albedo = grey(1), .texture = windows});
        const int trim = s.add(material{.name = "trim", .albedo = grey(1), .texture = grille});
        const int wheel = s.add(material{.name = "wheel", .albedo = grey(1), .texture = spokes});

        // Five boxes and four wheels, at this place in the middle of the first shutter; the speed is in world units a
        // frame.
        const auto add_car = [&](const vec3& middle, double heading, double speed, int paint) {
            const vec3 along(std::cos(heading), std::sin(heading), 0), across(-along.y(), along.x(), 0);
            const auto at = [&](double x, double y, double z) -> vec3 {
                return middle + (x - speed / 2) * along + y * across + z * vec3::UnitZ();
            };
            const int body = s.add(motion{.velocity = speed * along});
            s.add_box(at(0, 0, 0.62), {1.9, 0.82, 0.3}, paint, body, heading);
            s.add_box(at(-0.25, 0, 1.15), {1.05, 0.72, 0.23}, glass, body, heading);
            s.add_box(at(-0.25, 0, 1.41), {1.1, 0.75, 0.03}, paint, body, heading);
            for (const double end : {-1.95, 1.95}) s.add_box(at(end, 0, 0.5), {0.07, 0.78, 0.12}, trim, body, heading);
            constexpr double radius = 0.42;
            for (const double x : {-1.2, 1.2})
                for (const double side : {-1.0, 1.0}) {
                    const vec3 hub = at(x, side * 0.85, radius);
                    const motion rolling{speed * along, hub, across, speed / radius};
                    s.add(disc(hub, side * across, radius), wheel, s.add(rolling));
                }
        };
        const auto checked = [](const place& p) -> rgb {
            const bool band = p.uv.y() > 0.42 && p.uv.y() < 0.74;
            return band ? grey(0.05 + 0.8 * checker(28 * p.uv.x(), 6 * p.uv.y())) : rgb(0.95, 0.66, 0.06);
        };
        const auto slanted = [](const place& p) -> rgb {
            return stripe(9 * p.uv.x() + 2 * p.uv.y()) == 0 ? rgb(0.86, 0.86, 0.82) : rgb(0.06, 0.22, 0.55);
        };
        const auto dashed = [](const place& p) -> rgb {
            if (std::abs(p.uv.y() - 0.5) > 0.16) return {0.72, 0.06, 0.05};
            return stripe(7 * p.uv.x()) == 0 ? rgb(0.90, 0.90, 0.85) : grey(0.08);
        };
        // The speeds are 0, 40 and 12 pixels.
        add_car({2.3, 3.5, 0}, 0, 0, s.add(material{.name = "taxi", .albedo = grey(1), .texture = checked}));
        add_car({-1.2, 0.8, 0}, pi, 1.62, s.add(material{.name = "racer", .albedo = grey(1), .texture = dashed}));
        add_car({1.5, -2.7, 0}, -0.45, 0.4, s.add(material{.name = "turning", .albedo = grey(1), .texture = slanted}));
        return s;
    }
};

}  // namespace winnow::simulate::scenes
