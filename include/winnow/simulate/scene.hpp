// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A scene: what there is, as plain data.
#include <string>
#include <variant>
#include <vector>
#include <winnow/simulate/camera.hpp>
#include <winnow/simulate/effect.hpp>
#include <winnow/simulate/material.hpp>
#include <winnow/simulate/motion.hpp>
#include <winnow/simulate/shape.hpp>

namespace winnow::simulate {

/// Fills all space.
struct homogeneous_medium {
    double extinction = 0;  ///< per world unit
    rgb albedo = grey(0);   ///< share of what is met that is scattered, not absorbed
    double anisotropy = 0;  ///< g of Henyey and Greenstein: above 0 forwards
};

/// Shows the listed effects and consists of the listed shapes; a `world` checks it and makes it ready for rays.
/// World units are such that a scene is about 1 to 100 large: rays start 1e-6 off surfaces.
template <class Effects, shape... Shapes>
struct scene {
    using effects = Effects;
    using any_shape = std::variant<Shapes...>;

    struct part {
        any_shape shape;
        int material;
        int object;
    };

    simulate::camera (*camera_at)(double time) = nullptr;  ///< in frames; see effect::frames and effect::camera_motion
    rgb (*sky)(const vec3& direction) = nullptr;           ///< radiance from where there is nothing; black without one
    double sky_selection = 1;                              ///< how often it is chosen as a light, relative to others
    homogeneous_medium medium{};
    int bounces = 8;                ///< at most; the last one collects emission only
    double photons_per_sample = 1;  ///< see effect::caustics
    std::vector<material> materials;
    std::vector<motion> objects{motion{}};  ///< number 0 does not move
    std::vector<part> parts;

    int add(const material& m) {
        materials.push_back(m);
        return static_cast<int>(materials.size()) - 1;
    }
    int add(const motion& m) {
        objects.push_back(m);
        return static_cast<int>(objects.size()) - 1;
    }
    void add(const any_shape& s, int material, int object = 0) { parts.push_back({s, material, object}); }

    /// A box of six quads about its centre, turned about the vertical by `yaw`.
    void add_box(const vec3& centre, const vec3& half, int material, int object = 0, double yaw = 0) {
        const vec3 x = half.x() * vec3(std::cos(yaw), std::sin(yaw), 0);
        const vec3 y = half.y() * vec3(-std::sin(yaw), std::cos(yaw), 0), z = half.z() * vec3::UnitZ();
        const auto side = [&](const vec3& out, const vec3& a, const vec3& b) {
            add(quad(centre + out - a - b, 2 * a, 2 * b), material, object);
        };
        side(x, y, z), side(-x, z, y), side(y, z, x), side(-y, x, z), side(z, x, y), side(-z, y, x);
    }
};

}  // namespace winnow::simulate
