// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a filter does to a constant colour under Gaussian noise of known variance.
#include <vector>
#include "support/papers.hpp"
#include "support/patterns.hpp"

namespace winnow::test {

/// A mean over images and its standard error.
struct estimate {
    double mean = 0, error = 0;

    explicit estimate(const std::vector<double>& of) {
        const double n = static_cast<double>(of.size());
        for (const double x : of) mean += x / n;
        for (const double x : of) error += (x - mean) * (x - mean) / (n * (n - 1));
        error = std::sqrt(error);
    }
    /// Within four standard errors of its own, and one in a hundred for what the oracle is good to.
    bool agrees_with(double oracle) const { return std::abs(mean - oracle) < 4 * error + 0.01 * oracle; }
};

struct noise_statistics {
    estimate off_centre_weight;  ///< mean of w(p,q), q != p
    estimate residual;           ///< variance of the result over that of the input
};

/// Over `images` images of 128x128 pixels; pixels whose window or patches meet the border are left out.
inline noise_statistics pure_noise(const any_filter& f, int radius, int images) {
    constexpr extent size{128, 128};
    constexpr double deviation = 0.1;
    constexpr int lattices = 16;
    std::vector<double> weights, residual;
    const int rim = f.halo, window = 2 * radius + 1;
    for (int n = 0; n < images; ++n) {
        double residuals = 0, sums_of_weights = 0;
        long long values = 0, centres = 0;
        buffers in = make_buffers({1, 1});
        const auto stream = static_cast<std::uint64_t>(1000 + 10 * n);
        const auto noise = [&](std::uint64_t s) {
            return fill(size, 3, [&](int x, int y, int c) {
                return 1 + deviation * std::sqrt(2.0) * normal_deviate(stream + s, x, y, c);
            });
        };
        in.half_a = noise(0), in.half_b = noise(1);
        in.color =
            fill(size, 3, [&](int x, int y, int c) { return (in.half_a.at(x, y, c) + in.half_b.at(x, y, c)) / 2; });
        const double variance = deviation * deviation;
        in.color_variance = fill(size, 3, [&](int, int, int) { return variance; });
        in.half_a_variance = in.half_b_variance = fill(size, 3, [&](int, int, int) { return 2 * variance; });
        for (image<>* i : {&in.albedo, &in.normal, &in.albedo_variance, &in.normal_variance}) *i = image<>(size, 3);
        for (image<>* i : {&in.depth, &in.depth_variance}) *i = image<>(size, 1);

        // One bright pixel a window becomes w(p,p) / C(p) = 1 / C(p) at p.
        const auto lit_at = [&](int lattice, int x, int y) {
            return (x + 5 * lattice) % window == 0 && (y + 11 * lattice) % window == 0;
        };
        std::vector<image<>> lit, share(lattices, image<>(size));
        image<> mean(size, 3);
        output out{mean};
        lit.reserve(lattices);
        for (int l = 0; l < lattices; ++l) {
            lit.push_back(fill(size, 1, [&](int x, int y, int) { return lit_at(l, x, y); }));
            out.layer(lit.back().view(), share[static_cast<std::size_t>(l)].view());
        }
        f(in.layers(), out, {executor_kind::simd});

        for (int y = rim; y < size.height - rim; ++y)
            for (int x = rim; x < size.width - rim; ++x) {
                for (int c = 0; c < 3; ++c, ++values) residuals += std::pow(double{mean.at(x, y, c)} - 1, 2) / variance;
                for (int l = 0; l < lattices; ++l)
                    if (lit_at(l, x, y))
                        ++centres, sums_of_weights += 1 / double{share[static_cast<std::size_t>(l)].at(x, y)};
            }
        residual.push_back(residuals / static_cast<double>(values));
        weights.push_back((sums_of_weights / static_cast<double>(centres) - 1) / (window * window - 1));
    }
    return {estimate(weights), estimate(residual)};
}

}  // namespace winnow::test
