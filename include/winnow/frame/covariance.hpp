// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How a vector varies between independent renders of one frame, for renderers that tell only its mean.
#include <array>
#include <span>
#include <winnow/core/symmetric.hpp>
#include <winnow/frame/variance.hpp>

namespace winnow {

/// The covariance of renders of three channels about their mean, divided by their number: the upper triangle row by
/// row.  Where each render has one sample in a pixel this is the spread of its samples; of renders with s samples,
/// 1/s of it.  In two passes, in double.  A pixel of a render that is no number counts as not rendered; one that no
/// render has gets NaN, one that a single render has, zeros.
inline void covariance_of_renders(std::span<const source> renders, const target& to) {
    if (renders.empty()) fail("there are no renders to take the covariance of");
    for (const source& r : renders) detail::check_same("a render", r, renders[0]);
    if (renders[0].channels != 3 || to.channels != 6 || to.size != renders[0].size)
        fail("the covariance of renders of " + to_string(renders[0].size) + " with " +
             std::to_string(renders[0].channels) + " channels is asked for as " + to_string(to.size) + " with " +
             std::to_string(to.channels) + "; it needs 3 and 6");
    using vector = std::array<double, 3>;
    for (int y = 0; y < to.size.height; ++y)
        for (int x = 0; x < to.size.width; ++x) {
            int n = 0;
            const auto for_each = [&](const auto& f) {
                for (const source& r : renders) {
                    const vector v{r.channel(0).at(x, y), r.channel(1).at(x, y), r.channel(2).at(x, y)};
                    if (is_finite(r.channel(0).at(x, y)) && is_finite(r.channel(1).at(x, y)) &&
                        is_finite(r.channel(2).at(x, y)))
                        f(v);
                }
            };
            vector mean{};
            for_each([&](const vector& v) {
                for (int i = 0; i < 3; ++i) mean[i] += v[i];
                ++n;
            });
            for (double& m : mean) m /= std::max(n, 1);
            std::array<double, 6> sum{};
            for_each([&](const vector& v) {
                for (int i = 0; i < 3; ++i)
                    for (int j = i; j < 3; ++j) sum[upper_triangle<3>(i, j)] += (v[i] - mean[i]) * (v[j] - mean[j]);
            });
            for (int k = 0; k < 6; ++k) to.channel(k).set(x, y, n ? static_cast<float>(sum[k] / n) : detail::unknown);
        }
}

}  // namespace winnow
