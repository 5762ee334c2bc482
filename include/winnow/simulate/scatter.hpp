// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How a surface scatters: a diffuse and a specular lobe, each evaluated and sampled by itself, so that what comes by
/// one can be told from what comes by the other.
#include <winnow/simulate/effect.hpp>
#include <winnow/simulate/ggx.hpp>
#include <winnow/simulate/world.hpp>

namespace winnow::simulate {

enum class lobe { diffuse, specular };

/// A direction that was chosen.
struct scattered {
    vec3 direction;
    rgb weight;  ///< f cos / pdf; 0 where nothing goes
    double pdf;  ///< per solid angle, times the probability of the lobe; infinity for mirrors and glass
    lobe by;

    bool is_delta() const { return pdf == infinity; }
};

/// The lobes of a surface for one direction to the viewer.
template <class Effects>
class scattering {
public:
    scattering(const surface& s, const vec3& out) : surface_(s), frame_(s.shading), out_(frame_.to_local(out)) {
        if constexpr (specular) {
            if (s.ior > 0) {
                share_ = 1;
            } else if ((s.f0 > 0).any()) {
                const double f = luminance(schlick(s.f0, out_.z())), d = luminance(s.albedo);
                share_ = f / (f + d);
            }
        }
    }

    /// The probability of the specular lobe.
    double specular_share() const { return share_; }
    /// The specular lobe is a mirror or glass: no light sample can meet it.
    bool is_delta() const { return specular && (surface_.ior > 0 || (share_ > 0 && surface_.roughness == 0)); }

    /// f cos towards a direction of the world, and the density with which it is sampled; for mirrors and glass 0.
    rgb value(lobe by, const vec3& direction) const {
        const vec3 in = frame_.to_local(direction);
        if (in.z() <= 0 || direction.dot(surface_.facing) <= 0) return grey(0);
        if (by == lobe::diffuse) return surface_.albedo * (in.z() / pi);
        if constexpr (Effects::template has<effect::glossy>)
            if (share_ > 0 && !is_delta())
                return schlick(surface_.f0, out_.dot((out_ + in).normalized())) * microfacets().value(out_, in);
        return grey(0);
    }
    double pdf(lobe by, const vec3& direction) const {
        const vec3 in = frame_.to_local(direction);
        if (by == lobe::diffuse) return (1 - share_) * std::max(0.0, in.z()) / pi;
        if constexpr (Effects::template has<effect::glossy>)
            if (share_ > 0 && !is_delta()) return share_ * microfacets().pdf(out_, in);
        return 0;
    }

    /// Chooses a lobe and a direction.  `direction` is called for two numbers only where a lobe needs them.
    template <class Direction>
    scattered sample(double choice, const Direction& direction) const {
        if constexpr (specular)
            if (choice < share_) return surface_.ior > 0 ? through_glass(choice) : by_specular(direction);
        if constexpr (Effects::template draws<draw::direction>) {
            const vec3 in = cosine_direction(direction());
            const vec3 to = frame_.to_world(in);
            const bool above = to.dot(surface_.facing) > 0;
            return {to, above ? rgb(surface_.albedo / (1 - share_)) : grey(0), (1 - share_) * in.z() / pi,
                    lobe::diffuse};
        }
        return nowhere();
    }

private:
    static constexpr bool specular = Effects::template has<effect::glossy> || Effects::template has<effect::mirror>;

    static scattered nowhere() { return {vec3::UnitZ(), grey(0), 0, lobe::diffuse}; }
    ggx microfacets() const { return {surface_.roughness * surface_.roughness}; }

    template <class Direction>
    scattered by_specular(const Direction& direction) const {
        if constexpr (Effects::template has<effect::glossy>)
            if (surface_.roughness > 0) {
                const vec3 in = microfacets().sample(out_, direction());
                const vec3 to = frame_.to_world(in);
                const double density = share_ * microfacets().pdf(out_, in);
                const rgb f = value(lobe::specular, to);
                return {to, density > 0 ? rgb(f / density) : grey(0), density, lobe::specular};
            }
        const vec3 to = frame_.to_world({-out_.x(), -out_.y(), out_.z()});
        const bool above = to.dot(surface_.facing) > 0;
        return {to, above ? rgb(schlick(surface_.f0, out_.z()) / share_) : grey(0), infinity, lobe::specular};
    }

    scattered through_glass(double choice) const {
        const bool entering = surface_.facing.dot(surface_.outward) > 0;
        const double eta = entering ? surface_.ior : 1 / surface_.ior, cosine = out_.z();
        const vec3 mirrored(-out_.x(), -out_.y(), cosine);
        if (choice < dielectric(cosine, eta)) return {frame_.to_world(mirrored), grey(1), infinity, lobe::specular};
        const double far = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
        const vec3 refracted(-out_.x() / eta, -out_.y() / eta, -far);
        return {frame_.to_world(refracted), grey(1), infinity, lobe::specular};
    }

    const surface& surface_;
    basis frame_;
    vec3 out_;
    double share_ = 0;
};

/// The phase function of Henyey and Greenstein, about the direction of travel.
struct phase {
    double anisotropy;

    double pdf(double cosine) const {
        const double g = anisotropy, d = 1 + g * g - 2 * g * cosine;
        return (1 - g * g) / (4 * pi * d * std::sqrt(d));
    }
    vec3 sample(const vec3& travel, const vec2& u) const {
        const double g = anisotropy;
        double cosine = 1 - 2 * u.x();
        if (std::abs(g) > 1e-3) {
            const double s = (1 - g * g) / (1 - g + 2 * g * u.x());
            cosine = std::clamp((1 + g * g - s * s) / (2 * g), -1.0, 1.0);
        }
        return basis(travel).to_world(polar_direction(cosine, u.y()));
    }
};

}  // namespace winnow::simulate
