// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Dual-buffer non-local means.
/// Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012.
#include <winnow/distance/noise_normalized.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/filter/dual_buffer.hpp>
#include <winnow/weight/exponential.hpp>
#include <winnow/weight/patch_mean.hpp>

namespace winnow::paper {

/// Weights from patches of the noisy colour, in units of its noise.
using nlm = filter<weight::exponential<distance::patch<distance::noise_normalized<color_t>>>>;

/// Each half filtered with weights from the other, as the paper has it.
using nlm_2012 = dual_buffer<nlm>;

/// As its authors released it: the weights are averaged over the patch before they are used.
using nlm_2012_released =
    dual_buffer<filter<weight::patch_mean<weight::exponential<distance::patch<distance::noise_normalized<color_t>>>>>>;

struct nlm_2012_numbers {
    int radius = 10;         ///< of the window, in pixels
    int patch_radius = 3;    ///< in pixels
    float k = 0.45f;         ///< sensitivity to colour differences: larger filters more
    float epsilon = 1e-10f;  ///< see distance::noise_normalized
};

constexpr nlm make_nlm(nlm_2012_numbers n = {}) {
    return {exponential(patch(noise_normalized(color, {n.k, n.epsilon}), {n.patch_radius})),
            window::square{.radius = n.radius}};
}
constexpr nlm_2012 make_nlm_2012(nlm_2012_numbers n = {}) { return {make_nlm(n)}; }
constexpr nlm_2012_released make_nlm_2012_released(nlm_2012_numbers n = {}) {
    return {{patch_mean(make_nlm(n).weight, {n.patch_radius}), window::square{.radius = n.radius}}};
}

}  // namespace winnow::paper
