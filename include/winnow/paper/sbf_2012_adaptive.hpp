// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Where SBF wants its next samples.
/// Li, Wu, Chuang, "SURE-based Optimization for Adaptive Sampling and Reconstruction", 2012, section 4.3.
#include <winnow/frame/guide.hpp>
#include <winnow/paper/sampling_density.hpp>

namespace winnow::paper {

/// The density that the paper samples by, up to a factor:
///     rho(p) = max(0, error(p) + Var(p)) / (F(p)^2 + epsilon) / (1 + n(p)),
/// where error is the estimate that the filter has chosen by, smoothed already, Var the variance of the noisy mean, n
/// the pixel's own count, and errors, variances and squares are means over the channels.  A density of 0 everywhere
/// says that no pixel needs samples more than another.
struct sbf_sampling_density {
    float epsilon = 1e-2f;  ///< in squared units of F

    /// Throws invalid_input where sizes or channels do not fit.
    image<float> operator()(const filter_outcome& of, const source& variance) const {
        if (variance.size != of.filtered.size || variance.channels != of.filtered.channels)
            fail("the variance is " + to_string(variance.size) + " with " + std::to_string(variance.channels) +
                 " channels, not " + to_string(of.filtered.size) + " with " + std::to_string(of.filtered.channels));
        return density_of(of, epsilon, [&](int x, int y, double error, double square) {
            double noise = 0;
            for (int c = 0; c < variance.channels; ++c) noise += variance.channel(c).at(x, y);
            return (error + noise / variance.channels) / square / (1 + double{of.samples.at(x, y)});
        });
    }
};

}  // namespace winnow::paper
