// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Posters that fly and turn through a hall, most of them seen at a steep angle: along one side of a pixel a texture
/// runs by many times faster than along the other, and what moves is blurred by yet another amount in yet another
/// direction.  A filter that knows one radius only cannot be right.
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Tilted, textured planes that move straight on and turn.
struct planes {
    static std::string name() { return "planes"; }
    static std::string summary() { return "textured planes at steep angles, moving and turning"; }
    using shows = effects<effect::translation, effect::rotation, effect::area_light, effect::texture>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad> s;
        s.camera_at = [](double) { return camera{.eye = {0, -9, 3.1}, .target = {0, 0, 2.0}, .field_of_view = 44}; };
        const int lamp = s.add(material{.name = "lamp", .emission = {180, 158, 124}});
        const int blue = s.add(material{.name = "blue lamp", .emission = {4, 7, 13}});
        s.add(quad({-3.6, -4.2, 7.2}, {0, 1.4, 0}, {1.4, 0, 0.4}), lamp);
        s.add(quad({7, -6, 1}, {0, 0, 5}, {0, 5, 0}), blue);

        const auto tiles = [](const place& p) -> rgb {
            const double worn = 0.75 + 0.25 * fractal_noise(5 * p.rest, 3);
            return worn * (checker(p.rest.x() / 0.6, p.rest.y() / 0.6) == 0 ? rgb(0.62, 0.58, 0.50) : grey(0.10));
        };
        const auto panels = [](const place& p) -> rgb {
            const double x = p.rest.x() + p.rest.y(), z = p.rest.z();
            const bool groove = std::abs(std::remainder(x, 0.7)) < 0.03 || std::abs(std::remainder(z, 1.4)) < 0.03;
            return (groove ? 0.2 : 0.7 + 0.4 * fractal_noise({9 * x, 0.5, 1.5 * z}, 3)) * rgb(0.52, 0.40, 0.30);
        };
        const int ground = s.add(material{.name = "floor", .albedo = grey(1), .texture = tiles});
        const int wall = s.add(material{.name = "wall", .albedo = grey(1), .texture = panels});
        s.add(quad({-7, -12, 0}, {14, 0, 0}, {0, 17, 0}), ground);
        s.add(quad({-7, 5, 0}, {14, 0, 0}, {0, 0, 8}), wall);
        s.add(quad({-7, -12, 0}, {0, 17, 0}, {0, 0, 8}), wall);

        const auto chess = [](const place& p) -> rgb {
            return checker(9 * p.uv.x(), 6 * p.uv.y()) == 0 ? rgb(0.88, 0.85, 0.76) : rgb(0.60, 0.07, 0.06);
        };
        const auto rings = [](const place& p) -> rgb {
            const double r = (p.uv - vec2(0.5, 0.5)).norm();
            return stripe(18 * r) == 0 ? rgb(0.93, 0.75, 0.16) : rgb(0.05, 0.13, 0.32);
        };
        const auto slats = [](const place& p) -> rgb {
            return stripe(9 * p.uv.x() + 6 * p.uv.y()) == 0 ? rgb(0.10, 0.42, 0.40) : rgb(0.90, 0.88, 0.82);
        };
        const auto marble = [](const place& p) -> rgb {
            const double vein = std::sin(30 * p.uv.x() + 14 * fractal_noise({6 * p.uv.x(), 6 * p.uv.y(), 2}, 4));
            return rgb(0.16, 0.05, 0.22) + (0.5 + 0.5 * vein) * rgb(0.52, 0.48, 0.36);
        };
        const auto rays = [](const place& p) -> rgb {
            return spoke(p.uv - vec2(0.5, 0.5), 24) == 0 ? rgb(0.80, 0.30, 0.05) : rgb(0.80, 0.72, 0.58);
        };

        // A poster about its centre, spanned by two half sides; it turns about its normal.
        const auto add_poster = [&](const char* label, map<rgb> texture, const vec3& centre, const vec3& a,
                                    const vec3& b, const vec3& velocity, double spin) {
            const int paper = s.add(material{.name = label, .albedo = grey(1), .texture = texture});
            s.add(quad(centre - a - b, 2 * a, 2 * b), paper,
                  s.add(motion{velocity, centre, a.cross(b).normalized(), spin}));
        };
        const vec3 still = vec3::Zero();
        add_poster("chess", chess, {-1.9, 0.3, 1.3}, {1.0, 1.6, 0.1}, {0.1, 0.1, 0.9}, {0.28, 0, 0.06}, 0);
        add_poster("rings", rings, {0.3, 1.4, 3.3}, {1.5, 0.2, 0.2}, {-0.1, 1.5, 0.3}, {0.1, 0, 0.1}, 0);
        add_poster("slats", slats, {2.5, 0.2, 1.6}, {-0.3, 1.8, 0}, {0, 0, 1.3}, {0, -0.3, 0.12}, 0);
        add_poster("marble", marble, {0.4, -1.8, 0.6}, {1.1, 0, 0}, {0, 0.9, 0.2}, {-0.15, 0, 0}, 0.15);
        add_poster("rays", rays, {-2.5, 2.6, 3.6}, {1.0, 0.6, 0}, {0, 0, 1.0}, still, 0.2);
        return s;
    }
};

}  // namespace winnow::simulate::scenes
