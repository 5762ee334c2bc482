// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What the channels of a guide are called in a file.
#include <string>
#include <string_view>
#include <vector>
#include <winnow/frame/path_guides.hpp>
#include <winnow/frame/planes.hpp>

namespace winnow::io {

namespace detail {

/// The guide that statistics of a guide are about.
template <class G>
struct underlying {
    using type = G;
};
template <template <class> class Statistic, class G>
struct underlying<Statistic<G>> : underlying<G> {};

template <class G>
inline constexpr bool is_covariance = false;
template <class G>
inline constexpr bool is_covariance<covariance_of<G>> = true;

}  // namespace detail

/// The letters of the channels of a guide, or of what a statistic is about.
template <guide G>
constexpr std::string_view channel_letters(G) {
    using base = typename detail::underlying<G>::type;
    constexpr bool is_distance = std::is_same_v<base, depth_t> || std::is_same_v<base, view_depth_t>;
    constexpr bool is_direction = std::is_same_v<base, normal_t> || std::is_same_v<base, normal2_t>;
    static_assert(base::channels <= 4, "channels of files are called by single letters");
    if constexpr (base::channels == 1) return is_distance ? "Z" : "V";
    else if constexpr (base::channels == 2) return "XY";
    else if constexpr (is_direction || is_point<base>) return "XYZ";
    else return std::string_view("RGBA").substr(0, base::channels);
}

/// One name for each channel: the layer is called as the guide is, only that of the colour has no name of its own.
///     R G B, halfA.R, variance.R;  albedo.R, albedo.variance.R;  normal.X, normal.halfA.X;  position.covariance.XX;
///     depth.Z;  roughness.V;  motion_vector.X
/// `plane` is the name of a guide ("color", "normal.halfA"); of a covariance, letters go in pairs.
inline std::vector<std::string> channel_names(const std::string& plane, std::string_view letters,
                                              bool covariance = false) {
    std::string layer = plane + ".";
    if (layer.starts_with("color.")) layer.erase(0, std::string_view("color.").size());
    std::vector<std::string> names;
    for (std::size_t i = 0; i < letters.size(); ++i) {
        if (covariance)
            for (std::size_t j = i; j < letters.size(); ++j) names.push_back(layer + letters[i] + letters[j]);
        else names.push_back(layer + letters[i]);
    }
    return names;
}

template <guide G>
std::vector<std::string> channel_names(G g) {
    return channel_names(G::name(), channel_letters(g), detail::is_covariance<G>);
}

/// Those of all guides of a list, in its order.
template <guide... G>
std::vector<std::string> channel_names(planes<G...>) {
    std::vector<std::string> all;
    const auto append = [&](const std::vector<std::string>& names) {
        all.insert(all.end(), names.begin(), names.end());
    };
    (append(channel_names(G{})), ...);
    return all;
}

}  // namespace winnow::io
