// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A Real that offers what policies may use and nothing else.  It works in double and carries a bound on how far the
/// same computation in float, by scalars or by lanes, can be from its value.
#include <algorithm>
#include <cmath>

namespace winnow::test {

class archetype {
public:
    /// The outcome of a comparison: only `select` understands it, an `if` does not.
    class mask {
        friend archetype;
        mask(bool holds, bool sure) : holds_(holds), sure_(sure) {}
        bool holds_, sure_;
    };

    explicit archetype(float x) : value_(x), bound_(0) {}
    static archetype load(const float* from) { return archetype(*from); }

    friend archetype operator+(archetype a, archetype b) { return rounded(a.value_ + b.value_, a.bound_ + b.bound_); }
    friend archetype operator-(archetype a, archetype b) { return a + -b; }
    friend archetype operator-(archetype a) { return {-a.value_, a.bound_}; }
    friend archetype operator*(archetype a, archetype b) {
        return rounded(a.value_ * b.value_,
                       std::abs(a.value_) * b.bound_ + std::abs(b.value_) * a.bound_ + a.bound_ * b.bound_);
    }
    friend archetype operator/(archetype a, archetype b) {
        const double value = a.value_ / b.value_;
        return rounded(value, (a.bound_ + std::abs(value) * b.bound_) / (std::abs(b.value_) - b.bound_));
    }
    friend mask operator<(archetype a, archetype b) { return compared(a, b); }

    static archetype min(archetype a, archetype b) {
        return {std::min(a.value_, b.value_), std::max(a.bound_, b.bound_)};
    }
    static archetype max(archetype a, archetype b) { return -min(-a, -b); }
    static archetype select(mask m, archetype a, archetype b) {
        const double apart = m.sure_ ? 0 : std::abs(a.value_ - b.value_);
        return {m.holds_ ? a.value_ : b.value_, std::max(a.bound_, b.bound_) + apart};
    }
    static archetype sqrt(archetype a) {
        const double value = std::sqrt(a.value_);
        return rounded(value, value - std::sqrt(std::max(0.0, a.value_ - a.bound_)));
    }
    /// Rounded twice: the scalar code may do so.
    static archetype fma(archetype a, archetype b, archetype c) { return a * b + c; }
    /// Two units in the last place are four roundings.
    static archetype reciprocal(archetype a) {
        const archetype exact = archetype(1) / a;
        return {exact.value_, exact.bound_ + 3 * rounding * std::abs(exact.value_)};
    }
    /// Relative 2e-7.
    static archetype exp(archetype a) {
        const double value = std::exp(a.value_);
        return {value, value * (std::expm1(a.bound_) + 2e-7) + smallest};
    }

    /// For the tests alone.
    friend double value_of(archetype a) { return a.value_; }
    friend double bound_of(archetype a) { return a.bound_; }

private:
    static constexpr double rounding = 0x1p-24;   ///< half a unit in the last place
    static constexpr double smallest = 0x1p-126;  ///< below it lanes may flush to zero

    archetype(double value, double bound) : value_(value), bound_(bound) {}
    static mask compared(archetype a, archetype b) {
        const double apart = b.value_ - a.value_;
        return {apart > 0, std::abs(apart) > a.bound_ + b.bound_};
    }
    static archetype rounded(double value, double bound) {
        return {value, bound + rounding * (std::abs(value) + bound) + smallest};
    }

    double value_, bound_;
};

}  // namespace winnow::test
