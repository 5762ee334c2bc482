// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A path tracer with next-event estimation.  What it does, draws and records follows from the effects of the scene and
/// from the planes that are asked for.
#include <optional>
#include <winnow/simulate/photons.hpp>
#include <winnow/simulate/radiance.hpp>
#include <winnow/simulate/random.hpp>
#include <winnow/simulate/record.hpp>

namespace winnow::simulate {

/// How direct light is found: by choosing points of lights, by following the directions that surfaces choose, or by
/// both, weighted by the power heuristic (Veach 1997).  The mean is the same.
/// Visibility is that of light samples: it is 1 where there are none.
enum class direct_light { both, by_lights, by_surfaces };

/// Follows one path for each sample.  The world must outlive it.  Points are relative to the eye of the camera at the
/// opening of the shutter.
template <class World, class Planes>
class path_tracer {
public:
    using effects = typename World::effects;
    template <class X>  // effects::has asks for an effect; asking here as well crashes clang 14
    static constexpr bool has = effects::template has<X>;

    path_tracer(const World& w, extent size, direct_light direct = direct_light::both)
        : world_(w),
          size_(size),
          direct_(direct),
          view_(w.camera_at(w.frame()), size),
          previous_(w.camera_at(w.frame() - (has<effect::frames> ? 1 : 0)), size) {}

    /// The sample of pixel (x, y) that these random numbers make.
    template <class Random>
    sample<Planes> operator()(int x, int y, const Random& random, const photon_map* photons = nullptr) const {
        sample<Planes> s;
        const vec2 image = vec2(x, y) + random(draw::image{});
        s.set(image_point = image);
        double time = world_.frame();
        if constexpr (effects::shutter) {
            const double u = random(draw::time{});
            s.set(shutter_time = u);
            time += u;
        }
        const view* camera = &view_;
        std::optional<view> moved;
        if constexpr (has<effect::camera_motion>) camera = &moved.emplace(world_.camera_at(time), size_);
        path p;
        if constexpr (has<effect::depth_of_field>) {
            const vec2 u = random(draw::lens{});
            s.set(lens_point = u);
            p.r = camera->from_lens(image, on_disc(u));
        } else {
            p.r = camera->through(image);
        }
        context<Random> c{s, *camera, time, random, photons};
        if constexpr (has<effect::caustics>) c.spread = std::sqrt(camera->solid_angle(p.r.direction));
        follow(p, c);
        return s;
    }

private:
    /// One sample's surroundings.
    template <class Random>
    struct context {
        sample<Planes>& s;
        const view& camera;
        double time;
        const Random& random;
        const photon_map* photons;
        double spread = 0;  ///< of a pixel: the root of its solid angle
        radiance<Planes> found{};
    };
    /// What a path knows on its way to the next vertex.
    struct path {
        ray r{};
        int vertex = 1;  ///< the next one
        rgb throughput = grey(1);
        double pdf = infinity;       ///< of the direction; infinity from the camera, mirrors and glass
        vec3 normal = vec3::Zero();  ///< where it comes from; 0 in a medium
        double length = 0;           ///< from the camera
        bool goes_on = true;         ///< past the emission of the next vertex
        bool by_surface = false;     ///< a surface was the first to scatter it,
        lobe first = lobe::diffuse;  ///< by this lobe
        bool diffused = false;       ///< its last rough lobe was diffuse,
        bool caustic = false;        ///< and a mirror or glass followed

        /// The way of what is found at the next vertex, or at a light that is chosen there.
        way emitted() const { return by_surface ? way_by(first, vertex == 2) : way::emission; }
        way lit() const { return by_surface ? way_by(first, false) : way::emission; }
        static way way_by(lobe l, bool direct) {
            if (l == lobe::diffuse) return direct ? way::direct_diffuse : way::indirect_diffuse;
            return direct ? way::direct_specular : way::indirect_specular;
        }
    };

    template <class Context>
    void follow(path& p, Context& c) const {
        const recorder<World, Planes> record(world_, view_, previous_);
        for (;; ++p.vertex) {
            const meeting m = world_.meet(p.r, c.time);
            std::optional<surface> met;
            if (m) met = world_.at(p.r, m, c.time);
            if (p.vertex == 1) record.first(c.s, c.camera, p.r, m, met);
            if (p.vertex == 2 && p.by_surface) record.second(c.s, p.r, m, met);
            if constexpr (has<effect::medium>) {
                const double flight = free_flight(p, c);
                if (p.vertex == 1) record.medium(c.s, m, flight);
                if (flight < m.distance) {
                    if (p.vertex == 1 && met) see_surface(p, *met, record, c);
                    if (p.vertex > world_.description().bounces || !survives(p, c)) break;
                    scatter_in_medium(p, flight, c);
                    continue;
                }
            }
            collect_emission(p, m, met, c);
            if (!met || !p.goes_on || p.vertex > world_.description().bounces || !survives(p, c)) break;
            p.length += m.distance;
            const scattering<effects> scatters(*met, -p.r.direction);
            if constexpr (has<effect::area_light>) collect_light(p, *met, scatters, c);
            if constexpr (has<effect::caustics>)
                if (c.photons) collect_photons(p, *met, c);
            if constexpr (effects::template draws<draw::lobe>) {
                const scattered next = choose_direction(scatters, p.vertex, c);
                if (p.vertex == 1) record.scattering_of(c.s, scatters.specular_share(), next);
                if ((next.weight == 0).all()) break;
                leave(p, *met, next);
            } else {
                break;
            }
        }
        c.found.record(c.s);
    }

    /// Emission of what the path has met, weighted against finding it as a light.
    template <class Context>
    void collect_emission(const path& p, const meeting& m, const std::optional<surface>& met, Context& c) const {
        const rgb emitted = met ? met->emission : world_.sky(p.r.direction);
        if ((emitted == 0).all()) return;
        const int light = met ? met->light : world_.sky_light();
        if (p.caustic && met) return;  // the photons carry it
        double weight = 1;
        if (light >= 0 && p.pdf < infinity) {
            if (direct_ == direct_light::by_lights) return;
            if (direct_ == direct_light::both) weight = heuristic(p.pdf, world_.pdf(light, p.normal, p.r, m.distance));
        }
        c.found.add(p.emitted(), weight * p.throughput * emitted);
    }

    /// A light that the surface chooses, by both of its lobes.
    template <class Context>
    void collect_light(const path& p, const surface& s, const scattering<effects>& scatters, Context& c) const {
        if (world_.lights() == 0 || direct_ == direct_light::by_surfaces) return;
        const chosen_light l = choose_light(p.vertex, s.position, s.shading, c);
        const rgb diffuse = l.pdf > 0 ? scatters.value(lobe::diffuse, l.to.direction) : grey(0);
        const rgb specular = l.pdf > 0 ? scatters.value(lobe::specular, l.to.direction) : grey(0);
        const bool useful = (diffuse > 0).any() || (specular > 0).any();
        bool seen = false;
        if (useful) seen = sees(s, l, c.time);
        else if (contains<visibility_t, Planes> && p.vertex == 1) seen = sees(s, l, c.time);
        if (p.vertex == 1) c.s.set(visibility = seen ? 1 : 0);
        if (!useful || !seen) return;
        const rgb arriving = p.throughput * l.emission * transmitted(l.to.distance) / l.pdf;
        const auto add = [&](lobe by, way to, const rgb& value) {
            if (!(value > 0).any()) return;
            const double weight =
                direct_ == direct_light::both ? heuristic(l.pdf, scatters.pdf(by, l.to.direction)) : 1;
            c.found.add(to, weight * value * arriving);
        };
        const bool first = p.vertex == 1;
        add(lobe::diffuse, first ? way::direct_diffuse : p.lit(), diffuse);
        add(lobe::specular, first ? way::direct_specular : p.lit(), specular);
    }

    template <class Context>
    static scattered choose_direction(const scattering<effects>& scatters, int vertex, const Context& c) {
        return scatters.sample(c.random(draw::lobe{}, vertex), [&] {
            if constexpr (effects::template draws<draw::direction>) return c.random(draw::direction{}, vertex);
            else return vec2(0, 0);  // only mirrors, which need none
        });
    }

    /// The first surface, behind a medium that has scattered the path before it: only what is recorded of it.
    template <class Context>
    void see_surface([[maybe_unused]] const path& p, [[maybe_unused]] const surface& s,
                     [[maybe_unused]] const recorder<World, Planes>& record, [[maybe_unused]] Context& c) const {
        if constexpr (has<effect::area_light> && contains<visibility_t, Planes>)
            if (world_.lights() > 0)
                c.s.set(visibility = sees(s, choose_light(1, s.position, s.shading, c), c.time) ? 1 : 0);
        if constexpr (contains<brdf_t, Planes> || contains<specular_share_t, Planes>) {
            const scattering<effects> scatters(s, -p.r.direction);
            record.scattering_of(c.s, scatters.specular_share(), choose_direction(scatters, 1, c));
        }
    }

    template <class Context>
    void collect_photons(const path& p, const surface& s, Context& c) const {
        // The radius of a pixel's footprint.
        const double cosine = std::max(0.1, std::abs(p.r.direction.dot(s.facing)));
        const double radius = c.spread * p.length / std::sqrt(cosine);
        const photon_map::estimate e = c.photons->at(s.position, s.facing, radius);
        if (p.vertex == 1) c.s.set(caustic = e.density);
        c.found.add(p.vertex == 1 ? way::indirect_diffuse : p.lit(), p.throughput * s.albedo * e.irradiance / pi);
    }

    struct chosen_light {
        light_sample to;
        rgb emission;
        double pdf;  ///< per solid angle, with that of the choice
    };
    template <class Context>
    chosen_light choose_light(int vertex, const vec3& from, const vec3& normal, Context& c) const {
        const int light = world_.choose(c.random(draw::light_choice{}, vertex));
        const vec2 u = c.random(draw::light{}, vertex);
        if (vertex == 1) c.s.set(light_point = u);
        if (vertex == 2) c.s.set(light_point2 = u);
        const light_sample to = world_.sample(light, from, normal, u);
        return {to, world_.emission(light, to.direction), to.pdf * world_.choice_probability(light)};
    }
    /// A surface is in its own shadow on the far side.
    bool sees(const surface& s, const chosen_light& l, double time) const {
        return l.pdf > 0 && s.facing.dot(l.to.direction) > 0 &&
               !world_.occluded({s.position, l.to.direction}, time, l.to.distance);
    }
    double transmitted(double distance) const {
        if constexpr (has<effect::medium>)
            if (const double extinction = world_.description().medium.extinction; extinction > 0)
                return std::exp(-extinction * distance);
        return 1;
    }
    static double heuristic(double pdf, double other) { return 1 / (1 + (other / pdf) * (other / pdf)); }

    /// Paths end by chance after the third vertex, the likelier the less they carry.
    template <class Context>
    bool survives(path& p, const Context& c) const {
        if constexpr (effects::template draws<draw::roulette>)
            if (p.vertex > 3) {
                const double chance = std::min(1.0, p.throughput.maxCoeff());
                if (c.random(draw::roulette{}, p.vertex) >= chance) return false;
                p.throughput /= chance;
            }
        return true;
    }

    void leave(path& p, const surface& s, const scattered& next) const {
        if (p.vertex == 1) p.by_surface = true, p.first = next.by;
        p.throughput *= next.weight;
        p.pdf = next.pdf;
        p.normal = s.shading;
        p.r = {s.position, next.direction};
        if (next.is_delta()) {
            p.goes_on = has<effect::mirror>;
            // Photons bring only the light of lights.
            p.caustic = has<effect::caustics> && has<effect::area_light> && p.diffused;
        } else {
            p.diffused = next.by == lobe::diffuse;
            p.goes_on = p.diffused ? has<effect::global_illumination> : has<effect::glossy>;
            p.caustic = false;
        }
    }

    template <class Context>
    double free_flight(const path& p, const Context& c) const {
        return -std::log1p(-c.random(draw::free_flight{}, p.vertex)) / world_.description().medium.extinction;
    }
    template <class Context>
    void scatter_in_medium(path& p, double flight, Context& c) const {
        const homogeneous_medium& medium = world_.description().medium;
        const phase scatters{medium.anisotropy};
        const vec3 at = p.r.at(flight), travel = p.r.direction;
        p.throughput *= medium.albedo;
        if constexpr (has<effect::area_light>)
            if (world_.lights() > 0 && direct_ != direct_light::by_surfaces) {
                const chosen_light l = choose_light(p.vertex, at, vec3::Zero(), c);
                if (l.pdf > 0 && !world_.occluded({at, l.to.direction}, c.time, l.to.distance)) {
                    const double value = scatters.pdf(travel.dot(l.to.direction));
                    const double weight = direct_ == direct_light::both ? heuristic(l.pdf, value) : 1;
                    c.found.add(p.lit(),
                                p.throughput * l.emission * (weight * value * transmitted(l.to.distance) / l.pdf));
                }
            }
        const vec3 to = scatters.sample(travel, c.random(draw::direction{}, p.vertex));
        p.pdf = scatters.pdf(travel.dot(to));
        p.normal = vec3::Zero();
        p.r = {at, to};
        p.length += flight;
        p.goes_on = true;
        p.caustic = p.diffused = false;
    }

    const World& world_;
    extent size_;
    direct_light direct_;
    view view_, previous_;
};

}  // namespace winnow::simulate
