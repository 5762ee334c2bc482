// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a path leaves in the planes of its sample.  `sample::set` drops what nobody asked for, and the compiler drops
/// what it was worked out from.
#include <optional>
#include <winnow/frame/sample.hpp>
#include <winnow/simulate/scatter.hpp>
#include <winnow/simulate/world.hpp>

namespace winnow::simulate {

/// A ray that meets nothing is recorded as meeting a sphere of this many radii of the world around its origin, from
/// within: positions stay finite, and a mixture of sky and surface is as spread as it is.
inline constexpr double far_radii = 10;

/// The reflectance that a surface shows: diffuse and specular, 1 for lamps and glass.
inline rgb shown_albedo(const surface& s) {
    return (s.emission > 0).any() || s.ior > 0 ? grey(1) : rgb((s.albedo + s.f0).min(1.0));
}

/// Writes the planes of one sample.
template <class World, class Planes>
class recorder {
public:
    using effects = typename World::effects;

    /// Points are relative to the eye of `now`, the camera at the opening of the shutter.
    recorder(const World& w, const view& now, const view& previous) : world_(w), now_(now), previous_(previous) {}

    /// Where the ray from the camera has met something or nothing.
    void first(sample<Planes>& s, const view& camera, const ray& r, const meeting& m,
               const std::optional<surface>& met) const {
        const point p = at(r, m, met);
        s.set(depth = p.distance);
        s.set(view_depth = camera.depth(p.position));
        s.set(position = relative(p.position));
        s.set(normal = p.normal);
        s.set(albedo = p.albedo);
        s.set(rest_position = relative(met ? met->rest : p.position));
        s.set(instance = met ? met->object + 1 : 0);
        s.set(visibility = 1);
        if (met) {
            s.set(f0 = met->f0);
            s.set(roughness = met->roughness);
            s.set(cosine = std::max(0.0, -r.direction.dot(met->shading)));
        }
        if constexpr (contains<motion_vector_t, Planes>) {
            const int object = met ? met->object : 0;
            const vec3 rest = met ? met->rest : p.position;
            const vec3 before = world_.carried(object, rest, world_.frame() - 1);
            const vec3 here = world_.carried(object, rest, world_.frame());
            // What was behind the camera has come from nowhere in the image.
            const bool seen = previous_.depth(before) > 0 && now_.depth(here) > 0;
            s.set(motion_vector = seen ? vec2(previous_.project(before) - now_.project(here)) : vec2(0, 0));
        }
        second(s, {p.position, r.direction}, {}, std::nullopt);  // unless there is one
    }
    /// Where the direction that was chosen at the first surface leads.
    void second(sample<Planes>& s, const ray& r, const meeting& m, const std::optional<surface>& met) const {
        if constexpr (contains<position2_t, Planes> || contains<normal2_t, Planes> || contains<albedo2_t, Planes> ||
                      contains<hit_distance_t, Planes>) {
            const point p = at(r, m, met);
            s.set(position2 = relative(p.position));
            s.set(normal2 = p.normal);
            s.set(albedo2 = p.albedo);
            s.set(hit_distance = p.distance);
        }
    }
    /// How the first surface scatters, and what it chose.
    void scattering_of(sample<Planes>& s, double share, const scattered& next) const {
        s.set(specular_share = share);
        s.set(brdf = next.weight);
    }
    void medium(sample<Planes>& s, const meeting& m, double flight) const {
        const double surface = std::min(m.distance, far_radii * world_.radius());
        s.set(transmittance = std::exp(-world_.description().medium.extinction * surface));
        s.set(scatter_distance = flight < surface ? flight : surface);
    }

private:
    struct point {
        vec3 position, normal;
        rgb albedo;
        double distance;
    };
    point at(const ray& r, const meeting& m, const std::optional<surface>& met) const {
        if (met) return {met->position, met->shading, shown_albedo(*met), m.distance};
        const double far = far_radii * world_.radius();
        return {r.at(far), -r.direction, grey(0), far};
    }
    vec3 relative(const vec3& p) const { return p - now_.eye(); }

    const World& world_;
    const view& now_;
    const view& previous_;
};

}  // namespace winnow::simulate
