// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Structural similarity, as a display shows the images.
/// Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", 2004.
#include <array>
#include <vector>
#include <winnow/image/border.hpp>
#include <winnow/image/srgb.hpp>
#include <winnow/metric/compare.hpp>

namespace winnow::metric {

namespace detail {

/// Weighted means of two images over some pixels, and the variances and the covariance around these means.
struct moments {
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

/// Radius 5, sigma 1.5 pixels, sum 1.
inline std::array<double, 11> ssim_window() {
    std::array<double, 11> weights;
    double sum = 0;
    for (int i = -5; i <= 5; ++i) sum += weights[i + 5] = std::exp(-i * i / (2 * 1.5 * 1.5));
    for (double& w : weights) w /= sum;
    return weights;
}

/// The moments of a weighted union: squares are only ever taken of differences from the mean.
template <class At>
moments united(const std::array<double, 11>& weights, const At& at) {
    moments all;
    for (int i = 0; i < 11; ++i) {
        all.x += weights[i] * at(i - 5).x;
        all.y += weights[i] * at(i - 5).y;
    }
    for (int i = 0; i < 11; ++i) {
        const moments& part = at(i - 5);
        const double x = part.x - all.x, y = part.y - all.y;
        all.xx += weights[i] * (part.xx + x * x);
        all.yy += weights[i] * (part.yy + y * y);
        all.xy += weights[i] * (part.xy + x * y);
    }
    return all;
}

/// Eq. 13, with K1 = 0.01, K2 = 0.03 and a dynamic range of 1.
inline double ssim_of(const moments& m) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    return (2 * m.x * m.y + c1) * (2 * m.xy + c2) / ((m.x * m.x + m.y * m.y + c1) * (m.xx + m.yy + c2));
}

}  // namespace detail

/// The mean over pixels and channels of the local similarity under an 11x11 Gaussian window of sigma 1.5, in [-1, 1]; 1
/// for images that look the same.  Both images are cut to [0, 1] and go through the sRGB curve first.  Every pixel
/// counts: beyond the border stands the mirrored image (border::mirror).  NaN where a value is not finite.
inline double ssim(source x, source reference) {
    check_comparable(x, reference);
    const int width = x.size.width, height = x.size.height;
    const std::array<double, 11> window = detail::ssim_window();
    std::vector<detail::moments> pixels(static_cast<std::size_t>(x.size.pixels())), rows(pixels.size());
    const auto index = [width](int i, int j) { return static_cast<std::size_t>(j) * width + i; };
    double sum = 0;
    for (int c = 0; c < x.channels; ++c) {
        const source a = x.channel(c), b = reference.channel(c);
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i) {
                const float value = a.at(i, j), wanted = b.at(i, j);
                if (!is_finite(value) || !is_finite(wanted)) return std::numeric_limits<double>::quiet_NaN();
                pixels[index(i, j)] = {.x = srgb(value), .y = srgb(wanted)};
            }
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i)
                rows[index(i, j)] = detail::united(window, [&](int n) -> const detail::moments& {
                    return pixels[index(resolve(border::mirror, i + n, width), j)];
                });
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i)
                sum += detail::ssim_of(detail::united(window, [&](int n) -> const detail::moments& {
                    return rows[index(i, resolve(border::mirror, j + n, height))];
                }));
    }
    return sum / (static_cast<double>(x.size.pixels()) * x.channels);
}

}  // namespace winnow::metric
