// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Views over memory that somebody else owns: float or half, interleaved or planar, any stride.
#include <cstddef>
#include <type_traits>
#include <winnow/core/half.hpp>
#include <winnow/image/extent.hpp>

namespace winnow {

/// Distances in bytes from a channel, a pixel and a row to the next.
struct strides {
    std::ptrdiff_t channel = 0;
    std::ptrdiff_t pixel = 0;
    std::ptrdiff_t row = 0;

    bool operator==(const strides&) const = default;
};

/// A rectangle of pixels with `channels` values each, of type T: float or half, const where it is only read.
template <class T>
struct image_view {
    static_assert(std::is_same_v<std::remove_const_t<T>, float> || std::is_same_v<std::remove_const_t<T>, half>,
                  "winnow::image_view reads and writes float or half");
    using byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;

    T* data = nullptr;
    extent size;
    int channels = 1;
    strides step;

    image_view() = default;
    image_view(T* data, extent size, int channels, strides step)
        : data(data), size(size), channels(channels), step(step) {}

    /// A view that may write can be passed where one that only reads is asked for.
    template <class U>
    requires std::is_same_v<const U, T> image_view(const image_view<U>& v)
        : image_view(v.data, v.size, v.channels, v.step) {}

    T& at(int x, int y, int c = 0) const {
        return *reinterpret_cast<T*>(reinterpret_cast<byte*>(data) + x * step.pixel + y * step.row + c * step.channel);
    }

    /// The same memory, only channels first .. first + count - 1.
    image_view channel(int first, int count = 1) const { return {&at(0, 0, first), size, count, step}; }

    /// The same memory, only the pixels of r, which must lie inside.
    image_view crop(rectangle r) const { return {&at(r.x0, r.y0), r.size(), channels, step}; }
};

/// Channels side by side (RGBRGB...).  `pixel_bytes` is the size of one pixel where it holds more than these channels.
template <class T>
image_view<T> interleaved(T* data, extent size, int channels, std::ptrdiff_t pixel_bytes = 0,
                          std::ptrdiff_t row_bytes = 0) {
    const auto value = static_cast<std::ptrdiff_t>(sizeof(T));
    const std::ptrdiff_t pixel = pixel_bytes ? pixel_bytes : value * channels;
    return {data, size, channels, {value, pixel, row_bytes ? row_bytes : pixel * size.width}};
}

/// One plane after another (RRR...GGG...BBB...).
template <class T>
image_view<T> planar(T* data, extent size, int channels, std::ptrdiff_t row_bytes = 0, std::ptrdiff_t plane_bytes = 0) {
    const auto value = static_cast<std::ptrdiff_t>(sizeof(T));
    const std::ptrdiff_t row = row_bytes ? row_bytes : value * size.width;
    return {data, size, channels, {plane_bytes ? plane_bytes : row * size.height, value, row}};
}

}  // namespace winnow
