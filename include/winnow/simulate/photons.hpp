// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Photons that have come by mirrors and glass onto diffuse surfaces: the density and the light of caustics.
#include <cstdint>
#include <numeric>
#include <vector>
#include <winnow/simulate/random.hpp>
#include <winnow/simulate/scatter.hpp>

namespace winnow::simulate {

struct photon {
    vec3 position;
    vec3 facing;  ///< normal of the surface, on the side that was met
    rgb power;    ///< of the photon times the number that was emitted
};

/// Photons found by where they are: a hash grid.
class photon_map {
public:
    photon_map() = default;
    /// `emitted` counts those that missed as well; the cells should be about as large as what is looked up.
    photon_map(std::vector<photon> photons, std::int64_t emitted, double cell)
        : cell_(cell), emitted_(static_cast<double>(emitted)) {
        std::uint32_t size = 1;
        while (size < photons.size()) size *= 2;
        first_.assign(size + 1, 0);
        for (const photon& p : photons) ++first_[bucket(cell_of(p.position)) + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        photons_.resize(photons.size());
        for (const photon& p : photons) photons_[next[bucket(cell_of(p.position))]++] = p;
    }

    struct estimate {
        double density = 0;            ///< photons per unit of area and photon emitted
        rgb irradiance = rgb::Zero();  ///< power per unit of area
    };
    /// Over the disc of that radius about p.
    estimate at(const vec3& p, const vec3& normal, double radius) const {
        estimate e;
        if (photons_.empty()) return e;
        const cell low = cell_of(p - vec3::Constant(radius)), high = cell_of(p + vec3::Constant(radius));
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t x = low[0]; x <= high[0]; ++x) {
                    const cell c{x, y, z};
                    const std::uint32_t b = bucket(c);
                    for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i) {
                        const vec3 d = photons_[i].position - p;
                        // Photons of a surface around the corner or of the other side are not of the disc; cells may
                        // share a bucket.
                        if (d.squaredNorm() > radius * radius || std::abs(d.dot(normal)) > 0.1 * radius) continue;
                        if (photons_[i].facing.dot(normal) <= 0 || cell_of(photons_[i].position) != c) continue;
                        e.density += 1;
                        e.irradiance += photons_[i].power;
                    }
                }
        const double share = 1 / (pi * radius * radius * emitted_);
        e.density *= share;
        e.irradiance *= share;
        return e;
    }
    std::size_t size() const { return photons_.size(); }
    /// What all stored photons carry.
    rgb power() const {
        rgb sum = grey(0);
        for (const photon& p : photons_) sum += p.power;
        return sum / std::max(1.0, emitted_);
    }

private:
    using cell = std::array<std::int64_t, 3>;
    cell cell_of(const vec3& p) const {
        const auto of = [&](double c) { return static_cast<std::int64_t>(std::floor(c / cell_)); };
        return {of(p.x()), of(p.y()), of(p.z())};
    }
    std::uint32_t bucket(const cell& c) const {
        const std::uint64_t hash =
            detail::mixed(detail::mixed(static_cast<std::uint64_t>(c[0]), static_cast<std::uint64_t>(c[1])),
                          static_cast<std::uint64_t>(c[2]));
        return static_cast<std::uint32_t>(hash & (first_.size() - 2));
    }

    double cell_ = 1, emitted_ = 0;
    std::vector<std::uint32_t> first_;  ///< of each bucket
    std::vector<photon> photons_;
};

/// Follows photon number `index` of a stream.  Returns false if it does not come by a mirror or glass onto a diffuse
/// surface.  Nothing but mirrors, glass and the area lights takes part; photons of moving objects have a random time.
template <class World>
bool trace_photon(const World& w, std::uint64_t seed, int half, int index, photon& stored) {
    using effects = typename World::effects;
    if (w.lights() == 0) return false;
    const sample_numbers random(pattern::independent, seed, w.frame(), index, half, half);
    double time = w.frame();
    if constexpr (effects::shutter) time += random(draw::time{});
    // The lamp is vertex 1.  The sky, the last of the lights, sends no photons.
    const double lamps = w.sky_light() < 0 ? 1 : 1 - w.choice_probability(w.sky_light());
    const int light = w.choose(lamps * random(draw::light_choice{}, 1));
    if (light == w.sky_light()) return false;  // there are no lamps
    const auto from = w.as_light(light, [&](const auto& shape) { return emit(shape, random(draw::light{}, 1)); });
    ray r{from.position, basis(from.normal).to_world(cosine_direction(random(draw::direction{}, 1)))};
    rgb power = w.emission(light, r.direction) * (pi * from.area * lamps / w.choice_probability(light));
    for (int bounce = 0; bounce < w.description().bounces; ++bounce) {
        const meeting m = w.meet(r, time);
        if (!m) return false;
        const surface s = w.at(r, m, time);
        const scattering<effects> scatters(s, -r.direction);
        const double passed_on = scatters.is_delta() ? scatters.specular_share() : 0;
        const double choice = random(draw::lobe{}, bounce + 2);
        if (choice >= passed_on) {
            if (bounce == 0 || !(s.albedo > 0).any()) return false;
            stored = {s.position, s.facing, power / (1 - passed_on)};  // also for those that are passed on
            return true;
        }
        const scattered next = scatters.sample(choice, [&] { return random(draw::direction{}, bounce + 2); });
        power *= next.weight;
        r = {s.position, next.direction};
    }
    return false;
}

}  // namespace winnow::simulate
