// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What RDFC does before it filters: how noisy the colour is, and features without their noise.
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, Algorithm 1, lines 2 to 8.
#include <array>
#include <winnow/filter/passes.hpp>
#include <winnow/paper/rdfc_2013_candidate.hpp>

namespace winnow::paper {

/// From a noisy frame to one with the colour, its halves and its variance, and of each feature what is left after it
/// was filtered by itself, with the variance of that; in images of the workspace.
template <guide... Feature>
struct rdfc_cleaning {
    rdfc_numbers numbers;

    template <guide G>
    auto feature_filter(G) const {
        return filter{exponential(patch(noise_normalized(G{}, {.k = 1}), {.radius = 3})),
                      window::square{.radius = numbers.feature_radius}};
    }
    /// Lines 2 to 8: the colour with its noise, and clean features.
    template <class Passes, class Frame>
    auto operator()(const Passes& passes, const Frame& in, scratch_images& images) const {
        const image_view<float> noise = images.take(3);
        noise_of(in, color, noise, passes.memory());
        const std::array cleaned{prefilter(passes, in, Feature{}, images)...};
        return [&]<std::size_t... I>(std::index_sequence<I...>) {
            return frame{color = in.find(color),
                         variance(color) = noise,
                         first_half(color) = in.find(first_half(color)),
                         second_half(color) = in.find(second_half(color)),
                         (Feature{} = cleaned[I].mean)...,
                         (variance(Feature{}) = cleaned[I].variance)...};
        }
        (std::index_sequence_for<Feature...>{});
    }

    /// Checks numbers and frame; gives the size of the frame.
    template <class Frame>
    extent check(const Frame& in) const {
        numbers.check();
        const source main = detail::find_or_fail(in, color);
        if (main.size.width < 1 || main.size.height < 1)
            fail("color is " + to_string(main.size) + ": there is nothing to filter");
        const auto check_guide = [&](auto g) {
            const auto check_one = [&](auto one, const source& layer) {
                if (layer) detail::check_layer(one, layer, one.channels, main.size, color);
            };
            check_one(g, detail::find_or_fail(in, g));
            check_one(variance(g), in.find(variance(g)));
            check_one(first_half(g), in.find(first_half(g)));
            check_one(second_half(g), in.find(second_half(g)));
        };
        check_guide(color);
        (check_guide(Feature{}), ...);
        if (!in.find(first_half(color)) || !in.find(second_half(color)))
            fail("rdfc needs " + first_half(color).name() + " and " + second_half(color).name() +
                 "; render the frame twice with other seeds, or split its samples by parity");
        return main.size;
    }

private:
    struct cleaned_feature {
        source mean, variance;
    };

    /// Lines 2 and 4: the variance of the mean of G, at the magnitude that its halves show.
    template <class Frame, guide G>
    void noise_of(const Frame& in, G g, const image_view<float>& to, workspace& memory) const {
        const source a = in.find(first_half(g)), b = in.find(second_half(g)), samples = in.find(variance(g));
        if (samples) scale_variance_to_halves(samples, a, b, to, 10, numbers.half_share, memory.noise);
        else variance_from_halves(a, b, to, 1, numbers.half_share, memory.noise);
    }

    /// Lines 5 to 8: a feature filtered by itself, and the variance that is left.
    template <class Passes, class Frame, guide G>
    cleaned_feature prefilter(const Passes& passes, const Frame& in, G g, scratch_images& images) const {
        const source noisy = in.find(g), a = in.find(first_half(g)), b = in.find(second_half(g));
        const image_view<float> residual = images.take(G::channels);
        if (!a || !b) {
            passes.for_each_value(residual, [](std::ptrdiff_t) { return 0.0f; });
            return {noisy, residual};
        }
        const image_view<float> mean = images.take(G::channels);
        scratch_images later = images;  // memory that the candidates will take
        const auto noise = later.take(G::channels), half_a = later.take(G::channels), half_b = later.take(G::channels);
        noise_of(in, g, noise, passes.memory());
        const frame guides{g = noisy, variance(g) = noise, first_half(g) = a, second_half(g) = b};
        feature_filter(g)(filtering(g, guides), passes.memory().pass(mean).halves(half_a, half_b), passes.executor(),
                          passes.memory());
        passes.residual_variance(half_a, half_b, numbers.feature_share, noise, residual);
        return {mean, residual};
    }
};

}  // namespace winnow::paper
