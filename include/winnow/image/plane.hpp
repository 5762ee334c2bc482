// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// One channel of somebody's image with its type erased: what executors read from and write to.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <winnow/image/view.hpp>

namespace winnow {

enum class scalar { float32, float16 };

template <class T>
inline constexpr scalar scalar_of = std::is_same_v<std::remove_const_t<T>, half> ? scalar::float16 : scalar::float32;

/// True for a number that is neither NaN nor infinite, whatever the compiler is told to assume about such numbers.
inline bool is_finite(float value) { return (std::bit_cast<std::uint32_t>(value) & 0x7f800000u) != 0x7f800000u; }

/// All channels of an image; Byte is std::byte, const where the image is only read.
template <class Byte>
struct basic_layer {
    Byte* data = nullptr;
    scalar type = scalar::float32;
    extent size;
    int channels = 0;
    strides step;

    basic_layer() = default;
    template <class T>
    requires(std::is_const_v<Byte> || !std::is_const_v<T>) basic_layer(const image_view<T>& v)
        : data(reinterpret_cast<Byte*>(v.data)), type(scalar_of<T>), size(v.size), channels(v.channels), step(v.step) {}
    /// What may be written may be read.
    template <class Other>
    requires std::is_same_v<const Other, Byte> basic_layer(const basic_layer<Other>& v)
        : data(v.data), type(v.type), size(v.size), channels(v.channels), step(v.step) {}

    explicit operator bool() const { return data != nullptr; }
    bool operator==(const basic_layer&) const = default;

    /// Only channel c.
    basic_layer channel(int c) const {
        basic_layer one = *this;
        one.data += c * step.channel;
        one.channels = 1;
        return one;
    }

    float at(int x, int y) const {
        const std::byte* where = data + x * step.pixel + y * step.row;
        return type == scalar::float32 ? *reinterpret_cast<const float*>(where)
                                       : float(*reinterpret_cast<const half*>(where));
    }

    void set(int x, int y, float value) const requires(!std::is_const_v<Byte>) {
        std::byte* where = data + x * step.pixel + y * step.row;
        if (type == scalar::float32) *reinterpret_cast<float*>(where) = value;
        else *reinterpret_cast<half*>(where) = half(value);
    }
};

/// A layer to read.
using source = basic_layer<const std::byte>;
/// A layer to write.
using target = basic_layer<std::byte>;

/// The value at (x, y), or, where that is NaN or infinite, the mean of the finite values among its eight neighbours
/// (0 without any).  Bad pixels are contained here and nowhere else; `diagnose` counts them.
inline float contained(const source& plane, int x, int y) {
    const float value = plane.at(x, y);
    if (is_finite(value)) return value;
    double sum = 0;
    int count = 0;
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < plane.size.height; ++j)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < plane.size.width; ++i)
            if (const float near = plane.at(i, j); is_finite(near)) sum += near, ++count;
    return count ? static_cast<float>(sum / count) : 0.0f;
}

/// The same of the pixels x0 <= x < x1 of row y.
inline void contained_row(const source& plane, int y, int x0, int x1, float* to) {
    if (plane.type == scalar::float32 && plane.step.pixel == sizeof(float))
        std::memcpy(to, plane.data + y * plane.step.row + x0 * plane.step.pixel,
                    sizeof(float) * static_cast<std::size_t>(x1 - x0));
    else
        for (int x = x0; x < x1; ++x) to[x - x0] = plane.at(x, y);
    int bad = 0;  // no bool: compilers use lanes for a sum of numbers
    for (int x = x0; x < x1; ++x) bad += !is_finite(to[x - x0]);
    if (bad == 0) return;
    for (int x = x0; x < x1; ++x)
        if (!is_finite(to[x - x0])) to[x - x0] = contained(plane, x, y);
}

}  // namespace winnow
