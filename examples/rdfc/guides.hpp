// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A render as RDFC reads it.
#include <string>
#include <vector>
#include <winnow/frame/frame.hpp>
#include <winnow/frame/path_guides.hpp>
#include <winnow/image/image.hpp>

namespace simulator {
struct result;
}

namespace rdfc {

/// What the filter may be told beside the colour.
using features =
    winnow::planes<winnow::albedo_t, winnow::normal_t, winnow::depth_t, winnow::visibility_t, winnow::caustic_t>;

/// The names of the features; "brdf" may stand for "albedo": the average of what was sampled of the BRDF, for surfaces
/// that have no texture.
std::vector<std::string> feature_names();

/// What of a render is used, and how.
struct reading {
    std::vector<std::string> features = feature_names();
    bool keep_outliers =
        false;  ///< false: single bright samples are taken out first, and put back as far as they are light
};

/// The colour and the features in unit range, each with its halves and its variance.  A feature that the scene does not
/// give, or that is not asked for, is flat: it tells no two pixels apart.
class guides {
public:
    explicit guides(const simulator::result& render, const reading& how = {});
    guides(const guides&) = delete;

    const winnow::named_layers& layers() const { return layers_; }
    winnow::extent size() const { return size_; }
    /// One variance for all pictures would be in units of radiance: it goes with the square of the mean.
    float epsilon(float relative) const { return static_cast<float>(relative * mean_ * mean_ + 1e-30); }

private:
    void bind_color(const simulator::result& render, bool keep_outliers);
    void bind(const std::string& name, winnow::image<float> values);
    template <class G>
    void bind_feature(const simulator::result& render, const std::string& from);

    winnow::extent size_;
    double mean_ = 0;  ///< of the colour
    winnow::named_layers layers_;
    std::vector<winnow::image<float>> images_;
};

}  // namespace rdfc
