// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Pictures for people: radiance tone-mapped to 8 bits, and errors as colours.  The one door through which
/// stb_image_write enters.
#include <array>
#include <cmath>
#include <vector>
#include <winnow/core/error.hpp>
#include <winnow/image/plane.hpp>
#include <winnow/image/srgb.hpp>
#include <winnow/io/atomic_file.hpp>
#if !defined(STB_IMAGE_WRITE_IMPLEMENTATION)
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#endif
#if __has_include(<stb/stb_image_write.h>)
#include <stb/stb_image_write.h>
#else
#include <stb_image_write.h>
#endif

namespace winnow::io {

/// How radiance becomes a picture: v 2^exposure, cut to [0, 1], the sRGB curve, rounded to 8 bits.
struct tone_map {
    float exposure = 0;  ///< in stops

    unsigned char operator()(float radiance) const {
        return static_cast<unsigned char>(255 * srgb(radiance * std::exp2(exposure)) + 0.5);
    }
};

using rgb8 = std::array<unsigned char, 3>;

/// What a pixel that is no number looks like: nothing in a render is so pink.
inline constexpr rgb8 not_a_number{255, 0, 255};

/// From black at 0 over violet, red and orange to pale yellow at 1 and beyond; each step is brighter than the last.
inline rgb8 error_colour(float t) {
    static constexpr float stops[6][3] = {{0, 0, 0},     {48, 18, 96},   {140, 30, 110},
                                          {220, 70, 50}, {250, 160, 20}, {255, 250, 200}};
    if (!is_finite(t)) return not_a_number;
    const float at = 5 * std::fmin(std::fmax(t, 0.0f), 1.0f);
    const int i = at < 4 ? static_cast<int>(at) : 4;
    const float within = at - static_cast<float>(i);
    rgb8 mixed;
    for (int c = 0; c < 3; ++c)
        mixed[c] = static_cast<unsigned char>(stops[i][c] + within * (stops[i + 1][c] - stops[i][c]) + 0.5f);
    return mixed;
}

namespace detail {

/// pixel(x, y) is the colour there.
template <class Pixel>
void write_pixels(const std::filesystem::path& path, extent size, const Pixel& pixel) {
    if (size.width < 1 || size.height < 1) fail("cannot write " + path.string() + ": the image is " + to_string(size));
    std::vector<rgb8> pixels;
    pixels.reserve(size.pixels());
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) pixels.push_back(pixel(x, y));
    atomic_file file(path);
    std::vector<unsigned char> bytes;
    // C code must not be left by an exception: the file is written afterwards.
    const auto keep = [](void* to, void* from, int count) {
        const auto* first = static_cast<const unsigned char*>(from);
        static_cast<std::vector<unsigned char>*>(to)->insert(static_cast<std::vector<unsigned char>*>(to)->end(), first,
                                                             first + count);
    };
    if (!stbi_write_png_to_func(keep, &bytes, size.width, size.height, 3, pixels.data(), 3 * size.width))
        fail("cannot write " + path.string() + ": the picture could not be encoded");
    file.write(bytes.data(), bytes.size());
    file.commit();
}

}  // namespace detail

/// Writes one channel as grey, or the first three as red, green and blue.  The file appears whole or not at all.
inline void write_png(const std::filesystem::path& path, const source& radiance, tone_map tone = {}) {
    detail::write_pixels(path, radiance.size, [&](int x, int y) {
        rgb8 pixel;
        for (int c = 0; c < 3; ++c) {
            const float v = radiance.channel(radiance.channels < 3 ? 0 : c).at(x, y);
            if (!is_finite(v)) return not_a_number;
            pixel[c] = tone(v);
        }
        return pixel;
    });
}

/// Writes the mean of the channels of an error as colours; `largest` and beyond is the brightest.
inline void write_error_png(const std::filesystem::path& path, const source& error, float largest) {
    detail::write_pixels(path, error.size, [&](int x, int y) {
        float sum = 0;
        for (int c = 0; c < error.channels; ++c) sum += error.channel(c).at(x, y);
        return error_colour(sum / static_cast<float>(error.channels) / largest);
    });
}

}  // namespace winnow::io
