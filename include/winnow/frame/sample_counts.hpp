// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How many samples each pixel has, or is to get: whole numbers, and how a density becomes such numbers.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>
#include <winnow/frame/pixel_memory.hpp>
#include <winnow/image/hilbert_curve.hpp>
#include <winnow/image/image.hpp>
#include <winnow/image/plane.hpp>

namespace winnow {

/// A whole number for each pixel.
class sample_counts {
public:
    sample_counts() = default;
    /// The same in every pixel.
    explicit sample_counts(extent size, int each = 0) : size_(size) {
        counts_.assign(detail::pixel_memory("a map of sample counts", size, 1, sizeof(int)) / sizeof(int), each);
    }

    extent size() const { return size_; }
    int& at(int x, int y) { return counts_[index_of(x, y)]; }
    int at(int x, int y) const { return counts_[index_of(x, y)]; }

    std::int64_t total() const {
        std::int64_t sum = 0;
        for (const int n : counts_) sum += n;
        return sum;
    }
    /// Of the pixels; 0 where there are none.
    int fewest() const { return counts_.empty() ? 0 : *std::min_element(counts_.begin(), counts_.end()); }
    int most() const { return counts_.empty() ? 0 : *std::max_element(counts_.begin(), counts_.end()); }

    /// Pixel by pixel; both must be of one size.
    sample_counts& operator+=(const sample_counts& more) {
        if (more.size_ != size_)
            fail("sample counts of " + to_string(more.size_) + " pixels cannot be added to some of " +
                 to_string(size_));
        for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += more.counts_[i];
        return *this;
    }
    /// As filters read it; exact up to 2^24.
    image<float> plane() const {
        image<float> result(size_);
        for (int y = 0; y < size_.height; ++y)
            for (int x = 0; x < size_.width; ++x) result.at(x, y) = static_cast<float>(at(x, y));
        return result;
    }
    bool operator==(const sample_counts&) const = default;

private:
    std::size_t index_of(int x, int y) const {
        assert(x >= 0 && y >= 0 && x < size_.width && y < size_.height);
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
    }

    extent size_;
    std::vector<int> counts_;
};

/// What is handed out.
struct sample_budget {
    std::int64_t total = 0;                     ///< samples of all pixels
    int cap = std::numeric_limits<int>::max();  ///< the most that one pixel gets
    /// In [0, 1): where the rounding begins.  Maps from one density and several phases round up other pixels.
    double phase = 0.5;
};

namespace detail {

/// min(cap, scale density), and what pixels of density 0 get where all others are at the cap.
struct sample_shares {
    double scale = std::numeric_limits<double>::infinity(), of_zero = 0, cap = 0;

    double operator()(float density) const { return density > 0 ? std::min(cap, scale * density) : of_zero; }
};

inline float valid_density(float value) { return is_finite(value) && value > 0 ? value : 0; }

/// The shares that sum to the budget, which must not be more than cap pixels.  Densities are in ascending order.
inline sample_shares shares_of(const std::vector<float>& ascending, double budget, double cap) {
    sample_shares result{.cap = cap};
    double sum = 0, open = 0;  // of those that are not clamped
    std::size_t count = 0;
    // The smaller densities are left unclamped as long as the largest of them stays below the cap.
    double sum_so_far = 0;
    for (std::size_t m = 1; m <= ascending.size(); ++m) {
        const double largest = ascending[m - 1];
        const double left = budget - cap * static_cast<double>(ascending.size() - m);
        sum_so_far += largest;
        if (left * largest <= cap * sum_so_far) count = m, sum = sum_so_far, open = left;
    }
    if (sum > 0) result.scale = open / sum;
    else if (count > 0) result.of_zero = open / static_cast<double>(count);
    return result;
}

}  // namespace detail

/// Samples in proportion to a density of one channel and any scale, of exactly that total.  Where a pixel's share is
/// above the cap it is clamped, and the others get the excess in proportion; values that are negative or no number
/// count as 0, and a density of 0 everywhere means the same in every pixel.  Each count is its share rounded up or
/// down: what rounding leaves over goes on to the next pixel of a Hilbert curve, so that in each aligned square of side
/// 2^k the samples are within one of the sum of the shares, and no direction is preferred (Velho, Gomes, "Digital
/// Halftoning with Space Filling Curves", 1991).  Throws invalid_input where the pixels cannot take the budget.
inline sample_counts counts_from_density(const source& density, const sample_budget& budget) {
    sample_counts counts(density.size);
    const std::int64_t pixels = density.size.pixels();
    if (density.channels != 1) fail("a sampling density has one channel, not " + std::to_string(density.channels));
    if (budget.total < 0 || budget.cap < 0)
        fail("a budget of " + std::to_string(budget.total) + " samples, at most " + std::to_string(budget.cap) +
             " in a pixel: neither may be negative");
    if (budget.total > 0 && (budget.total - 1) / pixels >= budget.cap)
        fail("a budget of " + std::to_string(budget.total) + " samples is more than " + std::to_string(budget.cap) +
             " in each of " + std::to_string(pixels) + " pixels");
    if (!(budget.phase >= 0 && budget.phase < 1))
        fail("the phase is " + std::to_string(budget.phase) + ", it must be in [0, 1)");

    const int cap = static_cast<int>(std::min<std::int64_t>(budget.cap, budget.total));
    std::vector<float> ascending;
    ascending.reserve(static_cast<std::size_t>(pixels));
    for (int y = 0; y < density.size.height; ++y)
        for (int x = 0; x < density.size.width; ++x) ascending.push_back(detail::valid_density(density.at(x, y)));
    std::sort(ascending.begin(), ascending.end());
    const detail::sample_shares share = detail::shares_of(ascending, static_cast<double>(budget.total), cap);
    const auto share_at = [&](int x, int y) { return share(detail::valid_density(density.at(x, y))); };

    double carry = budget.phase;
    std::int64_t left = budget.total;
    along_hilbert_curve(density.size, [&](int x, int y) {
        const double wanted = share_at(x, y) + carry;
        const int n = static_cast<int>(std::min<double>(cap, wanted));
        counts.at(x, y) = n;
        carry = wanted - n;
        left -= n;
    });
    // The shares are rounded numbers themselves: their sum may miss the budget by a little, and the last count by one.
    along_hilbert_curve(density.size, [&](int x, int y) {
        int& n = counts.at(x, y);
        if (left > 0 && n < share_at(x, y)) ++n, --left;
        if (left < 0 && n > share_at(x, y)) --n, ++left;
    });
    return counts;
}

}  // namespace winnow
