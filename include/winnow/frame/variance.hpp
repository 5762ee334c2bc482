// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The variance of the pixel mean, from what a renderer has to offer: two halves of its samples, or several renders.
#include <algorithm>
#include <span>
#include <string>
#include <vector>
#include <winnow/core/error.hpp>
#include <winnow/frame/unknown.hpp>
#include <winnow/image/image.hpp>
#include <winnow/image/plane.hpp>

namespace winnow {

namespace detail {

inline void check_same(const char* what, const source& layer, const source& as) {
    if (layer.size != as.size) fail(std::string(what) + " is " + to_string(layer.size) + ", not " + to_string(as.size));
    if (layer.channels != as.channels)
        fail(std::string(what) + " has " + std::to_string(layer.channels) + " channels, not " +
             std::to_string(as.channels));
}

/// The mean of the finite values of value(x, y) over the square around each pixel, as far as it lies in the image; NaN
/// where there is none.
template <class Value>
void box_mean(const Value& value, const target& to, int radius, std::vector<float>& memory) {
    const extent size = to.size;
    const std::ptrdiff_t width = size.width, padded = width + 2 * std::ptrdiff_t{radius};
    const int rows = std::min(2 * radius + 1, size.height);
    memory.resize(static_cast<std::size_t>(2 * padded + 2 * (rows + 1) * width));
    float* const valid = memory.data();   // a row of values, 0 where there is none, and
    float* const count = valid + padded;  // of how many: 1 or 0
    float* const ring = count + padded;   // the last rows, summed along x: values, then counts
    float* const sums = ring + 2 * rows * width;
    std::fill(valid, ring, 0.0f);
    const auto add_row = [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            const float v = value(x, y);
            valid[radius + x] = is_finite(v) ? v : 0.0f;
            count[radius + x] = is_finite(v) ? 1.0f : 0.0f;
        }
        for (int part = 0; part < 2; ++part) {
            const float* const from = part ? count : valid;
            float* const row = ring + (y % rows * 2 + part) * width;
            std::fill(row, row + width, 0.0f);
            for (int k = 0; k <= 2 * radius; ++k)
                for (std::ptrdiff_t x = 0; x < width; ++x) row[x] += from[x + k];
        }
    };
    for (int y = 0, next = 0; y < size.height; ++y) {
        const int first = std::max(0, y - radius), last = std::min(size.height - 1, y + radius);
        for (; next <= last; ++next) add_row(next);
        std::fill(sums, sums + 2 * width, 0.0f);
        for (int j = first; j <= last; ++j) {
            const float* const row = ring + j % rows * 2 * width;
            for (std::ptrdiff_t i = 0; i < 2 * width; ++i) sums[i] += row[i];
        }
        for (int x = 0; x < size.width; ++x) to.set(x, y, sums[width + x] > 0 ? sums[x] / sums[width + x] : unknown);
    }
}

/// What is larger is cut, so that sums stay finite.
inline constexpr float largest_variance = 1e30f;

}  // namespace detail

/// Memory that outlives a call, so that the next one allocates nothing.
struct variance_memory {
    std::vector<float> rows, halves, average;
};

/// How much of (A - B)^2 is the variance of the mean of two halves of n_a and n_b samples: 1/4 for equal halves.
constexpr float share_of_halves(int n_a = 1, int n_b = 1) {
    const float n = static_cast<float>(n_a + n_b);
    return static_cast<float>(n_a) / n * (static_cast<float>(n_b) / n);
}

/// The variance of the mean of two halves A and B: share (A - B)^2, averaged over the square of the given radius as far
/// as it lies in the image.  Raw, it has a relative deviation of sqrt 2 and is useless as a weight; 3x3 does best on
/// real renders.  The variance of one half alone is twice that.  Pixels where A or B is no number are left out of the
/// average; where none is left the variance is NaN: unknown.  `to` must not overlap A or B.
inline void variance_from_halves(const source& a, const source& b, const target& to, int radius, float share,
                                 variance_memory& memory) {
    detail::check_same("the second half", b, a);
    detail::check_same("the variance", source(to), a);
    for (int c = 0; c < a.channels; ++c) {
        const source x = a.channel(c), y = b.channel(c);
        const auto squared = [&](int i, int j) {
            const float difference = x.at(i, j) - y.at(i, j);
            if (!is_finite(difference)) return detail::unknown;
            return std::min(share * difference * difference, detail::largest_variance);
        };
        detail::box_mean(squared, to.channel(c), radius, memory.rows);
    }
}
inline void variance_from_halves(const source& a, const source& b, const target& to, int radius = 1,
                                 float share = share_of_halves()) {
    variance_memory memory;
    variance_from_halves(a, b, to, radius, share, memory);
}

/// A variance from few samples is itself noisy, and misses what a heavy tail has not shown yet: its average over the
/// square of the given radius.  Negative and non-finite values are left out, and filled where there are others near.
/// `to` must not overlap `variance`.
inline void smooth_variance(const source& variance, const target& to, int radius, variance_memory& memory) {
    detail::check_same("the smoothed variance", source(to), variance);
    for (int c = 0; c < to.channels; ++c) {
        const source from = variance.channel(c);
        const auto valid = [&](int x, int y) {
            const float v = from.at(x, y);
            return v >= 0 && is_finite(v) ? std::min(v, detail::largest_variance) : detail::unknown;
        };
        detail::box_mean(valid, to.channel(c), radius, memory.rows);
    }
}
inline void smooth_variance(const source& variance, const target& to, int radius = 1) {
    variance_memory memory;
    smooth_variance(variance, to, radius, memory);
}

/// The variance that the samples of each pixel show, at the magnitude that two halves show.  Samples that are
/// stratified over a pixel vary more than independent ones of the same mean would: their variance has the right shape
/// and is too large, while the halves are right and noisy.  Each value is scaled by the ratio of the averages of share
/// (A - B)^2 and of the variance over the square of the given radius. Rousselle, Manzi, Zwicker, "Robust Denoising
/// using Feature and Color Information", 2013, section 3. `to` may be `variance` itself, but must not overlap A or B.
inline void scale_variance_to_halves(const source& variance, const source& a, const source& b, const target& to,
                                     int radius, float share, variance_memory& memory) {
    detail::check_same("the variance", variance, a);
    memory.halves.resize(static_cast<std::size_t>(a.size.pixels()));
    memory.average.resize(memory.halves.size());
    const auto halves = planar(memory.halves.data(), a.size, 1), average = planar(memory.average.data(), a.size, 1);
    for (int c = 0; c < variance.channels; ++c) {
        const source from = variance.channel(c);
        variance_from_halves(a.channel(c), b.channel(c), halves, radius, share, memory);
        smooth_variance(from, average, radius, memory);
        for (int y = 0; y < a.size.height; ++y)
            for (int x = 0; x < a.size.width; ++x) {
                const float by = average.at(x, y) > 1e-20f ? halves.at(x, y) / average.at(x, y) : 1;
                to.channel(c).set(x, y, from.at(x, y) * (by < 1e-3f ? 1e-3f : by > 1e3f ? 1e3f : by));
            }
    }
}
inline void scale_variance_to_halves(const source& variance, const source& a, const source& b, const target& to,
                                     int radius = 10, float share = share_of_halves()) {
    variance_memory memory;
    scale_variance_to_halves(variance, a, b, to, radius, share, memory);
}

/// The mean of independent renders of one frame, and the variance of that mean: in two passes, because the difference
/// of two large squares would cancel.  A pixel of a render that is no number counts as not rendered.  The mean is NaN
/// where no render has the pixel, the variance where fewer than two have it.  Either target may be empty.
inline void mean_and_variance(std::span<const source> renders, const target& mean, const target& variance) {
    if (renders.empty()) fail("there are no renders to take the mean of");
    for (const source& r : renders) detail::check_same("a render", r, renders[0]);
    if (mean) detail::check_same("the mean", source(mean), renders[0]);
    if (variance) detail::check_same("the variance", source(variance), renders[0]);
    const extent size = renders[0].size;
    for (int c = 0; c < renders[0].channels; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                double sum = 0, squares = 0;
                int n = 0;
                const auto for_each = [&](const auto& f) {
                    for (const source& r : renders)
                        if (const float v = r.channel(c).at(x, y); is_finite(v)) f(double{v});
                };
                for_each([&](double v) { sum += v, ++n; });
                const double centre = n ? sum / n : 0;
                for_each([&](double v) { squares += (v - centre) * (v - centre); });
                if (mean) mean.channel(c).set(x, y, n ? static_cast<float>(centre) : detail::unknown);
                if (variance)
                    variance.channel(c).set(
                        x, y, n > 1 ? static_cast<float>(squares / (double(n) * (n - 1))) : detail::unknown);
            }
}

}  // namespace winnow
