// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What is wrong with a frame: pixels that are no numbers, counted and located, and buffers that look like a mistake.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>
#include <winnow/frame/frame.hpp>

namespace winnow {

/// Pixels of a layer with at least one channel of a kind, and where the first few of them are.
struct bad_pixels {
    struct position {
        int x = 0, y = 0;
        bool operator==(const position&) const = default;
    };
    static constexpr std::size_t shown = 4;

    std::int64_t count = 0;
    std::vector<position> first;  ///< in reading order, at most `shown`

    void add(int x, int y) {
        if (first.size() < shown) first.push_back({x, y});
        ++count;
    }
};

/// The bad pixels of one layer.
struct layer_diagnosis {
    std::string name;
    extent size;
    bad_pixels nan;
    bad_pixels inf;
    bad_pixels negative;  ///< of variances only: radiance may be negative

    bool clean() const { return nan.count + inf.count + negative.count == 0; }
};

/// All layers of a frame, and in whole sentences what looks like a mistake.
struct diagnosis {
    std::vector<layer_diagnosis> layers;
    std::vector<std::string> warnings;
};

/// Counts and locates the bad pixels of a layer.
inline layer_diagnosis diagnose(const std::string& name, const source& layer, bool is_variance = false) {
    layer_diagnosis found{name, layer.size, {}, {}, {}};
    for (int y = 0; y < layer.size.height; ++y)
        for (int x = 0; x < layer.size.width; ++x) {
            bool nan = false, inf = false, negative = false;
            for (int c = 0; c < layer.channels; ++c) {
                const float v = layer.channel(c).at(x, y);
                // Bits, because a compiler that is told that there are no NaNs removes comparisons.
                const std::uint32_t magnitude = std::bit_cast<std::uint32_t>(v) & 0x7fffffffu;
                nan = nan || magnitude > 0x7f800000u;
                inf = inf || magnitude == 0x7f800000u;
                negative = negative || (is_variance && is_finite(v) && v < 0);
            }
            if (nan) found.nan.add(x, y);
            if (inf) found.inf.add(x, y);
            if (negative) found.negative.add(x, y);
        }
    return found;
}

namespace detail {

/// The buffers that a frame may have, with their companions.
using all_guides = planes<color_t, albedo_t, normal_t, depth_t, position_t, visibility_t, roughness_t>;

/// f(pixel) for every pixel of which all channels are finite; `pixel` points to its channels, at most four.
template <class F>
void for_finite_pixels(const source& layer, const F& f) {
    float pixel[4] = {};
    const int channels = std::min(layer.channels, 4);
    for (int y = 0; y < layer.size.height; ++y)
        for (int x = 0; x < layer.size.width; ++x) {
            bool finite = true;
            for (int c = 0; c < channels; ++c) {
                pixel[c] = layer.channel(c).at(x, y);
                finite = finite && is_finite(pixel[c]);
            }
            if (finite) f(pixel);
        }
}

inline double mean_of(const source& layer) {
    double sum = 0;
    std::int64_t count = 0;
    for_finite_pixels(layer, [&](const float* v) {
        for (int c = 0; c < layer.channels; ++c) sum += v[c];
        count += layer.channels;
    });
    return count ? sum / static_cast<double>(count) : 0;
}

inline std::string percent(double share) { return std::to_string(static_cast<int>(std::lround(100 * share))) + " %"; }

/// A unit vector n stored as (n + 1) / 2 has no negative component, and 2 v - 1 has length 1.
inline void doubt_normals(const source& normal, std::vector<std::string>& warnings) {
    std::int64_t seen = 0, unit = 0, unit_when_decoded = 0;
    float smallest = 0;
    for_finite_pixels(normal, [&](const float* n) {
        double plain = 0, decoded = 0;
        for (int c = 0; c < 3; ++c) {
            smallest = std::min(smallest, n[c]);
            plain += n[c] * n[c];
            decoded += (2 * n[c] - 1) * (2 * n[c] - 1);
        }
        if (plain < 1e-6) return;  // nothing was hit
        ++seen;
        unit += std::abs(plain - 1) < 0.1;
        unit_when_decoded += std::abs(decoded - 1) < 0.1;
    });
    if (seen && smallest >= 0 && unit_when_decoded * 10 > seen * 9 && unit * 10 < seen * 5)
        warnings.push_back("normal looks encoded as (n + 1) / 2; decode it as 2 v - 1");
    if (!seen) warnings.push_back("normal is zero everywhere");
}

inline void doubt_albedo(const source& albedo, std::vector<std::string>& warnings) {
    std::int64_t seen = 0, above = 0;
    float largest = 0;
    for_finite_pixels(albedo, [&](const float* a) {
        const float most = std::max({a[0], a[1], a[2]});
        largest = std::max(largest, most);
        above += most > 1.001f;
        ++seen;
    });
    if (above)
        warnings.push_back("albedo is above 1 in " + std::to_string(above) + " pixels (up to " +
                           std::to_string(largest) + "): it holds emission or sky");
    if (seen && largest == 0) warnings.push_back("albedo is zero everywhere");
}

/// What two halves of the samples say about each other, about their mean and about its variance.
inline void doubt_halves(const std::string& name, const source& mean, const source& variance, const source& a,
                         const source& b, std::vector<std::string>& warnings) {
    std::int64_t differing = 0, off = 0, seen = 0;
    double squares = 0, variances = 0;
    for (int c = 0; c < a.channels; ++c)
        for (int y = 0; y < a.size.height; ++y)
            for (int x = 0; x < a.size.width; ++x) {
                const float first = a.channel(c).at(x, y), second = b.channel(c).at(x, y);
                if (!is_finite(first) || !is_finite(second)) continue;
                ++seen;
                differing += first != second;
                const float middle = (first + second) / 2;
                // Sums over all pixels are at the mercy of the brightest: each counts relative to its brightness.
                const double unit = 0.01 + double{middle} * middle;
                if (mean && is_finite(mean.channel(c).at(x, y)))
                    off += std::abs(mean.channel(c).at(x, y) - middle) > 0.1 * std::sqrt(unit);
                if (variance && is_finite(variance.channel(c).at(x, y))) {
                    squares += double{first - second} * (first - second) / 4 / unit;
                    variances += variance.channel(c).at(x, y) / unit;
                }
            }
    if (!seen) return;
    if (!differing) {
        warnings.push_back(name + ": both halves are the same image; they must come from different samples");
        return;
    }
    if (off * 4 > seen)
        warnings.push_back(name + " is not the mean of its halves in " +
                           percent(static_cast<double>(off) / static_cast<double>(seen)) + " of its values");
    // One degree of freedom a value: only many of them say anything about the scale.
    if (seen >= 1000 && squares > 0 && variances > 0 && (variances > 3 * squares || squares > 3 * variances))
        warnings.push_back(name + ".variance is " + std::to_string(variances / squares) +
                           " times what the halves say; is it that of the pixel mean?");
}

}  // namespace detail

/// Looks at every buffer that the frame has.  Warnings are conservative: they name what is surely odd, and an empty
/// list proves nothing.
template <class Frame>
diagnosis diagnose(const Frame& in) {
    diagnosis result;
    const auto layer = [&]<class G>(G) -> source {
        if constexpr (Frame::has(G{})) return in.find(G{});
        else return {};
    };
    detail::all_guides::for_each([&]<class G>(G g) {
        const source mean = layer(g), noise = layer(variance(g)), a = layer(first_half(g)), b = layer(second_half(g));
        const auto look = [&](auto named, const source& at, bool is_variance) {
            if (at) result.layers.push_back(diagnose(named.name(), at, is_variance));
        };
        look(g, mean, false);
        look(variance(g), noise, true);
        look(first_half(g), a, false);
        look(second_half(g), b, false);
        for (const source& at : {mean, noise, a, b})
            if (at && at.channels != G::channels) return;  // the filter says so
        if (a && b && a.size == b.size && (!mean || mean.size == a.size) && (!noise || noise.size == a.size))
            detail::doubt_halves(g.name(), mean, noise, a, b, result.warnings);
        if (std::is_same_v<G, color_t> && noise && detail::mean_of(noise) == 0)
            result.warnings.push_back("color.variance is zero everywhere: nothing is taken for noise");
        if (!mean) return;
        if constexpr (std::is_same_v<G, color_t>)
            if (detail::mean_of(mean) == 0) result.warnings.push_back("color is zero everywhere");
        if constexpr (std::is_same_v<G, normal_t>) detail::doubt_normals(mean, result.warnings);
        if constexpr (std::is_same_v<G, albedo_t>) detail::doubt_albedo(mean, result.warnings);
    });
    return result;
}

}  // namespace winnow
