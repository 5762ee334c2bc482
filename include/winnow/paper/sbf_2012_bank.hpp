// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What SBF chooses from: banks of filters that differ in one bandwidth.
/// Li, Wu, Chuang, "SURE-based Optimization for Adaptive Sampling and Reconstruction", 2012, sections 4 and 5.
#include <array>
#include <winnow/distance/chessboard.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/distance/standardized.hpp>
#include <winnow/estimator/sure.hpp>
#include <winnow/filter/candidates.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/cutoff.hpp>
#include <winnow/weight/gaussian.hpp>
#include <winnow/weight/shared.hpp>

namespace winnow::paper {

/// How alike features have to be.  Each is divided by its noise, which is that of the mean times `spread`: as many as
/// there are samples in a pixel make it the noise of one sample, as the paper has it.
struct sbf_features {
    float spread = 64;
    float floor = 1e-2f;  ///< variance below which noise does not matter, in squared units of the feature
    float sigma_albedo = 0.25f;
    float sigma_normal = 0.8f;
    float sigma_other = 0.6f;  ///< of depth, and whatever else is named

    template <guide G>
    constexpr auto weight(G g) const {
        return gaussian(standardized(g, {.floor = floor, .spread = spread}), sigma(g));
    }
    template <guide... Feature>
    constexpr auto weight(planes<Feature...>) const {
        return (weight(Feature{}) * ...);
    }
    bool operator==(const sbf_features&) const = default;

private:
    constexpr float sigma(albedo_t) const { return sigma_albedo; }
    constexpr float sigma(normal_t) const { return sigma_normal; }
    template <guide G>
    constexpr float sigma(G) const {
        return sigma_other;
    }
};

/// The filters make(0), make(1), ... in one sweep.
template <std::size_t Count, class Make>
auto make_candidates(const Make& make) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) { return candidates{make(I).with(estimator::sure{})...}; }
    (std::make_index_sequence<Count>{});
}

/// The cross bilateral filter at several scales s: w = exp(-|p - q|^2 / (2 s^2)) times the weights of the features, as
/// far as 2 s along both axes.
/// With more than one setting of the features, each at every scale.
template <class Features, std::size_t Settings = 1>
struct cross_bilateral_bank {
    std::array<float, 3> scales{1, 2, 4};       ///< s, in pixels; the window is twice the largest
    std::array<sbf_features, Settings> like{};  ///< the first also guides the smoothing of errors
    float smoothing_scale = 4;                  ///< of the weights that smooth estimated errors, in pixels

    static constexpr std::size_t count = Settings * 3;

    auto candidate(std::size_t k) const {
        return cross_bilateral(scales[k % scales.size()], like[k / scales.size()], largest());
    }
    auto candidates() const {
        return make_candidates<count>([this](std::size_t k) { return candidate(k); });
    }
    auto smoothing() const { return cross_bilateral(smoothing_scale, like[0], smoothing_scale); }
    bool operator==(const cross_bilateral_bank&) const = default;

    void check() const {
        for (const float s : scales) check(s);
        check(smoothing_scale);
    }

private:
    float largest() const { return std::max({scales[0], scales[1], scales[2]}); }
    static auto cross_bilateral(float scale, const sbf_features& features, float of_window) {
        return filter{gaussian(spatial, scale) * cutoff(chessboard, 2 * scale) * shared(features.weight(Features{})),
                      window::square{.radius = static_cast<int>(2 * of_window)}};
    }
    static void check(float scale) {
        if (!(scale >= 0 && scale <= 1000))
            fail("sbf: a scale is " + std::to_string(scale) + ", it must be between 0 and 1000");
    }
};

/// The same where the noisy colour has a say, too: w times exp(-|u(p) - u(q)|^2 / (2 sigma^2)).  Its part in the
/// derivative is exact.
template <class Features>
struct cross_bilateral_bank_with_range {
    float sigma_color = 0.5f;  ///< in units of radiance
    cross_bilateral_bank<Features> spatial_bank{};

    static constexpr std::size_t count = cross_bilateral_bank<Features>::count;

    auto candidate(std::size_t k) const {
        const auto f = spatial_bank.candidate(k);
        return filter{f.weight * gaussian(l2(color), sigma_color), f.window};
    }
    auto candidates() const {
        return make_candidates<count>([this](std::size_t k) { return candidate(k); });
    }
    auto smoothing() const { return spatial_bank.smoothing(); }
    void check() const { spatial_bank.check(); }
    bool operator==(const cross_bilateral_bank_with_range&) const = default;
};

/// Cross non-local means at several sensitivities s: w = exp(-D / (2 s^2)) times the weights of the features, where D
/// is the squared difference of colours, mean over channels and a patch.  At s = 0 the pixel itself.
template <class Features>
struct cross_nlm_bank {
    std::array<float, 9> sensitivities{0, 0.005f, 0.01f, 0.02f, 0.04f, 0.08f, 0.16f, 0.32f, 0.64f};
    int radius = 10;       ///< of the window, in pixels
    int patch_radius = 2;  ///< in pixels
    sbf_features like{};
    float smoothing_scale = 4;  ///< of the weights that smooth estimated errors, in pixels

    static constexpr std::size_t count = 9;

    auto candidate(std::size_t k) const {
        const float of_sum = 1.7320508f * sensitivities[k];  // D is a third of the sum over channels
        return filter{gaussian(patch(l2(color), {patch_radius}), of_sum) * like.weight(Features{}),
                      window::square{.radius = radius}};
    }
    auto candidates() const {
        return make_candidates<count>([this](std::size_t k) { return candidate(k); });
    }
    auto smoothing() const {
        return cross_bilateral_bank<Features>{.like = {like}, .smoothing_scale = smoothing_scale}.smoothing();
    }
    void check() const { cross_bilateral_bank<Features>{.smoothing_scale = smoothing_scale}.check(); }
    bool operator==(const cross_nlm_bank&) const = default;
};

}  // namespace winnow::paper
