// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Points, directions, colours and rays.  The one door through which Eigen enters the simulator.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

namespace winnow::simulate {

using vec2 = Eigen::Vector2d;
using vec3 = Eigen::Vector3d;
/// Linear red, green and blue; products are by component.
using rgb = Eigen::Array3d;

inline constexpr double pi = std::numbers::pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline rgb grey(double value) { return rgb::Constant(value); }
inline double luminance(const rgb& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

/// The points origin + t direction; the direction has unit length.
struct ray {
    vec3 origin, direction;

    vec3 at(double t) const { return origin + t * direction; }
};

/// A right-handed orthonormal basis about a unit normal.
struct basis {
    vec3 s, t, n;

    explicit basis(const vec3& normal) : n(normal) {
        // Crossed with the axis that the normal is farthest from: never short.
        const vec3 axis = std::abs(n.z()) < 0.9 ? vec3::UnitZ() : vec3::UnitX();
        s = axis.cross(n).normalized();
        t = n.cross(s);
    }
    vec3 to_world(const vec3& v) const { return v.x() * s + v.y() * t + v.z() * n; }
    vec3 to_local(const vec3& v) const { return {v.dot(s), v.dot(t), v.dot(n)}; }
};

/// Uniform in the unit disc, by concentric squares: strata stay strata.
inline vec2 on_disc(const vec2& u) {
    const double a = 2 * u.x() - 1, b = 2 * u.y() - 1;
    if (a == 0 && b == 0) return {0, 0};
    const bool wide = std::abs(a) > std::abs(b);
    const double r = wide ? a : b;
    const double angle = wide ? pi / 4 * (b / a) : pi / 2 - pi / 4 * (a / b);
    return {r * std::cos(angle), r * std::sin(angle)};
}

/// About +z with density cos / pi.
inline vec3 cosine_direction(const vec2& u) {
    const vec2 d = on_disc(u);
    return {d.x(), d.y(), std::sqrt(std::max(0.0, 1 - d.squaredNorm()))};
}

/// The direction at a cosine from +z, turned by a share of the full circle.
inline vec3 polar_direction(double cosine, double share) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return {sine * std::cos(2 * pi * share), sine * std::sin(2 * pi * share), cosine};
}

}  // namespace winnow::simulate
