// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// All samples of all pixels, for filters that look at each: a fixed number in every pixel.
#include <cassert>
#include <vector>
#include <winnow/frame/pixel_memory.hpp>
#include <winnow/frame/sample.hpp>

namespace winnow {

/// The samples of a pixel lie side by side, each with its planes side by side.  Different pixels may be set by
/// different threads at once.
template <class Planes>
class samples {
public:
    using planes = Planes;

    /// All values are zero at first.
    samples(extent size, int per_pixel) : size_(size), per_pixel_(per_pixel) {
        samples_.resize(bytes(size, per_pixel) / sizeof(sample<Planes>));
    }
    /// The memory that they take: four bytes for each channel of each sample.
    static std::size_t bytes(extent size, int per_pixel) {
        return detail::pixel_memory("an image", size, per_pixel, sizeof(sample<Planes>));
    }

    extent size() const { return size_; }
    int per_pixel() const { return per_pixel_; }

    /// Keeps sample i of pixel (x, y); what it has beyond the planes of the list is not looked at.
    template <class P>
    requires gives_all<P, Planes>
    void set(int x, int y, int i, const sample<P>& s) { samples_[index_of(x, y, i)] = narrowed<Planes>(s); }
    const sample<Planes>& at(int x, int y, int i) const { return samples_[index_of(x, y, i)]; }

    /// Sample i of every pixel as an image of guide G, without a copy.
    template <guide G>
    requires contains<G, Planes> source view(G, int i)
    const {
        const auto one = static_cast<std::ptrdiff_t>(sizeof(sample<Planes>));
        const strides step{sizeof(float), one * per_pixel_, one * per_pixel_ * size_.width};
        return image_view<const float>(&at(0, 0, i).values[slot_of<G>(Planes{})], size_, G::channels, step);
    }

private:
    std::size_t index_of(int x, int y, int i) const {
        assert(x >= 0 && y >= 0 && i >= 0 && x < size_.width && y < size_.height && i < per_pixel_);
        return (static_cast<std::size_t>(y) * size_.width + x) * per_pixel_ + i;
    }

    extent size_;
    int per_pixel_;
    std::vector<sample<Planes>> samples_;
};

}  // namespace winnow
