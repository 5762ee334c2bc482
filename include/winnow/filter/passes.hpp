// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a filter of several passes needs between them: images that live in the workspace, and simple work on all their
/// pixels, by the executor that runs the passes.
#include <cmath>
#include <winnow/filter/filter.hpp>
#include <winnow/filter/gaussian_blur.hpp>

namespace winnow {

/// Planar images of one size, one after another in memory of a workspace; valid until that is used for another filter.
class scratch_images {
public:
    scratch_images(scratch_memory& memory, extent size, int planes)
        : next_(reinterpret_cast<float*>(memory.reserve(bytes(size, planes)))), size_(size) {}

    static std::size_t bytes(extent size, int planes) {
        return sizeof(float) * static_cast<std::size_t>(size.pixels()) * planes;
    }
    image_view<float> take(int channels) {
        const image_view<float> taken = planar(next_, size_, channels);
        next_ += size_.pixels() * channels;
        return taken;
    }

private:
    float* next_;
    extent size_;
};

/// How filters of several passes run their passes: a frame in, images of the workspace out.
template <class Executor>
class pass_runner {
public:
    pass_runner(const Executor& executor, workspace& memory) : executor_(executor), memory_(memory) {}

    /// Filters `from` with the weights that the filter finds in the frame.
    template <class Filter, class Frame>
    void apply(const Filter& filter, const Frame& frame, const source& from, const image_view<float>& to) const {
        filter(frame, memory_.pass({}).layer(from, to), executor_, memory_);
    }

    /// A Gaussian blur; sigma in pixels.
    void blur(const source& from, const image_view<float>& to, float sigma) const {
        gaussian_blur(from, to, sigma, executor_, memory_.tiles);
    }

    /// f(i) for the index i of each pixel in a plane of the workspace.
    template <class F>
    void for_each_pixel(extent size, const F& f) const {
        for_each_row(executor_, size, [&](int y) {
            const std::ptrdiff_t first = std::ptrdiff_t{y} * size.width;
            for (std::ptrdiff_t i = first; i < first + size.width; ++i) f(i);
        });
    }
    /// Value i of an image of the workspace becomes f(i), in all its channels.
    template <class F>
    void for_each_value(const image_view<float>& to, const F& f) const {
        for_each_pixel({to.size.width, to.size.height * to.channels}, [&](std::ptrdiff_t i) { to.data[i] = f(i); });
    }

    /// The variance that filtered halves show: share (A - B)^2, blurred with a Gaussian of half a pixel.
    void residual_variance(const image_view<float>& half_a, const image_view<float>& half_b, float share,
                           const image_view<float>& between, const image_view<float>& to) const {
        for_each_value(between, [&](std::ptrdiff_t i) {
            const float difference = half_a.data[i] - half_b.data[i];
            return std::min(share * difference * difference, detail::largest_variance);
        });
        blur(between, to, 0.5f);
    }

    const Executor& executor() const { return executor_; }
    workspace& memory() const { return memory_; }

private:
    const Executor& executor_;
    workspace& memory_;
};

}  // namespace winnow
