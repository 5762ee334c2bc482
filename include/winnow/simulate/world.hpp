// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A world: a scene that has been checked and made ready for rays.
#include <algorithm>
#include <optional>
#include <winnow/core/error.hpp>
#include <winnow/simulate/bvh.hpp>
#include <winnow/simulate/light.hpp>
#include <winnow/simulate/scene.hpp>

namespace winnow::simulate {

/// Where a ray has met the world.
struct meeting {
    double distance = infinity;
    int part = -1;  ///< of the scene; -1: nothing is there

    explicit operator bool() const { return part >= 0; }
};

/// A point of a surface, seen from outside or inside.
struct surface {
    vec3 position, rest;  ///< where it is, and where it is in the rest pose of its object
    vec3 outward;         ///< geometric normal of the shape
    vec3 facing;          ///< the same, towards the viewer
    vec3 shading;         ///< unit normal after bumps, towards the viewer
    rgb albedo, f0, emission;
    double roughness, ior;
    int light, object;  ///< light is -1 for what does not emit
};

template <class Scene>
class world {
public:
    using effects = typename Scene::effects;
    template <class X>  // effects::has asks for an effect; asking here as well crashes clang 14
    static constexpr bool has = effects::template has<X>;
    static constexpr double near = 1e-6;
    static constexpr int sky_part = -2;

    /// `frame` is the time, in frames, at which the shutter opens; it closes one frame later.  Fails for a scene that
    /// has what its effects do not declare.
    explicit world(Scene s, int frame = 0) : scene_(std::move(s)), frame_(frame) {
        check();
        std::vector<bounds> boxes;
        bounds all;
        for (const auto& part : scene_.parts) {
            const bounds rest = std::visit([](const auto& shape) { return shape.bounding(); }, part.shape);
            boxes.push_back(scene_.objects[part.object].template swept<effects>(rest, frame_, frame_ + 1));
            all.grow(boxes.back());
        }
        tree_ = bvh(boxes);
        if (!boxes.empty()) radius_ = (all.high - all.low).norm() / 2, centre_ = all.centre();
        find_lights();
    }

    const Scene& description() const { return scene_; }
    int frame() const { return frame_; }
    /// Of a ball around everything, at least.
    double radius() const { return radius_; }
    const vec3& centre() const { return centre_; }

    camera camera_at(double time) const { return scene_.camera_at ? scene_.camera_at(time) : camera{}; }

    /// The nearest part on the ray.
    meeting meet(const ray& r, double time) const {
        meeting m;
        tree_.walk(r, infinity, [&](int i, double limit) {
            const double t = intersect(scene_.parts[i], r, time);
            if (t < limit) m = {t, i}, limit = t;
            return limit;
        });
        return m;
    }
    /// Whether something lies on the ray nearer than that.
    bool occluded(const ray& r, double time, double distance) const {
        bool met = false;
        tree_.walk(r, distance * (1 - 1e-6), [&](int i, double limit) {
            met = intersect(scene_.parts[i], r, time) < limit;
            return met ? 0 : limit;
        });
        return met;
    }

    /// The surface where the ray has met it, with everything that its maps say.
    surface at(const ray& r, const meeting& m, double time) const {
        const auto& part = scene_.parts[m.part];
        const material& made_of = scene_.materials[part.material];
        const motion& moved = scene_.objects[part.object];
        surface s;
        s.position = r.at(m.distance);
        s.rest = moved.template bring_back<effects>(s.position, time);
        const surface_point point = std::visit([&](const auto& shape) { return shape.at(s.rest); }, part.shape);
        s.outward = moved.template carry_direction<effects>(point.normal, time);
        const bool front = r.direction.dot(s.outward) < 0;
        s.facing = front ? s.outward : vec3(-s.outward);
        s.shading = s.facing;
        const place here{point.uv, s.rest};
        if constexpr (has<effect::bump>)
            if (made_of.height) {
                const vec3 n = bumped(made_of, point, here), carried = moved.template carry_direction<effects>(n, time);
                // A bump that turns its back on the viewer is not seen.
                const vec3 facing = front ? carried : vec3(-carried);
                if (facing.dot(r.direction) < 0) s.shading = facing;
            }
        s.albedo = made_of.albedo;
        if constexpr (has<effect::texture>)
            if (made_of.texture) s.albedo *= made_of.texture(here);
        s.f0 = made_of.f0;
        s.roughness = made_of.roughness;
        if constexpr (has<effect::roughness_map>)
            if (made_of.roughness_map) s.roughness = made_of.roughness_map(here);
        s.ior = made_of.ior;
        s.emission = front ? made_of.emission : grey(0);
        s.light = light_of_part_[m.part];
        s.object = part.object;
        return s;
    }
    /// Where a point of an object, given in its rest pose, is at a time.
    vec3 carried(int object, const vec3& rest, double time) const {
        return scene_.objects[object].template carry<effects>(rest, time);
    }

    rgb sky(const vec3& direction) const { return scene_.sky ? scene_.sky(direction) : grey(0); }

    // Lights.
    int lights() const { return static_cast<int>(lights_.size()); }
    int sky_light() const { return sky_light_; }  ///< its number, the last one; -1 without a sky
    rgb emission(int light, const vec3& direction) const {
        const int part = lights_[light].part;
        return part == sky_part ? sky(direction) : scene_.materials[scene_.parts[part].material].emission;
    }
    double choice_probability(int light) const { return lights_[light].probability; }
    /// The light that a number in [0, 1) chooses.
    int choose(double u) const {
        int i = 0;
        while (i + 1 < lights() && u >= lights_[i].cumulative) ++i;
        return i;
    }
    /// A direction towards the light.  The sky is sampled as a diffuse surface of that normal sees it; without a normal
    /// (0), evenly.
    light_sample sample(int light, const vec3& from, const vec3& normal, const vec2& u) const {
        if (lights_[light].part == sky_part) {
            if (normal == vec3::Zero()) return {polar_direction(1 - 2 * u.x(), u.y()), infinity, 1 / (4 * pi)};
            const vec3 local = cosine_direction(u);
            return {basis(normal).to_world(local), infinity, local.z() / pi};
        }
        return as_light(light, [&](const auto& shape) { return sample_light(shape, from, u); });
    }
    /// The density with which `sample` gives this direction, times the probability of the choice.
    double pdf(int light, const vec3& normal, const ray& r, double distance) const {
        if (lights_[light].part != sky_part)
            return lights_[light].probability *
                   as_light(light, [&](const auto& shape) { return light_pdf(shape, r, distance); });
        const double density = normal == vec3::Zero() ? 1 / (4 * pi) : std::max(0.0, normal.dot(r.direction)) / pi;
        return lights_[light].probability * density;
    }
    /// Calls f with the shape of a light that is not the sky.
    template <class F>
    auto as_light(int light, const F& f) const {
        using result = decltype(f(std::declval<const quad&>()));
        return std::visit(
            [&]<class S>(const S& shape) -> result {
                if constexpr (light_shape<S>) return f(shape);
                else fail("a light of a shape that cannot be sampled");  // check() has refused it
            },
            scene_.parts[lights_[light].part].shape);
    }

private:
    struct light {
        int part;
        double probability, cumulative;
    };

    double intersect(const typename Scene::part& part, const ray& r, double time) const {
        const motion& moved = scene_.objects[part.object];
        ray local = r;
        if constexpr (has<effect::translation> || has<effect::rotation>)
            if (part.object > 0) {
                local.origin = moved.template bring_back<effects>(r.origin, time);
                local.direction = moved.template bring_back_direction<effects>(r.direction, time);
            }
        return std::visit([&](const auto& shape) { return shape.intersect(local, near); }, part.shape);
    }

    /// n' = normalise(n - h_s s - h_t t), the height differentiated along the surface.
    static vec3 bumped(const material& m, const surface_point& point, const place& here) {
        constexpr double step = 1e-4;
        const vec3 s = point.tangent, t = point.normal.cross(s);
        const auto slope = [&](const vec3& along) {
            return (m.height({here.uv, here.rest + step * along}) - m.height({here.uv, here.rest - step * along})) /
                   (2 * step);
        };
        return (point.normal - slope(s) * s - slope(t) * t).normalized();
    }

    void find_lights() {
        light_of_part_.assign(scene_.parts.size(), -1);
        if constexpr (has<effect::area_light>) {
            double total = 0;
            const auto add = [&](int part, double selection) {
                lights_.push_back({part, selection, total += selection});
            };
            for (std::size_t i = 0; i < scene_.parts.size(); ++i)
                if (const material& m = scene_.materials[scene_.parts[i].material]; m.emits()) {
                    light_of_part_[i] = lights();
                    add(static_cast<int>(i), m.selection);
                }
            if (scene_.sky) sky_light_ = lights(), add(sky_part, scene_.sky_selection);
            for (light& l : lights_) l.probability /= total, l.cumulative /= total;
        }
    }

    void check() const {
        const auto needs = [](bool present, bool declared, const std::string& what, const std::string& effect) {
            if (present && !declared) fail(what + ", but the scene does not declare the effect " + effect);
        };
        for (const material& m : scene_.materials) {
            const std::string who = "material " + m.name;
            needs(m.texture, has<effect::texture>, who + " has a texture", effect::texture::name());
            needs(m.height, has<effect::bump>, who + " has bumps", effect::bump::name());
            needs(m.roughness_map, has<effect::roughness_map>, who + " has a roughness map",
                  effect::roughness_map::name());
            needs(m.is_mirror(), has<effect::mirror>, who + " is a mirror", effect::mirror::name());
            needs(m.is_specular() && !m.is_mirror(), has<effect::glossy>, who + " is glossy", effect::glossy::name());
            needs(m.selection != 1, has<effect::fireflies>, who + " is chosen unlike others",
                  effect::fireflies::name());
        }
        for (const motion& m : scene_.objects) {
            needs(m.moves(), has<effect::translation>, "an object moves", effect::translation::name());
            needs(m.turns(), has<effect::rotation>, "an object turns", effect::rotation::name());
        }
        const homogeneous_medium& fog = scene_.medium;
        needs(fog.extinction != 0, has<effect::medium>, "there is a medium", effect::medium::name());
        if (!(fog.extinction >= 0) || !(std::abs(fog.anisotropy) < 1))
            fail("the medium has an extinction of " + std::to_string(fog.extinction) + " and an anisotropy of " +
                 std::to_string(fog.anisotropy) + ": expected 0 or more, and between -1 and 1");
        if (fog.extinction > 0 && has<effect::caustics>) fail("caustics in a medium are not simulated");
        if (!(scene_.photons_per_sample >= 0))
            fail(std::to_string(scene_.photons_per_sample) + " photons per sample: expected 0 or more");
        needs(scene_.sky_selection != 1, has<effect::fireflies>, "the sky is chosen unlike lights",
              effect::fireflies::name());
        for (const auto& part : scene_.parts) {
            if (part.material < 0 || part.material >= static_cast<int>(scene_.materials.size()))
                fail("a part is of material " + std::to_string(part.material) + ", there are " +
                     std::to_string(scene_.materials.size()));
            if (part.object < 0 || part.object >= static_cast<int>(scene_.objects.size()))
                fail("a part is of object " + std::to_string(part.object) + ", there are " +
                     std::to_string(scene_.objects.size()));
            const material& m = scene_.materials[part.material];
            if (!m.emits()) continue;
            if (part.object != 0) fail("material " + m.name + " emits and moves, which is not supported");
            const bool sampled = std::visit(
                []<class S>(const S& s) {
                    if constexpr (std::is_same_v<S, ellipsoid>) return s.radii() == vec3::Constant(s.radii().x());
                    else return light_shape<S>;
                },
                part.shape);
            if (!sampled) fail("material " + m.name + " emits from a shape that is neither a quad nor a sphere");
        }
    }

    Scene scene_;
    int frame_;
    bvh tree_;
    double radius_ = 1;
    vec3 centre_ = vec3::Zero();
    std::vector<light> lights_;
    std::vector<int> light_of_part_;
    int sky_light_ = -1;
};

}  // namespace winnow::simulate
