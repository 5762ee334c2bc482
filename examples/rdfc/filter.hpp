// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// RDFC and its sampling density, compiled once for all scenes.
#include <array>
#include <winnow/executor/workspace.hpp>
#include <winnow/image/image.hpp>

#include "guides.hpp"

namespace rdfc {

/// Which of the candidates FIRST, SECOND and THIRD a pixel is made of.
enum class selection { binary, blend, first, second, third };

/// The names of the selections, in their order.
inline constexpr std::array selection_names{"binary", "blend", "first", "second", "third"};

/// As paper::rdfc_numbers, but that epsilon is in units of the squared mean of the colour.
struct settings {
    int radius, feature_radius;
    float k_color, k_feature, tau, tau_third, epsilon, feature_share;
    selection choice = selection::binary;
    int error_radius = -1;  ///< over which the selection smooths its errors, in pixels; below 0: its own
    int threads = 0;        ///< 0: all

    settings();  ///< what the library has by default
};

struct filtered {
    winnow::image<float> color;
    winnow::image<float> share;    ///< of FIRST, SECOND and THIRD: three channels that add up to 1
    winnow::image<float> density;  ///< where the next samples should go, up to a factor; empty without counts
};

/// `counts`: how many samples each pixel has, one channel; null where the density is not asked for.
filtered filter(const guides& in, const settings& s, winnow::workspace& memory,
                const winnow::image<float>* counts = nullptr);

}  // namespace rdfc
