// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Area lights: shapes that can be sampled by the solid angle under which they are seen, and the sky.
#include <variant>
#include <winnow/simulate/shape.hpp>

namespace winnow::simulate {

/// A direction towards a light.
struct light_sample {
    vec3 direction;
    double distance;  ///< to the light; infinity for the sky
    double pdf;       ///< per solid angle; 0 where the light cannot be seen from here
};

/// A point of a light, for photons; even over its area.
struct emission_point {
    vec3 position, normal;
    double area;
};

/// A shape that can be a light can be sampled from a point, tells the density of a direction that meets it, and where
/// its photons start.
template <class S>
concept light_shape = shape<S> && requires(const S& s, const vec3& from, const ray& r, const vec2& u) {
    { sample_light(s, from, u) } -> std::same_as<light_sample>;
    { light_pdf(s, r, 0.0) } -> std::same_as<double>;
    { emit(s, u) } -> std::same_as<emission_point>;
};

/// By area, one-sided.
inline double light_pdf(const quad& q, const ray& r, double distance) {
    const double cosine = -r.direction.dot(q.at(r.at(distance)).normal);
    return cosine > 0 ? distance * distance / (cosine * q.area()) : 0;
}
inline light_sample sample_light(const quad& q, const vec3& from, const vec2& u) {
    const vec3 to = q.point(u) - from;
    const double distance = to.norm();
    const vec3 direction = to / distance;
    return {direction, distance, light_pdf(q, {from, direction}, distance)};
}

inline emission_point emit(const quad& q, const vec2& u) {
    const vec3 p = q.point(u);
    return {p, q.at(p).normal, q.area()};
}

namespace detail {
/// 1 - cos of the cone under which a sphere is seen, without cancellation where it is far; 0 from inside.
inline double cone_of(const ellipsoid& s, const vec3& from) {
    const double sine2 = s.radii().x() * s.radii().x() / (s.centre() - from).squaredNorm();
    return sine2 < 1 ? sine2 / (1 + std::sqrt(1 - sine2)) : 0;
}
}  // namespace detail

/// By the cone under which it is seen; only spheres, from outside.
inline double light_pdf(const ellipsoid& s, const ray& r, double) {
    const double cone = detail::cone_of(s, r.origin);
    return cone > 0 ? 1 / (2 * pi * cone) : 0;
}
inline light_sample sample_light(const ellipsoid& s, const vec3& from, const vec2& u) {
    const double cone = detail::cone_of(s, from);
    if (!(cone > 0)) return {vec3::UnitZ(), infinity, 0};
    const double below = u.x() * cone;  // 1 - cosine
    const double sine = std::sqrt(below * (2 - below));
    const vec3 local(sine * std::cos(2 * pi * u.y()), sine * std::sin(2 * pi * u.y()), 1 - below);
    const vec3 direction = basis((s.centre() - from).normalized()).to_world(local);
    const ray r{from, direction};
    const double t = s.intersect(r, 0);
    // On the rim rounding may let the ray pass.
    return {direction, t < infinity ? t : (s.centre() - from).norm(), 1 / (2 * pi * cone)};
}

inline emission_point emit(const ellipsoid& sphere, const vec2& u) {
    const vec3 n = polar_direction(1 - 2 * u.x(), u.y());
    const double r = sphere.radii().x();
    return {sphere.centre() + r * n, n, 4 * pi * r * r};
}

static_assert(light_shape<quad> && light_shape<ellipsoid> && !light_shape<triangle>);

}  // namespace winnow::simulate
