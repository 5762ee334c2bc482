// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A conference room: a table, eight chairs on thin legs, four lamps on the walls with wide penumbrae and one small
/// lamp in a shade with a hard edge.  Most of the noise is visibility.
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Soft shadows upon soft shadows, and light from wall to wall.
struct conference {
    static std::string name() { return "conference"; }
    static std::string summary() { return "a room with a table, chairs and five lamps: soft shadows, diffuse light"; }
    using shows = effects<effect::area_light, effect::global_illumination>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, frustum, ellipsoid> s;
        furnish(s);
        return s;
    }

    /// Camera, room and lamps; also for a room with something in its air.
    template <class Scene>
    static void furnish(Scene& s) {
        s.bounces = 4;
        s.camera_at = [](double) {
            return camera{.eye = {3.3, -2.75, 2.25}, .target = {-0.35, 0.35, 0.72}, .field_of_view = 66};
        };
        const auto paint = [&](const char* what, const rgb& albedo) { return s.add({.name = what, .albedo = albedo}); };
        const int plaster = paint("plaster", {0.72, 0.68, 0.60}), ceiling = paint("ceiling", {0.82, 0.82, 0.80});
        const int wood = paint("wood", {0.42, 0.24, 0.12}), dark_wood = paint("dark wood", {0.16, 0.09, 0.05});
        const int floor = paint("floor", {0.42, 0.36, 0.30}), rug = paint("rug", {0.42, 0.12, 0.10});
        const int rim = paint("rim", {0.70, 0.58, 0.36}), cloth = paint("cloth", {0.13, 0.27, 0.38});
        const int steel = paint("steel", {0.30, 0.30, 0.32}), shade = paint("shade", grey(0.01));
        const int paper = paint("paper", {0.85, 0.84, 0.80});
        const vec3 X = vec3::UnitX(), Y = vec3::UnitY(), Z = vec3::UnitZ();

        // The room, 8 x 6.4 x 2.9.
        s.add(quad({-4, -3.2, 0}, 8 * X, 6.4 * Y), floor);
        s.add(quad({-4, -3.2, 2.9}, 6.4 * Y, 8 * X), ceiling);
        for (const double y : {-3.2, 3.2}) s.add(quad({-4, y, 0}, 8 * X, 2.9 * Z), plaster);
        for (const double x : {-4.0, 4.0}) s.add(quad({x, -3.2, 0}, 6.4 * Y, 2.9 * Z), plaster);
        s.add_box({0, 3.18, 0.5}, {4, 0.02, 0.5}, dark_wood);
        s.add_box({-3.98, 0, 0.5}, {0.02, 3.2, 0.5}, dark_wood);
        s.add(quad({-2.7, -1.7, 0.004}, 5.4 * X, 3.4 * Y), rim);
        s.add(quad({-2.6, -1.6, 0.008}, 5.2 * X, 3.2 * Y), rug);

        // The table, and what lies on it.
        s.add_box({0, 0, 0.72}, {1.75, 0.65, 0.03}, wood);
        for (const double x : {-1.5, 1.5})
            for (const double y : {-0.5, 0.5}) s.add(frustum({x, y, 0}, {x, y, 0.7}, 0.03, 0.05), dark_wood);
        for (int i = 0; i < 6; ++i) {
            const double x = -1 + i % 3, y = i < 3 ? -0.38 : 0.38, turned = value_noise(vec3(i, 3, 0)) - 0.5;
            s.add_box({x, y, 0.755}, {0.105, 0.148, 0.004}, paper, 0, turned);
            s.add(frustum({x + 0.28, y, 0.75}, {x + 0.28, y, 0.86}, 0.035, 0.045), i % 2 == 0 ? paper : cloth);
        }

        const auto chair = [&](double x, double y, double yaw) {
            const vec3 at(x, y, 0), ahead(std::cos(yaw), std::sin(yaw), 0), aside = Z.cross(ahead);
            s.add_box(at + 0.45 * Z, {0.21, 0.21, 0.025}, cloth, 0, yaw);
            s.add_box(at - 0.21 * ahead + 0.82 * Z, {0.015, 0.21, 0.14}, cloth, 0, yaw);
            for (const double side : {-0.19, 0.19}) {
                const vec3 front = at + 0.19 * ahead + side * aside, back = at - 0.19 * ahead + side * aside;
                s.add(frustum(front, front + 0.45 * Z, 0.012, 0.012), steel);
                s.add(frustum(back - 0.05 * ahead, back + 0.9 * Z, 0.012, 0.012), steel);
            }
        };
        for (const double x : {-1.05, 0.0, 1.1}) {
            chair(x, -0.95, pi / 2 + 0.25 * x);
            chair(x + 0.08, 1.0, -pi / 2 + 0.3 * x);
        }
        chair(-2.15, 0.1, 0.2);
        chair(2.2, 0.0, pi - 0.35);

        // Pictures, a door.
        const auto picture = [&](double x, const rgb& albedo) {
            s.add_box({x, 3.18, 1.75}, {0.55, 0.02, 0.4}, dark_wood);
            s.add(quad({x - 0.5, 3.155, 1.4}, X, 0.7 * Z), paint("picture", albedo));
        };
        picture(-0.6, {0.65, 0.45, 0.15}), picture(1.35, {0.20, 0.40, 0.30});
        s.add_box({-3.97, -1.0, 1.05}, {0.04, 0.5, 1.05}, wood);

        // Lamps on two walls, as wide as a window, and a small one above the table.
        const int lamp = s.add({.name = "lamp", .emission = rgb(1.0, 0.80, 0.55) * 36});
        for (const double x : {-2.4, 0.4}) {
            s.add_box({x, 3.15, 2.2}, {0.34, 0.04, 0.16}, rim);
            s.add(quad({x - 0.3, 3.1, 2.08}, 0.6 * X, 0.24 * Z), lamp);
        }
        for (const double y : {-2.3, 0.9}) {
            s.add_box({-3.95, y, 2.2}, {0.04, 0.34, 0.16}, rim);
            s.add(quad({-3.9, y - 0.3, 2.08}, 0.6 * Y, 0.24 * Z), lamp);
        }
        const vec3 bulb(0.1, 0, 2.0);
        s.add(frustum(bulb - 0.08 * Z, bulb + 0.16 * Z, 0.22, 0.07), shade);
        s.add(frustum(bulb + 0.16 * Z, bulb + 0.9 * Z, 0.006, 0.006), steel);
        s.add(sphere(bulb, 0.03), s.add({.name = "bulb", .emission = rgb(0.95, 0.97, 1.0) * 2600}));
    }
};

}  // namespace winnow::simulate::scenes
