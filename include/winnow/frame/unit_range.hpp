// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Features in unit range, as distances between features expect them (see distance::cross_feature).  What is looked up
/// over the whole image is rounded to three bits, so that a single bad pixel rarely changes it.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>
#include <winnow/frame/path_guides.hpp>
#include <winnow/image/image.hpp>

namespace winnow {

/// How the values of one channel are mapped:  (f(x) - offset) * factor, where f(x) is x, or log2(1 + max(x, 0)), or x
/// with 0 for what is not there.
struct value_map {
    enum class kind { linear, logarithmic, with_sky } of = kind::linear;
    float offset = 0, factor = 1;

    float operator()(float x) const { return (inner(x) - offset) * factor; }
    /// The variance of the mapped value, to first order, from that of x; 0 for what is not there.
    float variance(float x, float variance_of_x) const {
        if (of == kind::with_sky && is_sky(x)) return 0;
        const float slope = of == kind::logarithmic ? 1.442695f / (1 + std::max(x, 0.0f)) * factor : factor;
        return variance_of_x * slope * slope;
    }
    float inner(float x) const {
        if (of == kind::logarithmic) return is_finite(x) ? std::log2(1 + std::max(x, 0.0f)) : x;
        return of == kind::with_sky && is_sky(x) ? 0.0f : x;
    }
    /// Where renderers put the distance of what is not there.
    static bool is_sky(float x) { return !is_finite(x) || std::abs(x) >= 1e9f; }
};

namespace detail {

/// The positive value, upwards to three bits; 1 for what is not positive.
inline float rounded_up(float value) {
    if (!(value > 0)) return 1;
    int exponent;
    const float mantissa = std::frexp(value, &exponent);
    return std::ldexp(std::ceil(mantissa * 8) / 8, exponent);
}

/// The value below which a share of the finite values of a channel lies, after `map`; 0 without any.
inline float quantile(const source& channel, const value_map& map, double share) {
    std::vector<float> values;
    for (int y = 0; y < channel.size.height; ++y)
        for (int x = 0; x < channel.size.width; ++x)
            if (const float v = map(channel.at(x, y)); is_finite(v)) values.push_back(v);
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace detail

/// The map of each channel of a feature, worked out from its mean over the whole image:
///     normals (n + 1) / 2;  albedo and other reflectances log2(1 + a) over their maximum, because real files hold
///     emission and sky in them, up to hundreds;  depth over its maximum, 0 for the sky;  positions over the largest
///     side of the box that holds them;  caustics over their 99th percentile;  what is in unit range already, as it is.
template <guide G>
std::array<value_map, G::channels> unit_range(G, const source& mean) {
    using kind = value_map::kind;
    std::array<value_map, G::channels> maps{};
    const auto largest = [&](double share) {
        float most = 0;
        for (int c = 0; c < G::channels; ++c)
            most = std::max(most, detail::quantile(mean.channel(c), maps[static_cast<std::size_t>(c)], share));
        return detail::rounded_up(most);
    };
    const auto for_each = [&](const auto& f) {
        for (value_map& m : maps) f(m);
    };
    if constexpr (std::is_same_v<G, normal_t> || std::is_same_v<G, normal2_t>) {
        for_each([](value_map& m) { m = {kind::linear, -1, 0.5f}; });
    } else if constexpr (std::is_same_v<G, albedo_t> || std::is_same_v<G, albedo2_t> || std::is_same_v<G, brdf_t>) {
        for_each([](value_map& m) { m.of = kind::logarithmic; });
        for_each([by = 1 / largest(1)](value_map& m) { m.factor = by; });
    } else if constexpr (std::is_same_v<G, depth_t> || std::is_same_v<G, view_depth_t>) {
        for_each([](value_map& m) { m.of = kind::with_sky; });
        for_each([by = 1 / largest(1)](value_map& m) { m.factor = by; });
    } else if constexpr (is_point<G>) {
        for_each([](value_map& m) { m.of = kind::with_sky; });
        float side = 0;
        for (int c = 0; c < G::channels; ++c) {
            value_map& m = maps[static_cast<std::size_t>(c)];
            const float low = detail::quantile(mean.channel(c), m, 0), high = detail::quantile(mean.channel(c), m, 1);
            side = std::max(side, high - low);
            m.offset = low;
        }
        for_each([by = 1 / detail::rounded_up(side)](value_map& m) { m.factor = by; });
    } else if constexpr (std::is_same_v<G, caustic_t>) {
        for_each([by = 1 / largest(0.99)](value_map& m) { m.factor = by; });
    }
    return maps;
}

/// Maps all values of an image; `to` may be `from`.
template <std::size_t Channels>
void map_values(const std::array<value_map, Channels>& maps, const source& from, const target& to) {
    for (int c = 0; c < to.channels; ++c)
        for (int y = 0; y < to.size.height; ++y)
            for (int x = 0; x < to.size.width; ++x)
                to.channel(c).set(x, y, maps[static_cast<std::size_t>(c)](from.channel(c).at(x, y)));
}
/// Maps the variances of an image whose unmapped means are given; `to` may be `from`.
template <std::size_t Channels>
void map_variances(const std::array<value_map, Channels>& maps, const source& mean, const source& from,
                   const target& to) {
    for (int c = 0; c < to.channels; ++c)
        for (int y = 0; y < to.size.height; ++y)
            for (int x = 0; x < to.size.width; ++x)
                to.channel(c).set(
                    x, y,
                    maps[static_cast<std::size_t>(c)].variance(mean.channel(c).at(x, y), from.channel(c).at(x, y)));
}

}  // namespace winnow
