// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Materials: what a surface is made of, and how that varies over it.
#include <string>
#include <winnow/simulate/vector.hpp>

namespace winnow::simulate {

/// Where on a surface: the coordinates of the shape, and the point in the rest pose of its object.
struct place {
    vec2 uv;
    vec3 rest;
};

/// A map over a surface; a lambda without captures is one.
template <class Value>
using map = Value (*)(const place&);

/// A diffuse lobe under a specular one (GGX with Schlick's Fresnel), or glass.  Lobes are added: for energy to be kept,
/// albedo + F0 must not exceed 1.
struct material {
    std::string name;
    rgb albedo = grey(0);
    rgb f0 = grey(0);        ///< specular reflectance at normal incidence
    double roughness = 0;    ///< perceptual: the root of the GGX alpha; 0 is a mirror
    double ior = 0;          ///< index of refraction; glass where it is not 0
    rgb emission = grey(0);  ///< radiance, from the side of the normal
    double selection = 1;    ///< as a light: how often it is chosen, relative to others; see effect::fireflies

    map<rgb> texture = nullptr;           ///< times the albedo
    map<double> height = nullptr;         ///< bumps: height over the surface, in world units; by `rest`, not uv
    map<double> roughness_map = nullptr;  ///< instead of the roughness

    bool emits() const { return (emission > 0).any(); }
    bool is_specular() const { return (f0 > 0).any(); }
    bool is_mirror() const { return ior > 0 || (is_specular() && roughness == 0 && !roughness_map); }
};

}  // namespace winnow::simulate
