// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// From files to the buffers of a frame.
#include <map>
#include <optional>
#include <string>
#include <vector>
#include <winnow/frame/diagnose.hpp>
#include <winnow/frame/frame.hpp>
#include <winnow/frame/outliers.hpp>
#include <winnow/image/image.hpp>
#include <winnow/io/exr.hpp>

#include "filters.hpp"
#include "layers.hpp"
#include "options.hpp"
#include "prefilter.hpp"

namespace denoise {

/// A buffer and what is known about its noise.  Images that the input does not have are empty.
struct buffer {
    winnow::image<float> mean, half_a, half_b;
    winnow::image<float> variance;    ///< of the mean
    winnow::image<float> covariance;  ///< of the samples, of positions only
    bool has_halves() const { return half_a.channels() > 0; }
};

/// All that was read.
struct scene {
    winnow::io::exr_image carried;  ///< the first input, with the alpha channel of all
    file_layer color_layer;         ///< where the result goes
    std::map<std::string, buffer> guides;
    winnow::image<float> color_as_read;  ///< the mean with its outliers
    std::vector<std::pair<file_layer, buffer>> layers;
    int half_a_renders = 1, half_b_renders = 1;
    float samples = 1;                               ///< of a pixel, in the covariance of its positions
    std::vector<winnow::layer_diagnosis> read;       ///< every layer of every input that was looked at
    std::optional<winnow::outliers_found> outliers;  ///< that were taken out of the colour

    winnow::extent size() const { return carried.size(); }
    const buffer& color() const { return guides.at("color"); }
    /// How much of (A - B)^2 is the variance of the mean.
    float half_share() const { return winnow::share_of_halves(half_a_renders, half_b_renders); }
    /// The buffers as they were read, under the names of guides.
    winnow::named_layers frame() const;
};

/// Reads what the filter and the further layers need, and takes outliers out of the colour.  Fails with the names of
/// file and layer, and both sizes.
scene read_scene(const options& o, const filter_entry& filter, const prefilter_entry* prefilter);

/// The colour of a reference, which must cover what the scene covers.
winnow::image<float> read_reference(const std::string& path, const scene& s);

/// The square of the mean of a buffer, rounded to three bits: a single pixel does not change it.
double squared_mean(const winnow::image<float>& mean);

/// Brings features to unit range where the filter wants them so.  Adds the variances that are not given, unless the
/// filter works them out itself.
void prepare(scene& s, const filter_entry& filter);

}  // namespace denoise
