// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Pre-filters that clean each feature by itself, knowing nothing of where its samples lie: by non-local means, as
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, and by the bilateral
/// filter.
#include <array>
#include <winnow/distance/noise_normalized.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/filter/clean_feature.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/exponential.hpp>
#include <winnow/weight/gaussian.hpp>

namespace winnow::paper {

/// Non-local means of a feature in units of its noise.
struct nlm_of_feature {
    int radius = 5;        ///< of the window, in pixels
    int patch_radius = 3;  ///< in pixels
    float k = 1;           ///< sensitivity: larger filters more

    template <guide G>
    constexpr auto operator()(G) const {
        return filter{exponential(patch(noise_normalized(G{}, {.k = k}), {.radius = patch_radius})),
                      window::square{.radius = radius}};
    }
    bool operator==(const nlm_of_feature&) const = default;
};

/// The bilateral filter of a feature in unit range.
struct bilateral_of_feature {
    int radius = 3;              ///< of the window, in pixels
    float sigma_spatial = 1.5f;  ///< in pixels
    float sigma_feature = 0.1f;  ///< in the unit of the feature

    template <guide G>
    constexpr auto operator()(G) const {
        return filter{gaussian(spatial, sigma_spatial) * gaussian(l2(G{}), sigma_feature),
                      window::square{.radius = radius}};
    }
    bool operator==(const bilateral_of_feature&) const = default;
};

/// Cleans each feature by the filter that `make` gives for it.  A feature without halves is taken for exact.
template <class Features, class Make>
struct prefilter_by_itself;

template <guide... Feature, class Make>
struct prefilter_by_itself<planes<Feature...>, Make> {
    using features = planes<Feature...>;
    using reads = features;
    using optional = planes<variance_of<Feature>..., half_a<Feature>..., half_b<Feature>...>;

    Make make{};

    /// The cleaned features, in images of memory.clean.
    template <frame_with<reads> Frame, executor_policy Executor>
    std::array<cleaned_feature, sizeof...(Feature)> operator()(const Frame& in, const Executor& executor,
                                                               workspace& memory) const {
        const extent size = check(in);
        scratch_images kept(memory.clean, size, 4 * features::count), between(memory.images, size, largest_feature);
        const pass_runner passes(executor, memory);
        const auto clean = [&](auto g) {
            const feature_images images{kept.take(g.channels), kept.take(g.channels), kept.take(g.channels),
                                        kept.take(g.channels), scratch_images(between).take(g.channels)};
            if (has_halves(in, g))
                return clean_feature(passes, in, g, make(g), share_of_halves(), share_of_halves(), images);
            return cleaned_feature{in.find(g), {}, {}, {}};
        };
        return {clean(Feature{})...};
    }
    bool operator==(const prefilter_by_itself&) const = default;

    /// How far from a pixel its result can depend on the input, in pixels.
    friend int halo(const prefilter_by_itself& f) { return 11 + std::max({halo(f.make(Feature{}))...}) + 3; }

private:
    static constexpr int largest_feature = std::max({Feature::channels...});

    template <class Frame>
    static extent check(const Frame& in) {
        const extent size = detail::find_or_fail(in, std::get<0>(std::tuple<Feature...>{})).size;
        const auto check_one = [&](auto g, const source& layer) {
            if (layer) detail::check_layer(g, layer, g.channels, size, std::get<0>(std::tuple<Feature...>{}));
        };
        const auto check_feature = [&](auto g) {
            check_one(g, detail::find_or_fail(in, g));
            check_one(variance(g), in.find(variance(g)));
            check_one(first_half(g), in.find(first_half(g)));
            check_one(second_half(g), in.find(second_half(g)));
        };
        (check_feature(Feature{}), ...);
        return size;
    }
};

template <class Features>
using nlm_prefilter_of = prefilter_by_itself<Features, nlm_of_feature>;
template <class Features>
using bilateral_prefilter_of = prefilter_by_itself<Features, bilateral_of_feature>;

/// What a run over an image of this size will take.
template <guide... Feature, class Make, executor_policy Executor>
run_plan plan(const prefilter_by_itself<planes<Feature...>, Make>& f, extent size, const Executor& executor) {
    run_plan p;
    for (const run_plan& one : {plan(f.make(Feature{}), size, executor, 3 * Feature::channels)...})
        if (one.scratch_bytes > p.scratch_bytes) p = one;
    p.image_bytes = scratch_images::bytes(size, 4 * planes<Feature...>::count + std::max({Feature::channels...}));
    p.passes = 2 * sizeof...(Feature);
    p.halo = halo(f);
    return p;
}

}  // namespace winnow::paper
