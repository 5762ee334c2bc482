// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Errors that a still image does not show: how much a sequence of frames flickers.
#include <span>
#include <winnow/metric/compare.hpp>

namespace winnow::metric {

namespace detail {

/// Throws invalid_input unless there are two frames at least, all of one size and number of channels.
inline void check_sequence(const char* what, std::span<const source> frames) {
    if (frames.size() < 2) fail(std::to_string(frames.size()) + " " + what + "s: flicker is a matter of two at least");
    for (std::size_t t = 0; t < frames.size(); ++t)
        if (frames[t].size != frames[0].size || frames[t].channels != frames[0].channels)
            fail(std::string(what) + " " + std::to_string(t) + " is " + to_string(frames[t].size) + " with " +
                 std::to_string(frames[t].channels) + " channels, the first is " + to_string(frames[0].size) +
                 " with " + std::to_string(frames[0].channels));
}

}  // namespace detail

/// For filtered animations: how much the error e = x - y against a reference y changes from one frame to the next.  The
/// mean over pairs of frames, pixels and channels of
///     (e_t - e_{t-1})^2 / ((y_t^2 + y_{t-1}^2) / 2 + epsilon),
/// no unit.  What moves in the references is no flicker, and an error that stays is none; played backwards, a sequence
/// flickers as much.  Noise of the references counts.  NaN where a value is not finite.
inline double flicker(std::span<const source> frames, std::span<const source> references, double epsilon = 0.01) {
    if (!(epsilon > 0)) fail("flicker: epsilon is " + std::to_string(epsilon) + ", it must be above 0");
    if (frames.size() != references.size())
        fail("there are " + std::to_string(frames.size()) + " frames and " + std::to_string(references.size()) +
             " references");
    detail::check_sequence("frame", frames);
    detail::check_sequence("reference", references);
    const auto change = [epsilon](double x, double y, double x_before, double y_before) {
        const double error = (x - y) - (x_before - y_before);
        return error * error / ((y * y + y_before * y_before) / 2 + epsilon);
    };
    double sum = 0;
    for (std::size_t t = 1; t < frames.size(); ++t)
        sum += mean_over_values(change, frames[t], references[t], frames[t - 1], references[t - 1]);
    return sum / static_cast<double>(frames.size() - 1);
}

/// For scenes in which nothing moves, and which have no references: the mean over pairs of frames and pixels of
/// |Y_t - Y_{t-1}|, where Y is the luminance of linear RGB (Rec. 709), or the value itself of one channel; in the unit
/// of the frames.  NaN where a value is not finite.
/// Zhuang, Shen, Wang, Liu, "Real-time Denoising Using BRDF Pre-integration Factorization", 2021, Fig. 7.
inline double luminance_flicker(std::span<const source> frames) {
    detail::check_sequence("frame", frames);
    const source& first = frames[0];
    if (first.channels != 1 && first.channels != 3)
        fail("luminance is that of 1 or 3 channels, not of " + std::to_string(first.channels));
    check_comparable(first, first);
    const auto luminance = [](const source& s, int x, int y) {
        const auto at = [&](int c) {
            const float value = s.channel(c).at(x, y);
            return is_finite(value) ? double{value} : std::numeric_limits<double>::quiet_NaN();
        };
        return s.channels == 1 ? at(0) : 0.2126 * at(0) + 0.7152 * at(1) + 0.0722 * at(2);
    };
    double sum = 0;
    for (std::size_t t = 1; t < frames.size(); ++t)
        for (int y = 0; y < first.size.height; ++y)
            for (int x = 0; x < first.size.width; ++x)
                sum += std::abs(luminance(frames[t], x, y) - luminance(frames[t - 1], x, y));
    return sum / (static_cast<double>(frames.size() - 1) * static_cast<double>(first.size.pixels()));
}

}  // namespace winnow::metric
