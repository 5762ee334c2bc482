// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Means, sums of squared deviations and comoments, one sample at a time, and those of two sets of samples together.
/// Welford, "Note on a Method for Calculating Corrected Sums of Squares and Products", 1962;
/// Chan, Golub, LeVeque, "Updating Formulae and a Pairwise Algorithm for Computing Sample Variances", 1979.
#include <algorithm>
#include <utility>
#include <winnow/frame/unknown.hpp>

namespace winnow::detail {

/// Channels values whose means are kept, and the sums of squared deviations of the first Squares of them.
template <int Channels, int Squares>
struct moments {
    /// Takes in one sample; share is 1 / n with that sample counted.
    static void add(float* mean, const float* sample, float share) {
        float* const squares = mean + Channels;
        float deviation[Channels > 0 ? Channels : 1];
        for (int c = 0; c < Channels; ++c) deviation[c] = sample[c] - mean[c];
        for (int c = 0; c < Channels; ++c) mean[c] += deviation[c] * share;
        // (x - old mean) (x - new mean), in a form that no rounding makes negative.
        for (int c = 0; c < Squares; ++c) squares[c] += deviation[c] * deviation[c] * (1 - share);
    }
    /// Takes in the n_b samples behind b.
    static void merge(float* a, double n_a, const float* b, double n_b);
};

/// The mean of n_a values of mean a and n_b of mean b, which are not both 0.  The same bits for (a, b) and (b, a), also
/// where the compiler fuses a product and a sum.
inline double mean_of_both(double a, double n_a, double b, double n_b) {
    if (a > b) std::swap(a, b), std::swap(n_a, n_b);
    return a + (b - a) * (n_b / (n_a + n_b));
}

/// What the distance of their means adds to the squares of two sets of samples, per squared distance.
inline double cross_share(double n_a, double n_b) { return n_a * n_b / (n_a + n_b); }

/// The squares of two sets of samples together.
inline double squares_of_both(double a, double b, double distance_x, double distance_y, double share) {
    const double within = a + b;
    return within + distance_x * distance_y * share;
}

template <int Channels, int Squares>
void moments<Channels, Squares>::merge(float* a, double n_a, const float* b, double n_b) {
    if (n_b == 0) return;
    if (n_a == 0) {
        std::copy_n(b, Channels + Squares, a);
        return;
    }
    const double share = cross_share(n_a, n_b);
    for (int c = 0; c < Squares; ++c) {
        const double distance = double{b[c]} - a[c];
        a[Channels + c] =
            static_cast<float>(squares_of_both(a[Channels + c], b[Channels + c], distance, distance, share));
    }
    for (int c = 0; c < Channels; ++c) a[c] = static_cast<float>(mean_of_both(a[c], n_a, b[c], n_b));
}

/// Means and the upper triangle of the comoments of a few channels, in double: the thinnest direction of a surface is
/// as small beside the others as what float rounds off.
template <int Channels>
struct comoments {
    static constexpr int count = Channels + Channels * (Channels + 1) / 2;

    static void add(double* mean, const float* sample, double share) {
        double* comoment = mean + Channels;
        double deviation[Channels];
        for (int c = 0; c < Channels; ++c) deviation[c] = sample[c] - mean[c];
        for (int c = 0; c < Channels; ++c) mean[c] += deviation[c] * share;
        for (int i = 0; i < Channels; ++i)
            for (int j = i; j < Channels; ++j) *comoment++ += deviation[i] * deviation[j] * (1 - share);
    }

    static void merge(double* a, double n_a, const double* b, double n_b) {
        if (n_b == 0) return;
        if (n_a == 0) {
            std::copy_n(b, count, a);
            return;
        }
        const double share = cross_share(n_a, n_b);
        int at = Channels;
        for (int i = 0; i < Channels; ++i)
            for (int j = i; j < Channels; ++j, ++at)
                a[at] = squares_of_both(a[at], b[at], b[i] - a[i], b[j] - a[j], share);
        for (int c = 0; c < Channels; ++c) a[c] = mean_of_both(a[c], n_a, b[c], n_b);
    }
};

/// Where, from the first mean on, the comoment of channel c of several with itself is.
constexpr int diagonal(int channels, int c) { return channels + c * channels - c * (c - 1) / 2; }

/// Unknown where there is nothing to divide by.
inline float quotient(double numerator, double denominator) {
    return denominator > 0 ? static_cast<float>(numerator / denominator) : unknown;
}

/// The variance of the mean of n values, from their squares; of one value it is unknown.
inline float variance_of_mean(double squares, double n) { return quotient(squares, n * (n - 1)); }

}  // namespace winnow::detail
