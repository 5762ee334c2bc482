// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A Gaussian blur, along x and then along y.
#include <cmath>
#include <vector>
#include <winnow/filter/rows.hpp>

namespace winnow {

/// What filter{gaussian(spatial, sigma), window::square{ceil(3 sigma)}} gives, at a cost that grows with sigma, not
/// with its square.  sigma in pixels, 0 for a copy.  Beyond the image there is nothing; pixels that are no number are
/// replaced as everywhere.  The same bits whatever the executor.  `to` must not overlap `from`.
template <executor_policy Executor>
void gaussian_blur(const source& from, const image_view<float>& to, float sigma, const Executor& executor,
                   scratch_memory& memory) {
    const extent size = to.size;
    const int radius = static_cast<int>(std::ceil(3 * sigma)), rows = 2 * radius + 1;
    const std::ptrdiff_t width = size.width, padded = width + 2 * std::ptrdiff_t{radius};
    const auto tap = [sigma](int i) {
        const float x = static_cast<float>(i);
        return i == 0 ? 1.0f : std::exp(-x * x / (2 * sigma * sigma));
    };
    // The taps; what the taps inside the image add up to at each x; then, for each band of rows, a row with its
    // surroundings and the last rows blurred along x.
    const std::ptrdiff_t of_band = padded + rows * width;
    float* const taps = reinterpret_cast<float*>(
        memory.reserve(sizeof(float) * static_cast<std::size_t>(rows + width + bands(executor, size) * of_band)));
    float* const shares = taps + rows;
    for (int k = 0; k < rows; ++k) taps[k] = tap(k - radius);
    const auto share = [&](int at, int length) {
        float sum = 0;
        for (int k = std::max(-radius, -at); k <= std::min(radius, length - 1 - at); ++k) sum += taps[k + radius];
        return 1 / sum;
    };
    for (int x = 0; x < size.width; ++x) shares[x] = share(x, size.width);

    for_each_band(executor, size, [&](int band, int y0, int y1) {
        float* const row = shares + width + band * of_band;
        float* const ring = row + padded;
        const auto blurred = [&](int y) { return ring + y % rows * width; };
        for (int c = 0; c < to.channels; ++c) {
            const source plane = from.channel(c);
            const auto blur_along_x = [&](int y) {
                std::fill(row, row + padded, 0.0f);
                contained_row(plane, y, 0, size.width, row + radius);
                float* const result = blurred(y);
                std::fill(result, result + width, 0.0f);
                for (int k = 0; k < rows; ++k)
                    for (std::ptrdiff_t x = 0; x < width; ++x) result[x] += taps[k] * row[x + k];
                for (std::ptrdiff_t x = 0; x < width; ++x) result[x] *= shares[x];
            };
            int next = std::max(0, y0 - radius);
            for (int y = y0; y < y1; ++y) {
                const int first = std::max(0, y - radius), last = std::min(size.height - 1, y + radius);
                for (; next <= last; ++next) blur_along_x(next);
                float* const result = &to.at(0, y, c);
                std::fill(result, result + width, 0.0f);
                for (int j = first; j <= last; ++j) {
                    const float t = taps[j - y + radius];
                    const float* const from_row = blurred(j);
                    for (std::ptrdiff_t x = 0; x < width; ++x) result[x] += t * from_row[x];
                }
                const float of_column = share(y, size.height);
                for (std::ptrdiff_t x = 0; x < width; ++x) result[x] *= of_column;
            }
        }
    });
}

}  // namespace winnow
