// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Where RDFC wants its next samples: adaptive sampling by the estimated error of the filter.
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013, "Adaptive Sampling", after
/// Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012.
#include <winnow/distance/noise_normalized.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/paper/sampling_density.hpp>
#include <winnow/weight/exponential.hpp>

namespace winnow::paper {

using rdfc_outcome = filter_outcome;

/// How many samples stand behind a filtered pixel already.
enum class samples_behind {
    filter,  ///< those of all neighbours, by their weights: S(p) n(p), where n is the weighted mean of the counts
    pixel    ///< the pixel's own, where n is its count
};

/// The density that the paper samples by, up to a factor:
///     relMSE(p) = max(0, mean over channels of the squared error) / (mean over channels of F_i(p)^2 + epsilon),
///     W(p) = S(p) / (1 + samples behind p), how much one sample more helps, and how many pixels,
///     rho = relMSE W, averaged with the weights of non-local means of the colour.
/// Errors are averaged over the channels before negative ones are cut: they have no bias then.  Without a unit; a
/// density of 0 everywhere says that no pixel needs samples more than another.  Where the outcome is no number, the
/// neighbours decide.
class rdfc_sampling_density {
public:
    using smoothing = filter<weight::exponential<distance::patch<distance::noise_normalized<color_t>>>>;
    using reads = smoothing::reads;

    smoothing smooth{exponential(patch(noise_normalized(color, {.k = 1}), {.radius = 1})),
                     window::square{.radius = 10}};
    float epsilon = 1e-2f;  ///< in squared units of F
    samples_behind behind = samples_behind::filter;

    /// Writes rho to a plane of one channel, which may not be one of the input.  Throws invalid_input before any work
    /// where sizes or channels do not fit.
    template <frame_to_filter<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const rdfc_outcome& of, const target& density,
                    const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, of, density, executor, memory);
    }
    /// The same with the caller's workspace.
    template <frame_to_filter<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const rdfc_outcome& of, const target& density, const Executor& executor,
                    workspace& memory) const {
        const image<float> raw = unsmoothed(of);
        smooth(in, output{}.layer(raw.view(), density), executor, memory);
    }

    /// relMSE W of each pixel, not averaged: as noisy as the estimate of the error.
    image<float> unsmoothed(const rdfc_outcome& of) const {
        return density_of(of, epsilon, [&](int x, int y, double error, double square) {
            const double support = of.weights.at(x, y), n = of.samples.at(x, y);
            const double samples = behind == samples_behind::filter ? support * n : n;
            return error / square * support / (1 + samples);
        });
    }
};

}  // namespace winnow::paper
