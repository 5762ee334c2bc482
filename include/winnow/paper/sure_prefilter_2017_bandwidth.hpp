// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How far along the distribution of its positions a pixel may be averaged.
/// Moon, Iglesias-Guitian, McDonagh, Mitchell, "Noise Reduction on G-Buffers for Monte Carlo Filtering", 2017, sections
/// 4.3 and 4.4.
#include <array>
#include <winnow/distance/mahalanobis.hpp>
#include <winnow/estimator/mahalanobis_sure.hpp>
#include <winnow/filter/candidates.hpp>
#include <winnow/filter/passes.hpp>
#include <winnow/frame/path_guides.hpp>
#include <winnow/weight/gaussian.hpp>

namespace winnow::paper {

/// What tells how much noise is left in a cleaned feature.
enum class noise_left {
    by_halves,     ///< each half of a feature along the positions of that half: a quarter of their squared difference
    by_whole,      ///< both halves of a feature along the positions of the whole, likewise; in a third of the time
    by_positions,  ///< as published: the whole feature along the positions of either half, and all of the squared
                   ///< difference; that misses what noise of the feature the weights leave
};

struct sure_prefilter_numbers {
    int radius = 3;             ///< of the window, in pixels
    float samples = 8;          ///< in a pixel, for the covariance of its mean; a frame's sample_count goes before it
    float smoothing = 1.5f;     ///< of covariances and bandwidths: sigma in pixels
    float guide_smoothing = 0;  ///< of the positions that guide the features: sigma in pixels
    float half_smoothing = 1;   ///< of those that guide each half
    float ridge = 1e-4f;        ///< see regularized_precision
    noise_left noise = noise_left::by_halves;
    /// Not in the paper.  Positions may be averaged where what they carry may not: with many samples the results are
    /// further from the truth than the features were.  Above 0, `restrain` draws them back, with this sigma in pixels.
    float restraint = 0;

    bool operator==(const sure_prefilter_numbers&) const = default;
    void check() const {
        if (!(samples > 0)) fail("sure_prefilter: samples is " + std::to_string(samples) + ", it must be above 0");
        for (const float sigma : {smoothing, guide_smoothing, half_smoothing})
            if (!(sigma >= 0 && sigma <= 100))
                fail("sure_prefilter: a smoothing is " + std::to_string(sigma) + ", it must be between 0 and 100");
        if (!(ridge >= 1e-8f && ridge <= 1))
            fail("sure_prefilter: ridge is " + std::to_string(ridge) + ", it must be between 1e-8 and 1");
    }
};

/// Of a few bandwidths h the one with which the positions themselves are filtered best, smoothed over the image.
template <guide Position, estimator::noise Noise>
struct position_bandwidth {
    sure_prefilter_numbers numbers;

    /// In units of the spread of the samples; 0, the identity, is the sixth.
    static constexpr std::array bandwidths{0.4f, 0.8f, 1.2f, 1.6f, 2.0f};
    static constexpr int scratch_planes = 6 + bandwidths.size() + 1;

    /// Writes the inverse of the smoothed covariances, and the bandwidth of each pixel.
    template <class Passes, class Frame>
    void find(const Passes& passes, const Frame& in, const image_view<float>& precisions, const image_view<float>& map,
              scratch_images& images) const {
        const extent size = map.size;
        const image_view<float> spread = images.take(6), chosen = images.take(1);
        passes.blur(in.find(covariance(Position{})), spread, numbers.smoothing);
        const source position = in.find(Position{}), count = in.find(sample_count);
        const auto samples = [&](int x, int y) {
            return count ? std::max(1.0f, contained(count, x, y)) : numbers.samples;
        };
        for_each_row(passes.executor(), size, [&](int y) {
            // The positions of the row, where their precisions will be.
            for (int c = 0; c < 3; ++c) contained_row(position.channel(c), y, 0, size.width, &precisions.at(0, y, c));
            for (int x = 0; x < size.width; ++x) {
                const auto at = [&](int c) { return double{precisions.at(x, y, c)}; };
                const double from_origin = std::sqrt(at(0) * at(0) + at(1) * at(1) + at(2) * at(2));
                std::array<float, 6> covariance;
                for (int c = 0; c < 6; ++c) covariance[c] = spread.at(x, y, c);
                const auto inverse = regularized_precision(covariance, from_origin, numbers.ridge);
                const float share = 1 / samples(x, y);
                for (int c = 0; c < 6; ++c) {
                    precisions.at(x, y, c) = inverse[c];
                    spread.at(x, y, c) = share * covariance[c];
                }
            }
        });

        std::array<image_view<float>, bandwidths.size()> errors;
        for (std::size_t k = bandwidths.size(); k-- > 0;) {
            errors[k] = images.take(1);
            passes.memory().pass({}, k).error(errors[k]);
        }
        const frame guides{Position{} = position, precision(Position{}) = precisions,
                           mean_covariance(Position{}) = spread};
        all_candidates()(filtering(Position{}, guides),
                         std::span<const output, bandwidths.size()>(passes.memory().passes.data(), bandwidths.size()),
                         passes.executor(), passes.memory());

        const std::ptrdiff_t plane = size.pixels();
        passes.for_each_pixel(size, [&](std::ptrdiff_t i) {
            const float* const s = spread.data + i;
            float least = (s[0] + s[3 * plane] + s[5 * plane]) / 3, best = 0;  // of the identity
            for (std::size_t k = 0; k < bandwidths.size(); ++k)
                if (errors[k].data[i] < least) least = errors[k].data[i], best = bandwidths[k];
            chosen.data[i] = best;
        });
        passes.blur(chosen, map, numbers.smoothing);
    }

    template <class Frame>
    extent check(const Frame& in) const {
        numbers.check();
        const source position = detail::find_or_fail(in, Position{});
        if (position.size.width < 1 || position.size.height < 1)
            fail(Position::name() + " is " + to_string(position.size) + ": there is nothing to filter");
        const auto spread = covariance(Position{});
        detail::check_layer(spread, detail::find_or_fail(in, spread), 6, position.size, Position{});
        if (const source count = in.find(sample_count))
            detail::check_layer(sample_count, count, 1, position.size, Position{});
        return position.size;
    }

    friend int halo(const position_bandwidth& f) {
        const int blur = static_cast<int>(std::ceil(3 * f.numbers.smoothing)) + 1;
        return blur + halo(f.candidate(1)) + blur;
    }

    auto candidate(float h) const {
        return filter{gaussian(mahalanobis(Position{}), h), window::square{.radius = numbers.radius}}.with(
            estimator::mahalanobis_sure<Position, Noise>{});
    }
    auto all_candidates() const {
        return [this]<std::size_t... K>(std::index_sequence<K...>) { return candidates{candidate(bandwidths[K])...}; }
        (std::make_index_sequence<bandwidths.size()>{});
    }
};

}  // namespace winnow::paper
