// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What RDFC does before it filters: how noisy the colour is, and features without their noise.
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, Algorithm 1, lines 2 to 8.
#include <array>
#include <winnow/filter/clean_feature.hpp>
#include <winnow/paper/feature_prefilters.hpp>
#include <winnow/paper/rdfc_2013_candidate.hpp>

namespace winnow::paper {

/// From a noisy frame to one with the colour, its halves and its variance, and of each feature what is left after it
/// was filtered by itself, with the variance of that; in images of the workspace.
template <guide... Feature>
struct rdfc_cleaning {
    rdfc_numbers numbers;

    template <guide G>
    auto feature_filter(G) const {
        return nlm_of_feature{.radius = numbers.feature_radius}(G{});
    }
    /// Lines 2 to 8: the colour with its noise, and clean features.
    template <class Passes, class Frame>
    auto operator()(const Passes& passes, const Frame& in, scratch_images& images) const {
        const image_view<float> noise = images.take(3);
        noise_of(in, color, noise, numbers.half_share, passes.memory());
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
    /// Lines 5 to 8: a feature filtered by itself, and the variance that is left.  One without halves is exact.
    template <class Passes, class Frame, guide G>
    cleaned_feature prefilter(const Passes& passes, const Frame& in, G g, scratch_images& images) const {
        if (!has_halves(in, g)) {
            const image_view<float> residual = images.take(G::channels);
            passes.for_each_value(residual, [](std::ptrdiff_t) { return 0.0f; });
            return {in.find(g), residual, {}, {}};
        }
        scratch_images later = images;  // memory that the candidates will take
        later.take(2 * G::channels);
        return clean_feature(passes, in, g, feature_filter(g), numbers.half_share, numbers.feature_share,
                             feature_images::take(images, later, G::channels));
    }
};

}  // namespace winnow::paper
