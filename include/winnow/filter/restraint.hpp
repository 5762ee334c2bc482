// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a filter made of a buffer, drawn back toward the buffer itself as far as its halves say that this is better.
/// Stein, "Estimation of the Mean of a Multivariate Normal Distribution", 1981: the risk of a combination of the two is
/// quadratic in their shares.
#include <winnow/filter/passes.hpp>
#include <winnow/frame/cleaned.hpp>

namespace winnow {

/// With g a buffer of independent halves a and b, and F its filtered mean of halves F_a and F_b, the combination
/// g + s (F - g) has the least expected error at
///     s = (Var g - Cov(F, g)) / E |F - g|^2,
/// where (a - b)^2 / 4 is right on average for the variance, and (F_a - F_b)(a - b) / 4 for the covariance.  Both sums
/// are taken over the channels and a Gaussian of `sigma` pixels, and s is cut to [0, 1].  The filtered mean and halves
/// become the combinations.  Takes 4 planes of scratch.
template <class Executor>
void restrain(const pass_runner<Executor>& passes, const source& g, const source& a, const source& b,
              const image_view<float>& mean, const image_view<float>& half_a, const image_view<float>& half_b,
              float sigma, scratch_images scratch) {
    const extent size = mean.size;
    const image_view<float> gain_and_change = scratch.take(2), smooth = scratch.take(2);
    for_each_row(passes.executor(), size, [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            float gain = 0, change = 0;
            for (int c = 0; c < mean.channels; ++c) {
                const float moved = mean.at(x, y, c) - contained(g.channel(c), x, y);
                const float apart = contained(a.channel(c), x, y) - contained(b.channel(c), x, y);
                gain += apart * (apart - (half_a.at(x, y, c) - half_b.at(x, y, c))) / 4;
                change += moved * moved;
            }
            gain_and_change.at(x, y, 0) = gain;
            gain_and_change.at(x, y, 1) = change;
        }
    });
    passes.blur(gain_and_change, smooth, sigma);
    for_each_row(passes.executor(), size, [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            const float gain = smooth.at(x, y, 0), change = smooth.at(x, y, 1);
            const float share = gain >= change ? 1 : gain > 0 ? gain / change : 0;
            const auto draw_back = [&](const image_view<float>& filtered, const source& from) {
                for (int c = 0; c < filtered.channels; ++c) {
                    const float before = contained(from.channel(c), x, y);
                    float& after = filtered.at(x, y, c);
                    after = before + share * (after - before);
                }
            };
            draw_back(mean, g);
            draw_back(half_a, a);
            draw_back(half_b, b);
        }
    });
}

}  // namespace winnow
