// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The joint (cross) bilateral filter: colour averaged where noise-free features agree.
/// Eisemann, Durand, "Flash Photography Enhancement via Intrinsic Relighting", 2004;
/// Petschnigg et al., "Digital Photography with Flash and No-Flash Image Pairs", 2004.
#include <winnow/distance/spatial.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/gaussian.hpp>

namespace winnow::paper {

/// A product of Gaussians: of the distance in pixels, and of two features.
using joint_bilateral = filter<weight::product_of<
    weight::product_of<weight::gaussian<distance::spatial>, weight::gaussian<distance::squared_difference<albedo_t>>>,
    weight::gaussian<distance::squared_difference<normal_t>>>>;

/// sigma_spatial in pixels, the others in the unit of their guide.  The defaults were chosen on renders at 8 to 32
/// samples per pixel.
struct joint_bilateral_numbers {
    int radius = 6;
    float sigma_spatial = 2.0f;
    float sigma_albedo = 0.05f;
    float sigma_normal = 0.2f;
};

constexpr joint_bilateral make_joint_bilateral(joint_bilateral_numbers n = {}) {
    return {gaussian(spatial, n.sigma_spatial) * gaussian(l2(albedo), n.sigma_albedo) *
                gaussian(l2(normal), n.sigma_normal),
            window::square{.radius = n.radius}};
}

/// The bilateral filter, guided by the noisy colour itself.
/// Tomasi, Manduchi, "Bilateral Filtering for Gray and Color Images", 1998.
using bilateral = filter<
    weight::product_of<weight::gaussian<distance::spatial>, weight::gaussian<distance::squared_difference<color_t>>>>;

/// sigma_spatial in pixels, sigma_color in units of radiance.
struct bilateral_numbers {
    int radius = 6;
    float sigma_spatial = 2.0f;
    float sigma_color = 0.1f;
};

constexpr bilateral make_bilateral(bilateral_numbers n = {}) {
    return {gaussian(spatial, n.sigma_spatial) * gaussian(l2(color), n.sigma_color),
            window::square{.radius = n.radius}};
}

}  // namespace winnow::paper
