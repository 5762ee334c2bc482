// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Five metal balls that are rough in different ways, a painted one, and a floor of dull and polished tiles, under an
/// evening sky and two lamps; the camera slides.  What a reflection looks like changes within a few pixels.
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate::scenes {

/// Roughness maps: for demodulation, and for filters over time.
struct balls {
    static std::string name() { return "balls"; }
    static std::string summary() { return "metal balls and tiles with roughness maps under a sky; the camera slides"; }
    using shows = effects<effect::glossy, effect::roughness_map, effect::texture, effect::frames, effect::area_light>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, disc, ellipsoid> s;
        arrange(s);
        // About two pixels a frame in an image 256 wide.
        s.camera_at = [](double time) {
            const vec3 slide(0.045 * time, 0, 0);
            return camera{
                .eye = vec3(-0.9, -8.4, 2.5) + slide, .target = vec3(-0.1, 0, 0.95) + slide, .field_of_view = 42};
        };
        return s;
    }

    /// All but the camera.
    template <class Scene>
    static void arrange(Scene& s) {
        // Perceptual roughness is the root of the GGX alpha: 0.2236 for 0.05, 0.7071 for 0.5.
        const auto metal = [&](const char* what, const rgb& f0, map<double> roughness, const ellipsoid& ball) {
            s.add(ball, s.add({.name = what, .f0 = f0, .roughness_map = roughness}));
        };
        metal(
            "checkered gold", {0.95, 0.68, 0.32},
            [](const place& at) { return checker(16 * at.uv.x(), 8 * at.uv.y()) ? 0.2236 : 0.7071; },
            sphere({-1.35, 0.35, 1.0}, 1.0));
        metal(
            "stained copper", {0.93, 0.52, 0.38},
            [](const place& at) { return 0.12 + 0.75 * std::pow(fractal_noise(4 * at.rest, 4), 1.5); },
            sphere({0.85, -0.25, 0.8}, 0.8));
        metal(
            "scratched steel", {0.62, 0.63, 0.66},
            [](const place& at) {
                const vec3 along = at.rest.cwiseProduct(vec3(6, 6, 70));
                return value_noise(along) > 0.62 ? 0.6 : 0.18;
            },
            sphere({2.45, 1.1, 0.9}, 0.9));
        metal(
            "banded blue", {0.25, 0.42, 0.80}, [](const place& at) { return 0.15 + 0.5 * stripe(10 * at.uv.y()); },
            sphere({-0.45, -1.75, 0.45}, 0.45));
        metal(
            "spotted green", {0.30, 0.62, 0.36},
            [](const place& at) { return value_noise(9 * at.rest) > 0.6 ? 0.2236 : 0.55; },
            sphere({1.95, -1.55, 0.5}, 0.5));
        s.add(sphere({-2.75, -1.05, 0.6}, 0.6),
              s.add({.name = "painted", .albedo = grey(0.9), .texture = [](const place& at) {
                         const rgb red(0.75, 0.10, 0.08), white(0.90, 0.87, 0.80);
                         return rgb((0.75 + 0.25 * value_noise(12 * at.rest)) * (stripe(12 * at.uv.x()) ? red : white));
                     }}));

        // As far as the eye can see, tiles of marble with a varnish that is polished on every other one.
        s.add(disc({0, 0, 0}, vec3::UnitZ(), 50),
              s.add({.name = "tiles",
                     .albedo = {0.52, 0.50, 0.47},
                     .f0 = grey(0.12),
                     .texture =
                         [](const place& at) {
                             const double u = at.rest.x() - std::floor(at.rest.x());
                             const double v = at.rest.y() - std::floor(at.rest.y());
                             if (std::min(u, v) < 0.03) return grey(0.15);
                             const double vein = std::abs(fractal_noise(3 * at.rest, 3) - 0.5);
                             const double shade = checker(at.rest.x(), at.rest.y()) ? 0.45 : 1;
                             return grey(shade * std::min(1.0, 0.55 + 6 * vein));
                         },
                     .roughness_map =
                         [](const place& at) {
                             const double smooth = checker(at.rest.x(), at.rest.y()) ? 0.2 : 0.45;
                             return smooth + 0.15 * value_noise(5 * at.rest);
                         }}));

        // A warm lamp and a cold one, both above all cameras; the sun has set in the west.
        const auto lamp = [&](const vec3& at, double size, const rgb& emission) {
            const basis frame(-at.normalized());
            s.add(quad(at - size / 2 * (frame.s + frame.t), size * frame.s, size * frame.t),
                  s.add({.name = "lamp", .emission = emission}));
        };
        lamp({-5, -3.5, 6.5}, 1.6, rgb(1.0, 0.86, 0.66) * 62);
        lamp({5.5, 4, 5.5}, 1.5, rgb(0.62, 0.78, 1.0) * 60);
        s.sky = [](const vec3& d) {
            const double up = std::max(0.0, d.z()), west = std::max(0.0, 0.8 * d.y() - 0.6 * d.x());
            const rgb zenith(0.05, 0.09, 0.22), horizon(0.22, 0.22, 0.28), dusk(0.70, 0.32, 0.12);
            const double haze = std::exp(-4 * up);
            return rgb(zenith + haze * (horizon + west * west * dusk));
        };
    }
};

}  // namespace winnow::simulate::scenes
