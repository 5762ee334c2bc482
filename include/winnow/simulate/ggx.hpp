// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The GGX microfacet lobe with height-correlated Smith shadowing and Schlick's Fresnel, in the local frame (+z is the
/// normal).  Walter et al. 2007; Heitz 2014 and 2018.
#include <winnow/simulate/vector.hpp>

namespace winnow::simulate {

/// F0 + (1 - F0)(1 - cosine)^5.
inline rgb schlick(const rgb& f0, double cosine) {
    const double m = std::max(0.0, 1 - cosine), m2 = m * m;
    return f0 + (1 - f0) * (m2 * m2 * m);
}

/// The reflectance of a smooth dielectric for unpolarised light; `eta` is the index of the far side over the near one.
inline double dielectric(double cosine, double eta) {
    const double sine2 = (1 - cosine * cosine) / (eta * eta);
    if (sine2 >= 1) return 1;  // total reflection
    const double far = std::sqrt(1 - sine2);
    const double s = (cosine - eta * far) / (cosine + eta * far), p = (eta * cosine - far) / (eta * cosine + far);
    return (s * s + p * p) / 2;
}

struct ggx {
    double alpha;  ///< squared perceptual roughness, above 0

    /// Normals of microfacets per solid angle.
    double density(double cosine) const {
        const double a2 = alpha * alpha, c2 = cosine * cosine;
        // (1 - c^2) + a^2 c^2 instead of c^2 (a^2 - 1) + 1: no cancellation where a is small and c near 1.
        const double d = (1 - cosine) * (1 + cosine) + a2 * c2;
        return a2 / (pi * d * d);
    }
    /// Smith's Lambda: masked over visible area.
    double lambda(double cosine) const {
        const double c2 = cosine * cosine, tangent2 = (1 - cosine) * (1 + cosine) / c2;
        return (std::sqrt(1 + alpha * alpha * tangent2) - 1) / 2;
    }
    /// f cos for F = 1; 0 below the horizon.
    double value(const vec3& out, const vec3& in) const {
        if (out.z() <= 0 || in.z() <= 0) return 0;
        const vec3 half = (out + in).normalized();
        return density(half.z()) / (4 * out.z() * (1 + lambda(out.z()) + lambda(in.z())));
    }
    /// The density of `sample`, per solid angle.
    double pdf(const vec3& out, const vec3& in) const {
        if (out.z() <= 0 || in.z() <= 0) return 0;
        const vec3 half = (out + in).normalized();
        return density(half.z()) / (4 * out.z() * (1 + lambda(out.z())));
    }
    /// A direction by way of a visible microfacet; may lie below the horizon, where nothing is reflected.
    vec3 sample(const vec3& out, const vec2& u) const {
        // Stretched, the surface is a hemisphere: its visible part seen from `out` is a half disc and a half ellipse.
        const vec3 stretched = vec3(alpha * out.x(), alpha * out.y(), out.z()).normalized();
        const vec2 d = on_disc(u);
        // t lies in the plane of the normal.
        const vec3 s = stretched.z() < 0.9999999 ? vec3(-stretched.y(), stretched.x(), 0).normalized() : vec3(1, 0, 0);
        const vec3 t = stretched.cross(s);
        const double share = (1 + stretched.z()) / 2;
        const double x = d.x(), y = (1 - share) * std::sqrt(std::max(0.0, 1 - x * x)) + share * d.y();
        const vec3 n = x * s + y * t + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
        const vec3 half = vec3(alpha * n.x(), alpha * n.y(), std::max(1e-12, n.z())).normalized();
        return 2 * out.dot(half) * half - out;
    }
};

}  // namespace winnow::simulate
