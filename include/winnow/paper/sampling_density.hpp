// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a filter says about its pixels, and what densities of samples are made of it.
#include <winnow/core/error.hpp>
#include <winnow/image/image.hpp>
#include <winnow/image/plane.hpp>

namespace winnow::paper {

/// What a filter has said about each of its pixels p.
struct filter_outcome {
    source filtered;       ///< F, of any number of channels
    source squared_error;  ///< estimate of E (F - truth)^2, channel by channel; may be negative, as SURE is
    source weights;        ///< S(p) = sum_q w(p,q)
    source samples;        ///< n: the weighted mean of the counts, sum_q w(p,q) n_q / S(p); or the pixel's own count
};

/// max(0, density(x, y, error, square)) of each pixel, where error and square are means over the channels: of the
/// squared error, and of F^2 + epsilon.  Errors are averaged before negative ones are cut: they have no bias then.
/// Throws invalid_input where sizes or channels do not fit.
template <class Density>
image<float> density_of(const filter_outcome& of, float epsilon, const Density& density) {
    if (!(epsilon > 0)) fail("the density's epsilon is " + std::to_string(epsilon) + ", it must be above 0");
    const int channels = of.filtered.channels;
    const auto fits = [&](const char* what, const source& plane, int needed) {
        if (plane.size != of.filtered.size || plane.channels != needed)
            fail(std::string(what) + " is " + to_string(plane.size) + " with " + std::to_string(plane.channels) +
                 " channels, not " + to_string(of.filtered.size) + " with " + std::to_string(needed));
    };
    if (channels < 1) fail("the filtered image has no channels");
    fits("the squared error", of.squared_error, channels);
    fits("the sum of weights", of.weights, 1);
    fits("the number of samples", of.samples, 1);
    image<float> raw(of.filtered.size);
    for (int y = 0; y < raw.size().height; ++y)
        for (int x = 0; x < raw.size().width; ++x) {
            double error = 0, square = 0;
            for (int c = 0; c < channels; ++c) {
                const double f = of.filtered.channel(c).at(x, y);
                error += of.squared_error.channel(c).at(x, y);
                square += f * f;
            }
            const double rho = density(x, y, error / channels, square / channels + double{epsilon});
            raw.at(x, y) = static_cast<float>(rho < 0 ? 0 : rho);
        }
    return raw;
}

}  // namespace winnow::paper
