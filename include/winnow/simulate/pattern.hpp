// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Procedural patterns for the maps of materials.
#include <cstdint>
#include <winnow/simulate/random.hpp>

namespace winnow::simulate {

/// 0 and 1 in turn, by squares of side 1.
inline int checker(double u, double v) {
    return (static_cast<int>(std::floor(u)) + static_cast<int>(std::floor(v))) & 1;
}

/// 0 and 1 in turn, by stripes of width 1.
inline int stripe(double u) { return static_cast<int>(std::floor(u)) & 1; }

/// 0 and 1 in turn, by `count` sectors around the origin.
inline int spoke(const vec2& p, int count) { return stripe((std::atan2(p.y(), p.x()) / (2 * pi) + 0.5) * count); }

/// Smooth noise in [0, 1) with features of size 1: random values on a lattice, blended by smooth steps.
inline double value_noise(const vec3& p) {
    const vec3 cell = p.array().floor(), f = p - cell;
    const auto at = [&](int i, int j, int k) {
        const auto bits = [](double c) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(c)); };
        return detail::fraction(static_cast<std::uint32_t>(
            detail::mixed(detail::mixed(bits(cell.x()) + i, bits(cell.y()) + j), bits(cell.z()) + k)));
    };
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const auto blend = [](double a, double b, double t) { return a + t * (b - a); };
    const double x = smooth(f.x()), y = smooth(f.y()), z = smooth(f.z());
    const auto layer = [&](int k) {
        return blend(blend(at(0, 0, k), at(1, 0, k), x), blend(at(0, 1, k), at(1, 1, k), x), y);
    };
    return blend(layer(0), layer(1), z);
}

/// Several octaves of it, each half as large and half as strong; in [0, 1).
inline double fractal_noise(const vec3& p, int octaves) {
    double sum = 0, total = 0, strength = 1, scale = 1;
    for (int i = 0; i < octaves; ++i, strength /= 2, scale *= 2) {
        sum += strength * value_noise(scale * p);
        total += strength;
    }
    return total > 0 ? sum / total : 0;
}

}  // namespace winnow::simulate
