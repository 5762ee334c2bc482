// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A render whose features are cleaned in several ways before a filter sees them.
#include <array>
#include <denoise/inputs.hpp>
#include <simulate/entry.hpp>
#include <string>

namespace sure_prefilter {

/// How features are cleaned.
enum class cleaning {
    none,
    sure,        ///< with the estimate that knows the directions of noise
    paper,       ///< with the paper's estimate, which takes noise for isotropic
    one_spread,  ///< as `paper`, but with one isotropic covariance for all pixels: what the covariances are worth
    nlm,         ///< each by itself, by non-local means
    bilateral    ///< each by itself, by the bilateral filter
};
inline constexpr std::array cleaning_names{"none", "sure", "paper", "one_spread", "nlm", "bilateral"};

/// The buffers of a render, as the program denoise has those of a file.
denoise::scene scene_of(const simulator::result& render, int samples);

/// Albedo, normal and depth of the frame, cleaned, in place of those that are there; they live in the workspace.  Where
/// positions say how, `bandwidths` gets how far.
void clean(cleaning how, winnow::named_layers& frame, int samples, int threads, winnow::workspace& memory,
           const winnow::target& bandwidths = {});

/// A filter of denoise by its name, and the numbers that differ from its own.
struct chosen_filter {
    std::string name;
    std::vector<std::pair<std::string, std::string>> set;
};

/// A filter on cleaned features.
struct filtered {
    winnow::image<float> color;
    std::array<winnow::image<float>, 3> features;  ///< albedo, normal, depth, in unit range
    winnow::image<float> bandwidths;
    double clean_seconds = 0, filter_seconds = 0;
};
filtered filter(const denoise::scene& render, const chosen_filter& filter, cleaning how, int samples, int threads,
                winnow::workspace& memory);

/// Albedo, normal and depth of another render of the same frame in the unit range of this one.
std::array<winnow::image<float>, 3> features_in_range_of(const denoise::scene& of, const simulator::result& other);

}  // namespace sure_prefilter
