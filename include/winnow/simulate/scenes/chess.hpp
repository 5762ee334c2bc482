// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The end of a game, through a wide lens: carved pieces on a board of wood, the second row in focus and everything in
/// front of it and behind it blurred.  A filter must keep the carving where it is sharp, and smooth textures, shadows
/// and normals that the lens has made noisy where it is not.
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Eight pieces on a board of 6x6, with depth of field.
struct chess {
    static std::string name() { return "chess"; }
    static std::string summary() { return "carved chess pieces, out of focus by up to 12 pixels"; }
    using shows = effects<effect::depth_of_field, effect::area_light, effect::texture, effect::bump>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, disc, ellipsoid, frustum> s;
        // A point at depth z becomes a disc of radius c = lens_radius |1 / focus - 1 / z| f pixels, in an image of
        // 256x192, where f = (256 / 2) / tan(46 / 2 degrees) = 302:
        //     the captured pawn, in front of the board   z = 3.4          c = 12
        //     the second row                             z = 5.2 to 5.5   c = 0 to 1.1
        //     the last row                               z = 9.2          c = 10
        //     the wall                                   z = 10.4         c = 11
        s.camera_at = [](double) {
            return camera{.eye = {0.6, -3.2, 3.0},
                          .target = {0, 1.9, 0.4},
                          .field_of_view = 46,
                          .lens_radius = 0.4,
                          .focus = 5.25};
        };
        s.sky = [](const vec3&) -> rgb { return {0.15, 0.18, 0.24}; };
        const int window = s.add(material{.name = "window", .emission = {64, 56, 44}});
        s.add(quad({-9, -2, 5.5}, {0, 3, 0}, {2.0, 0, 3}), window);

        // Squares are of side 1, with corners at whole numbers.
        const auto squares = [](const place& p) -> rgb {
            const double x = p.rest.x(), y = p.rest.y();
            const int dark = checker(x, y);
            // Rings of a tree that lies along y, anew in each square.
            const vec3 trunk(x + 5.3 * std::floor(x) + 2.7 * std::floor(y), 0.15 * y, 3.1 * dark);
            const double grain = 0.75 + 0.25 * std::sin(40 * (trunk.x() + 0.25 * fractal_noise(3 * trunk, 3)));
            return grain * (dark ? rgb(0.26, 0.11, 0.05) : rgb(0.72, 0.54, 0.32));
        };
        const auto cloth = [](const place& p) -> rgb {
            const bool thread = stripe(7 * (p.rest.x() + p.rest.y())) == stripe(7 * (p.rest.x() - p.rest.y()));
            return thread ? rgb(0.10, 0.26, 0.16) : rgb(0.06, 0.17, 0.11);
        };
        const auto wallpaper = [](const place& p) -> rgb {
            const double x = p.rest.x(), z = p.rest.z();
            if (vec2(std::remainder(x, 0.8), std::remainder(z, 0.8)).norm() < 0.18) return {0.85, 0.70, 0.28};
            return stripe(x / 0.4 + 0.5) == 0 ? rgb(0.26, 0.07, 0.08) : rgb(0.40, 0.11, 0.10);
        };
        const int table = s.add(material{.name = "table", .albedo = grey(1), .texture = cloth});
        const int board = s.add(material{.name = "board", .albedo = grey(1), .texture = squares});
        const int frame = s.add(material{.name = "frame", .albedo = {0.16, 0.06, 0.03}});
        const int wall = s.add(material{.name = "wall", .albedo = grey(1), .texture = wallpaper});
        s.add(quad({-9, -4, -0.2}, {18, 0, 0}, {0, 11.2, 0}), table);
        s.add(quad({-3, 0, 0}, {6, 0, 0}, {0, 6, 0}), board);
        s.add_box({0, 3, -0.11}, {3.25, 3.25, 0.1}, frame);
        s.add(quad({-9, 7.2, -0.2}, {18, 0, 0}, {0, 0, 9}), wall);

        // A piece stands in the middle of its square: what is carved around its axis follows from the place.
        const auto carving = [](const place& p) -> double {
            const double x = p.rest.x() - std::floor(p.rest.x()) - 0.5, y = p.rest.y() - std::floor(p.rest.y()) - 0.5;
            const double around = 10 * std::atan2(y, x), up = 30 * p.rest.z();
            return 0.012 * std::sin(around + up) * std::sin(around - up);
        };
        const auto ivory_grain = [](const place& p) -> rgb {
            return (0.8 + 0.2 * fractal_noise({8 * p.rest.x(), 8 * p.rest.y(), 2 * p.rest.z()}, 3)) *
                   rgb(0.86, 0.78, 0.62);
        };
        const auto ebony_grain = [](const place& p) -> rgb {
            return (0.5 + 1.0 * fractal_noise({9 * p.rest.x(), 9 * p.rest.y(), 2 * p.rest.z()}, 3)) *
                   rgb(0.17, 0.10, 0.08);
        };
        const int ivory =
            s.add(material{.name = "ivory", .albedo = grey(1), .texture = ivory_grain, .height = carving});
        const int ebony =
            s.add(material{.name = "ebony", .albedo = grey(1), .texture = ebony_grain, .height = carving});

        // Foot, stem and collar; returns the place on top.
        const auto add_stem = [&](const vec3& foot, double height, int wood) -> vec3 {
            const auto up = [&](double z) -> vec3 { return foot + z * vec3::UnitZ(); };
            s.add(frustum(up(0), up(0.12), 0.38, 0.38), wood);
            s.add(ellipsoid(up(0.12), {0.38, 0.38, 0.09}), wood);
            s.add(frustum(up(0.15), up(height), 0.27, 0.14), wood);
            s.add(ellipsoid(up(height), {0.23, 0.23, 0.05}), wood);
            return up(height);
        };
        const auto add_pawn = [&](const vec3& foot, int wood) {
            s.add(sphere(add_stem(foot, 0.6, wood) + vec3(0, 0, 0.2), 0.21), wood);
        };
        const auto add_rook = [&](const vec3& foot, int wood) {
            const vec3 top = add_stem(foot, 0.75, wood), rim = top + vec3(0, 0, 0.3);
            s.add(frustum(top, rim, 0.22, 0.27), wood);
            s.add(disc(rim - vec3(0, 0, 0.06), {0, 0, 1}, 0.26), wood);
        };
        const auto add_bishop = [&](const vec3& foot, int wood) {
            const vec3 top = add_stem(foot, 0.85, wood);
            s.add(ellipsoid(top + vec3(0, 0, 0.27), {0.19, 0.19, 0.28}), wood);
            s.add(sphere(top + vec3(0, 0, 0.58), 0.06), wood);
        };
        const auto add_king = [&](const vec3& foot, int wood) {
            const vec3 top = add_stem(foot, 1.05, wood), crown = top + vec3(0, 0, 0.36);
            s.add(frustum(top, crown, 0.14, 0.27), wood);
            s.add(ellipsoid(crown, {0.27, 0.27, 0.1}), wood);
            s.add(ellipsoid(crown + vec3(0, 0, 0.22), {0.05, 0.05, 0.16}), wood);
            s.add(ellipsoid(crown + vec3(0, 0, 0.24), {0.14, 0.05, 0.05}), wood);
        };
        add_king({0.5, 1.5, 0}, ivory);
        add_rook({-1.5, 1.5, 0}, ebony);
        add_pawn({1.5, 1.5, 0}, ebony);
        add_pawn({-0.5, 0.5, 0}, ivory);
        add_pawn({1.5, -0.5, -0.2}, ivory);
        add_bishop({-0.5, 3.5, 0}, ebony);
        add_king({1.5, 4.5, 0}, ebony);
        add_rook({-2.5, 5.5, 0}, ivory);
        return s;
    }
};

}  // namespace winnow::simulate::scenes
