// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Sums over all windows of one size, at a cost that grows with the logarithm of the size.  Nothing is ever subtracted:
/// a value of 1e8 leaves no trace where it is not in the window; and each sum is made in the same order wherever the
/// window lies, so its bits depend on neither tiles nor crops.
#include <algorithm>
#include <cstddef>
#include <winnow/core/math.hpp>
#include <winnow/executor/run.hpp>
#include <winnow/image/extent.hpp>

namespace winnow {

/// Where lanes are read or written, one batch after the other: at i = 0, step, 2 step, ...
template <class T>
struct batches {
    T* data;
    std::ptrdiff_t step;
};

namespace detail {

/// to[i] = Parts sums that follow one another at a distance of `length`, then Single values at a distance of `next`.
template <class Lanes, int Parts, int Single, class T>
void lengthen(batches<const T> sums, std::ptrdiff_t length, const T* values, std::ptrdiff_t next, batches<T> to,
              std::ptrdiff_t count) {
    const auto part = [&](std::ptrdiff_t i, int k) { return Lanes::load(sums.data + i + k * length); };
    for (std::ptrdiff_t i = 0; i < count; i += sums.step, to.data += to.step) {
        Lanes sum = part(i, 0) + part(i, 1);
        if constexpr (Parts == 3) sum = sum + part(i, 2);
        if constexpr (Parts == 4) sum = sum + (part(i, 2) + part(i, 3));
        math::for_each<Single>(
            [&](auto k) { sum = sum + Lanes::load(values + i + Parts * length + static_cast<int>(k) * next); });
        sum.store(to.data);
    }
}

}  // namespace detail

/// values[i] + values[i + next] + ... + values[i + (n - 1) next]  for each batch with i < count, by Horner's rule in
/// base 4: a window four times as long is four windows; what its last digit says is added one by one.  `work` is as
/// large as the values; these may be read up to Lanes::size - 1 beyond the last one that is needed.
template <class Lanes, class T>
void sum_windows(batches<const T> values, std::ptrdiff_t next, std::ptrdiff_t count, int n, T* work, batches<T> to) {
    batches<const T> sums = values;
    int length = 1;
    // The last step writes where it is asked to, all others to `work`, in place.
    const auto lengthened = [&]<int Parts, int Single>(math::index<Parts>, math::index<Single>) {
        const int longer = Parts * length + Single;
        detail::lengthen<Lanes, Parts, Single>(sums, length * next, values.data, next,
                                               longer == n ? to : batches<T>{work, values.step},
                                               count + (n - longer) * next);
        sums.data = work;
        length = longer;
    };
    using math::index;
    int shift = 0;  // the digits of n, two bits each
    while (n >> shift >= 4) shift += 2;
    if (n == 1)
        for (std::ptrdiff_t i = 0; i < count; i += values.step, to.data += to.step)
            Lanes::load(values.data + i).store(to.data);
    if (n >> shift == 2) lengthened(index<2>{}, index<0>{});
    if (n >> shift == 3) lengthened(index<3>{}, index<0>{});
    while ((shift -= 2) >= 0) {
        const int digit = n >> shift & 3;
        if (digit == 0) lengthened(index<4>{}, index<0>{});
        if (digit == 1) lengthened(index<4>{}, index<1>{});
        if (digit == 2) lengthened(index<4>{}, index<2>{});
        if (digit == 3) lengthened(index<4>{}, index<3>{});
    }
}

/// Sums over the square of a radius around each pixel of a region, from values on the region grown by that radius.
template <class Lanes>
class box_sums {
public:
    using real = typename Lanes::real;

    box_sums(extent region, int radius) : region_(region), radius_(radius), pitch_(pitch(region.width + 2 * radius)) {}

    /// From a row of so many values to the next, where lanes may begin at any of them.  An odd number of cache lines,
    /// so that a column spreads over the sets of the cache.
    static std::ptrdiff_t pitch(int width) {
        constexpr int line = static_cast<int>(scratch_memory::alignment / sizeof(real));
        return std::ptrdiff_t{detail::ceil_div(width + Lanes::size, line) | 1} * line;
    }
    /// How much memory it needs.
    std::size_t reals() const {
        return static_cast<std::size_t>(pitch_ * (region_.height + 1) + column() + std::max(column(), pitch_));
    }

    /// values(x, y, to) puts the lanes of row y, from column x on, into `to`; x and y count from the upper left of the
    /// grown region.  sums(y, row) gets the sums of row y of the region; it may read whole lanes.
    template <class Values, class Sums>
    void operator()(real* memory, const Values& values, const Sums& sums) const {
        real* const columns = memory;  // summed along y
        real* const line = columns + pitch_ * region_.height;
        real* const of_column = line + pitch_;
        real* const work = of_column + column();
        const int n = 2 * radius_ + 1, width = region_.width + 2 * radius_, height = region_.height + 2 * radius_;
        for (int x = 0; x < width; x += Lanes::size) {
            for (int y = 0; y < height; ++y) values(x, y, of_column + y * Lanes::size);
            sum_windows<Lanes>(batches<const real>{of_column, Lanes::size}, Lanes::size,
                               std::ptrdiff_t{region_.height} * Lanes::size, n, work,
                               batches<real>{columns + x, pitch_});
        }
        // What fills the last lanes is in no sum, but slow where it is denormal.
        const std::ptrdiff_t used = std::ptrdiff_t{detail::ceil_div(width, Lanes::size)} * Lanes::size;
        std::fill(line, line + pitch_, real(0));
        std::fill(work, work + pitch_, real(0));
        for (int y = 0; y < region_.height; ++y) {
            real* const row = columns + y * pitch_;
            std::fill(row + used, row + pitch_, real(0));
            sum_windows<Lanes>(batches<const real>{row, Lanes::size}, 1, region_.width, n, work,
                               batches<real>{line, Lanes::size});
            sums(y, static_cast<const real*>(line));
        }
    }

private:
    std::ptrdiff_t column() const { return std::ptrdiff_t{region_.height + 2 * radius_} * Lanes::size; }

    extent region_;
    int radius_;
    std::ptrdiff_t pitch_;
};

}  // namespace winnow
