// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The numbers of WLR, and its choice of the bandwidth: the least estimated squared error.
/// Moon, Carr, Yoon, "Adaptive Rendering based on Weighted Local Regression", 2014.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>
#include <winnow/core/error.hpp>

namespace winnow::paper {

/// Radiances are in units of `unit`, so that with it a brighter scene is filtered alike.
struct wlr_numbers {
    int radius = 9;                 ///< of the window, in pixels
    float unit = 1;                 ///< the radiance of a well-lit surface
    float least_component = 0.01f;  ///< a principal component below this share of its window is dropped
    float flatness = 0.16f;    ///< added to the curvature |u''| of the colour: feature bandwidths stay below its -1/2
    float outlier_sigmas = 3;  ///< a neighbour's grey value further off, in deviations of both, does not count
    float outlier_floor = 0.005f;   ///< nor is it dropped if it is no further off than this
    float largest_bandwidth = 1;    ///< of h
    float smoothing = 1;            ///< sigma of the blur over h, in pixels
    float ridge = 1e-4f;            ///< on slopes, of the linear fits
    float curvature_ridge = 1e-3f;  ///< on slopes and curvatures, of the quadratic fit

    void check() const {
        const auto need = [](bool good, const char* name, float value, const char* what) {
            if (!good) fail("wlr: " + std::string(name) + " is " + std::to_string(value) + ", it must be " + what);
        };
        if (radius < 0) fail("wlr: radius is " + std::to_string(radius) + ", it must be 0 or more");
        need(unit > 0, "unit", unit, "positive");
        need(least_component >= 0, "least_component", least_component, "0 or more");
        need(flatness > 0, "flatness", flatness, "positive");
        need(outlier_sigmas >= 0, "outlier_sigmas", outlier_sigmas, "0 or more");
        need(outlier_floor >= 0, "outlier_floor", outlier_floor, "0 or more");
        need(largest_bandwidth > 0.01f, "largest_bandwidth", largest_bandwidth, "above 0.01");
        need(smoothing >= 0, "smoothing", smoothing, "0 or more");
        need(ridge > 0, "ridge", ridge, "positive");
        need(curvature_ridge > 0, "curvature_ridge", curvature_ridge, "positive");
    }
    bool operator==(const wlr_numbers&) const = default;
};

inline constexpr int wlr_trials = 5;
/// The bandwidths at which a pixel is tried, as shares of the largest.
inline constexpr std::array<float, wlr_trials> wlr_shares{0.2f, 0.4f, 0.6f, 0.8f, 1.0f};
inline constexpr float wlr_least_bandwidth = 0.01f;

/// What a pixel's fits at the trial bandwidths gave.
struct wlr_trial_results {
    std::array<std::array<float, 3>, wlr_trials> filtered;  ///< colour
    std::array<float, wlr_trials> variance;                 ///< of it, summed over the channels
    std::array<float, 3> bias_variance;                     ///< of b_1, channel by channel
};

/// The choice for one pixel.
struct wlr_choice {
    float bandwidth;
    std::array<float, 3> squared_bias;  ///< of each channel, over h^4: b_1^2 without its noise; may be negative
};

/// With d coordinates a local linear fit of bandwidth h has the variance a_0 + a_1 / h^d (a_1 with the number of
/// samples in it, for the variance is that of means) and the bias b_0 + b_1 h^2; both lines are fitted to the trials
/// by least squares.  (b_1 h^2)^2 + a_1 / h^d is least at  h = (d a_1 / (4 b_1^2))^(1 / (d + 4)).
///
/// Noise makes b_1^2 too large, by its variance, and h too small: that variance is known exactly, because b_1 is linear
/// in the colour, and is subtracted.  The paper does without; on real renders it is worth 5 to 25 % of the error.
class wlr_selection {
public:
    wlr_selection(float largest, int most_coordinates) : largest_(largest) {
        std::array<double, wlr_trials> x;
        const auto line = [&](const auto& of) {
            for (std::size_t t = 0; t < wlr_trials; ++t) x[t] = of(double{wlr_shares[t]} * largest);
            return slope(x);
        };
        bias_ = line([](double h) { return h * h; });
        for (int d = 0; d <= std::min(most_coordinates, most); ++d)
            variance_[static_cast<std::size_t>(d)] = line([d](double h) { return std::pow(h, -d); });
    }

    static float optimum(double a_1, double squared_b_1, int coordinates, float largest) {
        if (!(squared_b_1 > 0)) return largest;
        if (!(a_1 > 0)) return wlr_least_bandwidth;
        const double h = std::pow(coordinates * a_1 / (4 * squared_b_1), 1.0 / (coordinates + 4));
        return static_cast<float>(std::clamp(h, double{wlr_least_bandwidth}, double{largest}));
    }

    wlr_choice operator()(const wlr_trial_results& trials, int coordinates) const {
        wlr_choice choice{};
        double squared_b_1 = 0, a_1 = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            double b_1 = 0;
            for (std::size_t t = 0; t < wlr_trials; ++t) b_1 += bias_[t] * trials.filtered[t][c];
            choice.squared_bias[c] = static_cast<float>(b_1 * b_1 - trials.bias_variance[c]);
            squared_b_1 += b_1 * b_1 - trials.bias_variance[c];
        }
        for (std::size_t t = 0; t < wlr_trials; ++t)
            a_1 += variance_[static_cast<std::size_t>(coordinates)][t] * trials.variance[t];
        choice.bandwidth = optimum(a_1, squared_b_1, coordinates, largest_);
        return choice;
    }

    /// b_1 is the sum over trials of this share of each filtered value.
    float bias_share(int trial) const { return static_cast<float>(bias_[static_cast<std::size_t>(trial)]); }

private:
    static constexpr int most = 31;
    using projection = std::array<double, wlr_trials>;

    /// The slope of the line through (x[t], v[t]) is  sum_t slope(x)[t] v[t];  0 where all x are equal.
    static projection slope(const std::array<double, wlr_trials>& x) {
        double mean = 0, squares = 0;
        for (const double v : x) mean += v / wlr_trials;
        for (const double v : x) squares += (v - mean) * (v - mean);
        projection p{};
        for (std::size_t t = 0; t < wlr_trials; ++t) p[t] = squares > 0 ? (x[t] - mean) / squares : 0;
        return p;
    }

    float largest_;
    projection bias_;
    std::array<projection, most + 1> variance_{};
};

}  // namespace winnow::paper
