// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// An image that owns its memory.
#include <cstddef>
#include <vector>
#include <winnow/image/view.hpp>

namespace winnow {

/// Planar float (or half) pixels, zero at first.
template <class T = float>
class image {
public:
    image() = default;
    explicit image(extent size, int channels = 1)
        : size_(size), channels_(channels), values_(static_cast<std::size_t>(size.pixels()) * channels) {}

    extent size() const { return size_; }
    int channels() const { return channels_; }

    T& at(int x, int y, int c = 0) { return view().at(x, y, c); }
    const T& at(int x, int y, int c = 0) const { return view().at(x, y, c); }

    image_view<T> view() { return planar(values_.data(), size_, channels_); }
    image_view<const T> view() const { return planar(values_.data(), size_, channels_); }
    operator image_view<T>() { return view(); }
    operator image_view<const T>() const { return view(); }

private:
    extent size_;
    int channels_ = 0;
    std::vector<T> values_;
};

}  // namespace winnow
