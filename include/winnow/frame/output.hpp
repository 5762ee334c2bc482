// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Where the results go: the caller's memory.
#include <utility>
#include <vector>
#include <winnow/image/plane.hpp>

namespace winnow {

/// The filtered colour and whatever else is asked for, all as large as the frame.  Nothing else is computed.
///     output{rgb}.halves(a, b).error(e).layer(diffuse, denoised_diffuse)
class output {
public:
    output() = default;
    template <class T>
    output(const image_view<T>& mean) : mean_(mean) {}
    template <class Image>
    requires requires(Image& i) { target(i.view()); }
    output(Image& mean) : mean_(mean.view()) {}

    /// The half buffers of the colour, filtered with the weights of the whole.
    output& halves(target a, target b) {
        half_a_ = a;
        half_b_ = b;
        return *this;
    }
    /// The filter's own estimate of its squared error, channel by channel, in squared units of the colour.
    output& error(target e) {
        error_ = e;
        return *this;
    }
    /// dF / du, channel by channel: which share of its own noise a pixel keeps.
    output& derivative(target d) {
        derivative_ = d;
        return *this;
    }
    /// The sum of the weights of a pixel, one channel: as many neighbours, in effect, as its mean is taken over.
    output& support(target s) {
        support_ = s;
        return *this;
    }
    /// Any further layer, filtered with the same weights: layers that add up to the colour still do afterwards.
    output& layer(source from, target to) {
        layers_.emplace_back(from, to);
        return *this;
    }
    /// Starts anew with another mean; what the list of layers has allocated is kept.
    output& reset(const target& mean) {
        mean_ = mean;
        half_a_ = half_b_ = error_ = derivative_ = support_ = {};
        layers_.clear();
        return *this;
    }

    const target& mean() const { return mean_; }
    const target& half_a() const { return half_a_; }
    const target& half_b() const { return half_b_; }
    const target& error() const { return error_; }
    const target& derivative() const { return derivative_; }
    const target& support() const { return support_; }
    const std::vector<std::pair<source, target>>& layers() const { return layers_; }

private:
    target mean_, half_a_, half_b_, error_, derivative_, support_;
    std::vector<std::pair<source, target>> layers_;
};

}  // namespace winnow
