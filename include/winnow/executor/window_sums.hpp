// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Sums over all windows of one size, at a cost that grows with the logarithm of the size.  Nothing is ever subtracted:
/// a value of 1e8 leaves no trace where it is not in the window; and each sum is made in the same order wherever the
/// window lies, so its bits depend on neither tiles nor crops.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <winnow/executor/run.hpp>
#include <winnow/image/extent.hpp>

namespace winnow {

/// sums[i] = values[i] + values[i + next] + ... + values[i + (n - 1) next]  for 0 <= i < count, by doubling the length
/// of the window and, where n has an odd half, adding one value.  Lanes at a time: both may be read and `sums` written
/// up to Lanes::size - 1 beyond the last value that is needed.  Returns where the sums are: `sums`, or for n = 1
/// `values`.
template <class Lanes, class T>
const T* sum_windows(const T* values, T* sums, std::ptrdiff_t next, std::ptrdiff_t count, int n) {
    const T* shorter = values;
    int length = 1;
    const auto add = [&](const T* more, int longer) {
        const std::ptrdiff_t end = count + (n - longer) * next;
        more += length * next;
        for (std::ptrdiff_t i = 0; i < end; i += Lanes::size)
            (Lanes::load(shorter + i) + Lanes::load(more + i)).store(sums + i);
        shorter = sums;
        length = longer;
    };
    for (unsigned half = std::bit_floor(static_cast<unsigned>(n)) / 2; half > 0; half /= 2) {
        add(shorter, 2 * length);
        if (static_cast<unsigned>(n) & half) add(values, length + 1);
    }
    return shorter;
}

/// Sums over the square of a radius around each pixel of a region, from values on the region grown by that radius.
template <class Lanes>
class box_sums {
public:
    using real = typename Lanes::real;

    box_sums(extent region, int radius) : region_(region), radius_(radius), pitch_(pitch(region.width + 2 * radius)) {}

    /// Values, or pixels of memory, from a row to the next, for rows that are read or written lanes at a time.
    static std::ptrdiff_t pitch(int width) {
        return std::ptrdiff_t{detail::ceil_div(width, Lanes::size) + 2} * Lanes::size;
    }
    /// How much memory it needs.
    std::size_t reals() const { return static_cast<std::size_t>(pitch_ * (region_.height + 1) + 2 * column()); }

    /// values(x, y, to) puts Lanes::size values of row y, from column x on, into `to`; x and y count from the upper
    /// left of the grown region.  sums(y, row) gets the sums of row y of the region, and may read as many as fill
    /// lanes.
    template <class Values, class Sums>
    void operator()(real* memory, const Values& values, const Sums& sums) const {
        real* const columns = memory;  // summed along y
        real* const line = columns + pitch_ * region_.height;
        real* const of_column = line + pitch_;
        real* const summed = of_column + column();
        const int n = 2 * radius_ + 1, width = region_.width + 2 * radius_, height = region_.height + 2 * radius_;
        for (int x = 0; x < width; x += Lanes::size) {
            for (int y = 0; y < height; ++y) values(x, y, of_column + y * Lanes::size);
            const real* const found =
                sum_windows<Lanes>(of_column, summed, Lanes::size, std::ptrdiff_t{region_.height} * Lanes::size, n);
            for (int y = 0; y < region_.height; ++y)
                Lanes::load(found + y * Lanes::size).store(columns + y * pitch_ + x);
        }
        // What fills the last lanes is in no sum, but slow where it is denormal.
        std::fill(line, line + pitch_, real(0));
        const std::ptrdiff_t used = std::ptrdiff_t{detail::ceil_div(width, Lanes::size)} * Lanes::size;
        for (int y = 0; y < region_.height; ++y) {
            real* const row = columns + y * pitch_;
            std::fill(row + used, row + pitch_, real(0));
            sums(y, sum_windows<Lanes>(row, line, 1, region_.width, n));
        }
    }

private:
    std::ptrdiff_t column() const { return std::ptrdiff_t{region_.height + 2 * radius_} * Lanes::size; }

    extent region_;
    int radius_;
    std::ptrdiff_t pitch_;
};

}  // namespace winnow
