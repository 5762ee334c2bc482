// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Images in which every pixel differs, frames made of them, and comparisons that say where and by how much.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <winnow/frame/frame.hpp>
#include <winnow/image/image.hpp>

namespace winnow::test {

/// Random bits that depend on the counter alone: the same on every machine, in any order.
inline std::uint64_t random_bits(std::uint64_t counter) {
    std::uint64_t z = counter * 0xd1b54a32d192ed03u + 0x632be59bd9b4e019u;
    for (int i = 0; i < 3; ++i) z = (z ^ (z >> 29)) * 0xf1357aea2e62a9c5u;
    return z ^ (z >> 32);
}

/// Which random number: an image of its own for each stream.
inline std::uint64_t counter(std::uint64_t stream, int x, int y, int c) {
    const std::uint64_t plane = stream * 64 + static_cast<std::uint64_t>(c);
    return (((plane << 20) + static_cast<std::uint64_t>(y)) << 20) + static_cast<std::uint64_t>(x);
}

/// In (0, 1).
inline double uniform(std::uint64_t n) { return (static_cast<double>(random_bits(n) >> 12) + 0.5) * 0x1p-52; }
inline double uniform(std::uint64_t stream, int x, int y, int c = 0) { return uniform(counter(stream, x, y, c)); }

/// Standard normal (Box, Muller 1958).
inline double normal_deviate(std::uint64_t stream, int x, int y, int c = 0) {
    const std::uint64_t n = counter(stream, x, y, c);
    return std::sqrt(-2 * std::log(uniform(2 * n))) * std::cos(6.283185307179586 * uniform(2 * n + 1));
}

/// An image filled with value(x, y, c).
template <class T = float, class F>
image<T> fill(extent size, int channels, const F& value) {
    image<T> result(size, channels);
    for (int c = 0; c < channels; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) result.at(x, y, c) = T(static_cast<float>(value(x, y, c)));
    return result;
}

/// A smooth image with an edge, different in every pixel and channel.
inline double structure(int x, int y, int c) {
    const double edge = 3 * x + 2 * y > 55 ? 0.7 : 0.1;
    return edge + 0.2 * std::sin(0.31 * x + 0.17 * y * (c + 1)) + 0.3 + 0.05 * c;
}

/// All the buffers that a filter of this library asks for.
struct buffers {
    image<> color, color_variance, half_a, half_b, half_a_variance, half_b_variance;
    image<> albedo, albedo_variance, normal, normal_variance, depth, depth_variance;

    extent size() const { return color.size(); }

    /// Calls f(name, image) for each.
    template <class Self, class F>
    static void each(Self& self, const F& f) {
        f("color", self.color), f("color.variance", self.color_variance);
        f("color.halfA", self.half_a), f("color.halfB", self.half_b);
        f("color.halfA.variance", self.half_a_variance), f("color.halfB.variance", self.half_b_variance);
        f("albedo", self.albedo), f("albedo.variance", self.albedo_variance);
        f("normal", self.normal), f("normal.variance", self.normal_variance);
        f("depth", self.depth), f("depth.variance", self.depth_variance);
    }

    named_layers layers() const { return layers({0, 0, size().width, size().height}); }
    /// Only the pixels of r.
    named_layers layers(rectangle r) const {
        named_layers all;
        each(*this, [&](const char* name, const image<>& i) { all.bind(name, source(i.view().crop(r))); });
        return all;
    }
};

/// Structure with Gaussian noise; the variance of the noise is known and differs from pixel to pixel.  The colour is
/// the mean of its halves.  Depth holds multiples of 1/256, so that its squared differences are exact.
inline buffers make_buffers(extent size, std::uint64_t seed = 1, double noise = 0.1) {
    const auto variance = [&](int x, int y, int c) {
        return noise * noise * (0.5 + uniform(100 * seed + 1, x, y, c));  // of the mean of both halves
    };
    const auto noisy = [&](std::uint64_t stream) {
        return fill(size, 3, [&, stream](int x, int y, int c) {
            return structure(x, y, c) + std::sqrt(2 * variance(x, y, c)) * normal_deviate(100 * seed + stream, x, y, c);
        });
    };
    const auto feature = [&](std::uint64_t stream, double scale, int channels) {
        return fill(size, channels, [&, stream](int x, int y, int c) {
            return scale * structure(x, y, c + 1) + 0.02 * normal_deviate(100 * seed + stream, x, y, c);
        });
    };
    const auto feature_variance = [&](std::uint64_t stream, int channels) {
        return fill(size, channels, [&, stream](int x, int y, int c) {
            return 0.0004 * (0.5 + uniform(100 * seed + stream, x, y, c));
        });
    };
    buffers b;
    b.half_a = noisy(2);
    b.half_b = noisy(3);
    b.color = fill(size, 3, [&](int x, int y, int c) { return (b.half_a.at(x, y, c) + b.half_b.at(x, y, c)) / 2; });
    b.color_variance = fill(size, 3, variance);
    b.half_a_variance = fill(size, 3, [&](int x, int y, int c) { return 2 * variance(x, y, c); });
    b.half_b_variance = fill(size, 3, [&](int x, int y, int c) { return 1.5 * variance(x, y, c); });
    b.albedo = feature(4, 0.5, 3);
    b.albedo_variance = feature_variance(5, 3);
    b.normal = feature(6, 0.8, 3);
    b.normal_variance = feature_variance(7, 3);
    b.depth = fill(size, 1, [&](int x, int y, int) { return std::floor(256 * uniform(100 * seed + 8, x, y)) / 256; });
    b.depth_variance = feature_variance(9, 1);
    return b;
}

/// Where a and b differ most, and how often; `relative` divides by the larger magnitude.  A NaN differs from
/// everything.
struct difference {
    double worst = 0;
    int x = -1, y = -1, c = -1;
    long long count = 0, values = 0;
    double mean = 0;
};

template <class Measure>
difference compare(const image_view<const float>& a, const image_view<const float>& b, const Measure& measure) {
    difference d;
    for (int c = 0; c < a.channels; ++c)
        for (int y = 0; y < a.size.height; ++y)
            for (int x = 0; x < a.size.width; ++x) {
                const double here = measure(a.at(x, y, c), b.at(x, y, c));
                ++d.values;
                d.count += here != 0;
                d.mean += here;
                if (!(here <= d.worst)) d.worst = here, d.x = x, d.y = y, d.c = c;
            }
    d.mean /= static_cast<double>(d.values);
    return d;
}

inline std::string describe(const difference& d, const image_view<const float>& a, const image_view<const float>& b) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "%lld of %lld values differ, mean %.3g, worst %.3g at (%d, %d) channel %d: %.9g, %.9g", d.count,
                  d.values, d.mean, d.worst, d.x, d.y, d.c, double{a.at(d.x, d.y, d.c)}, double{b.at(d.x, d.y, d.c)});
    return text;
}

/// Empty if every value of a is within `bound` of b, absolutely; else where it is not.
///     CHECK(beyond(1e-6, a, b) == "");
inline std::string beyond(double bound, const image_view<const float>& a, const image_view<const float>& b) {
    if (a.size != b.size || a.channels != b.channels) return "sizes differ";
    const difference d = compare(a, b, [](double x, double y) { return std::abs(x - y); });
    return d.worst <= bound ? "" : describe(d, a, b);
}

/// The same, relative to the larger of the two magnitudes.
inline std::string beyond_relative(double bound, const image_view<const float>& a, const image_view<const float>& b) {
    if (a.size != b.size || a.channels != b.channels) return "sizes differ";
    const difference d = compare(a, b, [](double x, double y) {
        const double larger = std::max(std::abs(x), std::abs(y));
        return larger == 0 ? 0 : std::abs(x - y) / larger;
    });
    return d.worst <= bound ? "" : describe(d, a, b);
}

/// Empty if a and b hold the same bits; else where they do not.
inline std::string other_bits(const image_view<const float>& a, const image_view<const float>& b) {
    if (a.size != b.size || a.channels != b.channels) return "sizes differ";
    const difference d = compare(a, b, [](float x, float y) {
        if (std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y)) return 0.0;
        return std::max(1e-300, std::abs(double{x} - double{y}));
    });
    return d.count == 0 ? "" : describe(d, a, b);
}

inline bool all_finite(const image_view<const float>& a) {
    for (int c = 0; c < a.channels; ++c)
        for (int y = 0; y < a.size.height; ++y)
            for (int x = 0; x < a.size.width; ++x)
                if (!is_finite(a.at(x, y, c))) return false;
    return true;
}

inline double largest_magnitude(const image_view<const float>& a) {
    double largest = 0;
    for (int c = 0; c < a.channels; ++c)
        for (int y = 0; y < a.size.height; ++y)
            for (int x = 0; x < a.size.width; ++x) largest = std::max(largest, std::abs(double{a.at(x, y, c)}));
    return largest;
}

}  // namespace winnow::test
