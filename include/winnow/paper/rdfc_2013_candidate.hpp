// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The candidates of RDFC: colour and features decide together.
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, sections 4 to 6.
#include <winnow/distance/combine.hpp>
#include <winnow/distance/cross_feature.hpp>
#include <winnow/distance/noise_normalized.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/exponential.hpp>

namespace winnow::paper {

/// Numbers of one candidate.  The defaults are the paper's SECOND; patch_radius 1 gives FIRST.
struct rdfc_candidate_numbers {
    int radius = 10;         ///< of the window, in pixels: the one parameter that the paper leaves to the user
    int patch_radius = 3;    ///< in pixels
    float k_color = 0.45f;   ///< sensitivity to colour differences: larger filters more
    float k_feature = 0.6f;  ///< sensitivity to feature differences
    float tau = 1e-3f;       ///< see distance::cross_feature
    float epsilon = 1e-10f;  ///< see distance::noise_normalized
};

/// Non-local means weights of the colour (Eq. 2).
constexpr auto rdfc_color_weight(float k, int patch_radius, float epsilon) {
    return exponential(patch(noise_normalized(color, {k, epsilon}), {patch_radius}));
}
/// Bilateral weights of the least similar feature (Eq. 3).
template <guide... Features>
constexpr auto rdfc_feature_weight(planes<Features...>, float k, float tau) {
    return exponential(max(cross(Features{}, {k, tau})...));
}

/// FIRST or SECOND: the smaller of both weights (Eq. 4).
template <class Features>
constexpr auto make_rdfc_candidate_of(rdfc_candidate_numbers n = {}) {
    return filter{min(rdfc_color_weight(n.k_color, n.patch_radius, n.epsilon),
                      rdfc_feature_weight(Features{}, n.k_feature, n.tau)),
                  window::square{.radius = n.radius}};
}
constexpr auto make_rdfc_candidate(rdfc_candidate_numbers n = {}) {
    return make_rdfc_candidate_of<planes<albedo_t, normal_t, depth_t>>(n);
}
using rdfc_candidate = decltype(make_rdfc_candidate());

/// Numbers of the whole filter.
struct rdfc_numbers {
    int radius = 10;           ///< of the window, in pixels; 20 where light has spikes
    int frames = 0;            ///< before and after, of a frame_sequence, in which neighbours are looked for
    float k_color = 0.45f;     ///< sensitivity to colour differences: larger filters more
    float k_feature = 0.6f;    ///< sensitivity to feature differences
    float tau = 1e-2f;         ///< of FIRST and SECOND: squared contrast below which features are alike
    float tau_third = 1e-3f;   ///< of THIRD
    float epsilon = 1e-10f;    ///< variance below which a difference of colours is real
    int feature_radius = 5;    ///< of the window of the feature prefilter, in pixels
    float half_share = 0.25f;  ///< how much of (A - B)^2 is the variance of the mean: see share_of_halves
    float feature_share = 1;   ///< the same, of a filtered feature; by the paper's words, all of it
    int smoothing_patch = 1;   ///< patch radius of the weights that smooth errors and selection maps, in pixels
    int last_patch = 1;        ///< patch radius of the second pass, in pixels
    float last_share = 1;      ///< radius of its window over that of the candidates

    void check() const {
        for (const float share : {half_share, feature_share})
            if (!(share >= 0 && share <= 4))
                fail("rdfc: half_share and feature_share are " + std::to_string(half_share) + " and " +
                     std::to_string(feature_share) + ", they must be between 0 and 4");
        if (!(last_share >= 0 && last_share <= 1))
            fail("rdfc: last_share is " + std::to_string(last_share) + ", it must be between 0 and 1");
    }
};

/// The numbers of the code that its authors released, where they differ from the paper's words.  Of that code's ways
/// these are not here: borders by mirroring, weights averaged over patches, a centre as heavy as the heaviest
/// neighbour, a guess from pairs of opposite neighbours, features in the second pass, finite differences for the
/// derivative.
constexpr rdfc_numbers rdfc_numbers_as_released() {
    rdfc_numbers n;
    n.tau = 1e-3f;
    n.tau_third = 1e-4f;
    n.feature_share = 0.25f;
    n.smoothing_patch = 3;
    n.last_patch = 3;
    n.last_share = 0.5f;
    return n;
}

}  // namespace winnow::paper
