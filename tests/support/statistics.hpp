// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Means with their standard errors, so that a test of something random says how far off it may be.
#include <cmath>
#include <ostream>

namespace winnow::test {

/// Mean and variance of independent values, one after the other (Welford).
struct statistic {
    double n = 0, mean = 0, squares = 0;

    void add(double value) {
        const double d = value - mean;
        mean += d / ++n;
        squares += d * (value - mean);
    }
    double variance() const { return squares / (n - 1); }
    /// Of the mean.
    double standard_error() const { return std::sqrt(variance() / n); }
    /// Whether the true mean can be this: within four standard errors (one test in 16000 fails by chance), or as near
    /// as floats are.
    bool allows(double truth) const {
        return n > 1 && std::abs(mean - truth) <= 4 * standard_error() + 1e-6 * std::abs(truth);
    }
};
inline std::ostream& operator<<(std::ostream& out, const statistic& s) {
    return out << s.mean << " +- " << s.standard_error() << " (" << s.n << ")";
}

/// Whether two have the same mean.
inline bool agree(const statistic& a, const statistic& b) {
    const double error = std::hypot(a.standard_error(), b.standard_error());
    return std::abs(a.mean - b.mean) <= 4 * error + 1e-6 * std::abs(a.mean);
}

}  // namespace winnow::test
