// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// One candidate of RDFC: colour and features decide together.
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, sections 4 to 6.
#include <winnow/distance/combine.hpp>
#include <winnow/distance/cross_feature.hpp>
#include <winnow/distance/noise_normalized.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/exponential.hpp>

namespace winnow::paper {

/// The smaller of a non-local means weight of the colour and a bilateral weight of the least similar feature.
using rdfc_candidate =
    filter<weight::min_of<weight::exponential<distance::patch<distance::noise_normalized<color_t>>>,
                          weight::exponential<distance::max_of<
                              distance::max_of<distance::cross_feature<albedo_t>, distance::cross_feature<normal_t>>,
                              distance::cross_feature<depth_t>>>>>;

/// The defaults are the paper's SECOND candidate; patch_radius 1 gives FIRST.
struct rdfc_candidate_numbers {
    int radius = 10;         ///< of the window, in pixels: the one parameter that the paper leaves to the user
    int patch_radius = 3;    ///< in pixels
    float k_color = 0.45f;   ///< sensitivity to colour differences: larger filters more
    float k_feature = 0.6f;  ///< sensitivity to feature differences
    float tau = 1e-3f;       ///< see distance::cross_feature
    float epsilon = 1e-10f;  ///< see distance::noise_normalized
};

constexpr rdfc_candidate make_rdfc_candidate(rdfc_candidate_numbers n = {}) {
    return {min(exponential(patch(noise_normalized(color, {n.k_color, n.epsilon}), {n.patch_radius})),
                exponential(max(cross(albedo, {n.k_feature, n.tau}), cross(normal, {n.k_feature, n.tau}),
                                cross(depth, {n.k_feature, n.tau})))),
            window::square{.radius = n.radius}};
}

}  // namespace winnow::paper
