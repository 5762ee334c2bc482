// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How many times one error is the other, over several seeds and scenes.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace winnow::benchmarks {

struct estimate {
    double value, error;  ///< and its standard error

    std::string shown() const {
        char text[64];
        std::snprintf(text, sizeof text, "%.3f +- %.3f", value, error);
        return text;
    }
    /// 1.386(8) for 1.386 +- 0.008.
    std::string short_form() const {
        char text[64];
        std::snprintf(text, sizeof text, "%.3f(%.0f)", value, std::ceil(1000 * error));
        return text;
    }
};

/// The ratio of the means of two errors that were measured on the same renders; its error from how far each render is
/// from that ratio.
inline estimate ratio(const std::vector<double>& over, const std::vector<double>& under) {
    const double n = static_cast<double>(over.size());
    double sum_over = 0, sum_under = 0, squares = 0;
    for (std::size_t i = 0; i < over.size(); ++i) sum_over += over[i], sum_under += under[i];
    const double r = sum_over / sum_under;
    for (std::size_t i = 0; i < over.size(); ++i) squares += (over[i] - r * under[i]) * (over[i] - r * under[i]);
    return {r, n > 1 ? std::sqrt(squares / (n * (n - 1))) / (sum_under / n) : 0};
}

/// The geometric mean of ratios, which are taken for independent; those that are not positive are left out.
inline estimate mean_ratio(const std::vector<estimate>& ratios) {
    double sum = 0, squares = 0;
    int n = 0;
    for (const estimate& r : ratios)
        if (r.value > 0) sum += std::log(r.value), squares += (r.error / r.value) * (r.error / r.value), ++n;
    if (n == 0) return {std::nan(""), 0};
    const double mean = std::exp(sum / n);
    return {mean, mean * std::sqrt(squares) / n};
}

}  // namespace winnow::benchmarks
