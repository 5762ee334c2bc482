// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A feature filtered by itself, and the noise that is left in it.
#include <winnow/filter/passes.hpp>
#include <winnow/frame/cleaned.hpp>

namespace winnow {

/// The variance of the mean of G, at the magnitude that its halves show: from the samples' where the frame has it.
/// `share` is how much of (A - B)^2 that is, see share_of_halves.
template <class Frame, guide G>
void noise_of(const Frame& in, G g, const image_view<float>& to, float share, workspace& memory) {
    const source a = in.find(first_half(g)), b = in.find(second_half(g)), samples = in.find(variance(g));
    if (samples) scale_variance_to_halves(samples, a, b, to, 10, share, memory.noise);
    else variance_from_halves(a, b, to, 1, share, memory.noise);
}

/// Whether the frame has both halves of G.
template <class Frame, guide G>
bool has_halves(const Frame& in, G g) {
    return in.find(first_half(g)) && in.find(second_half(g));
}

/// What it takes to clean a feature with halves: its mean, and images for what becomes of it.  `noise` is used between.
struct feature_images {
    image_view<float> mean, variance, half_a, half_b, noise;

    static feature_images take(scratch_images& kept, scratch_images& between, int channels) {
        const auto mean = kept.take(channels), variance = kept.take(channels);
        const auto half_a = between.take(channels), half_b = between.take(channels), noise = between.take(channels);
        return {mean, variance, half_a, half_b, noise};
    }
};

/// Filters G with weights that the filter finds in G and its variance, halves along with it; the variance that is left
/// is `share` of their squared difference.
template <class Executor, class Frame, guide G, class Filter>
cleaned_feature clean_feature(const pass_runner<Executor>& passes, const Frame& in, G g, const Filter& filter,
                              float share_before, float share, const feature_images& to) {
    noise_of(in, g, to.noise, share_before, passes.memory());
    const frame guides{g = in.find(g), variance(g) = to.noise, first_half(g) = in.find(first_half(g)),
                       second_half(g) = in.find(second_half(g))};
    filter(filtering(g, guides), passes.memory().pass(to.mean).halves(to.half_a, to.half_b), passes.executor(),
           passes.memory());
    passes.residual_variance(to.half_a, to.half_b, share, to.noise, to.variance);
    return {to.mean, to.variance, to.half_a, to.half_b};
}

}  // namespace winnow
