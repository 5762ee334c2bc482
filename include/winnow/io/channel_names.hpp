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

/// The letters of the channels of a guide that is no statistic.
template <class G>
constexpr std::string_view letters() {
    constexpr bool is_distance = std::is_same_v<G, depth_t> || std::is_same_v<G, view_depth_t>;
    constexpr bool is_direction = std::is_same_v<G, normal_t> || std::is_same_v<G, normal2_t>;
    if constexpr (G::channels == 1) return is_distance ? "Z" : "V";
    else if constexpr (G::channels == 2) return "XY";
    else if constexpr (is_direction || is_point<G>) return "XYZ";
    else return "RGBA";
}

inline std::vector<std::string> channels_called(const std::string& plane, std::string_view letters,
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

}  // namespace detail

/// One name for each channel: the layer is called as the guide is, only that of the colour has no name of its own.
///     R G B, halfA.R, variance.R;  albedo.R, albedo.variance.R;  normal.X, normal.halfA.X;  position.covariance.XX;
///     depth.Z;  roughness.V;  motion_vector.X
template <guide G>
std::vector<std::string> channel_names(G) {
    using base = typename detail::underlying<G>::type;
    constexpr std::string_view letters = detail::letters<base>();
    static_assert(base::channels <= static_cast<int>(letters.size()), "channels of files are called by single letters");
    return detail::channels_called(G::name(), letters.substr(0, base::channels), detail::is_covariance<G>);
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
