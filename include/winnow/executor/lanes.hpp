// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// SIMD lanes as a `Real`: the one door through which xsimd enters.
#include <cstdint>
#include <winnow/core/platform.hpp>
#include <xsimd/xsimd.hpp>

namespace winnow {

/// As many doubles side by side as fit in a register: for sums whose leading digits cancel later on.
struct double_lanes {
    using real = double;
    using batch = xsimd::batch<double>;
    static constexpr int size = static_cast<int>(batch::size);

    batch v;

    double_lanes() = default;
    WINNOW_HD double_lanes(batch v) : v(v) {}
    WINNOW_HD explicit double_lanes(double x) : v(x) {}

    WINNOW_HD static double_lanes load(const double* from) { return batch::load_unaligned(from); }
    WINNOW_HD void store(double* to) const { v.store_unaligned(to); }
    WINNOW_HD void store(float* to) const { v.store_unaligned(to); }

    friend WINNOW_HD double_lanes operator+(double_lanes a, double_lanes b) { return a.v + b.v; }
    friend WINNOW_HD double_lanes operator-(double_lanes a, double_lanes b) { return a.v - b.v; }
    friend WINNOW_HD double_lanes operator*(double_lanes a, double_lanes b) { return a.v * b.v; }
};

/// As many floats side by side as the machine that the includer compiles for has in a register.
struct lanes {
    using real = float;
    using wide = double_lanes;
    using batch = xsimd::batch<float>;
    using mask = xsimd::batch_bool<float>;
    static constexpr int size = static_cast<int>(batch::size);

    batch v;

    lanes() = default;
    WINNOW_HD lanes(batch v) : v(v) {}
    WINNOW_HD explicit lanes(float x) : v(x) {}

    WINNOW_HD static lanes load(const float* from) { return batch::load_unaligned(from); }
    WINNOW_HD void store(float* to) const { v.store_unaligned(to); }

    friend WINNOW_HD lanes operator+(lanes a, lanes b) { return a.v + b.v; }
    friend WINNOW_HD lanes operator-(lanes a, lanes b) { return a.v - b.v; }
    friend WINNOW_HD lanes operator*(lanes a, lanes b) { return a.v * b.v; }
    friend WINNOW_HD lanes operator/(lanes a, lanes b) { return a.v / b.v; }
    friend WINNOW_HD lanes operator-(lanes a) { return -a.v; }
    friend WINNOW_HD mask operator<(lanes a, lanes b) { return a.v < b.v; }

    /// Where an operand is NaN the result is b, as for a scalar.
    WINNOW_HD static lanes min(lanes a, lanes b) { return xsimd::min(a.v, b.v); }
    WINNOW_HD static lanes max(lanes a, lanes b) { return xsimd::max(a.v, b.v); }
    WINNOW_HD static lanes sqrt(lanes a) { return xsimd::sqrt(a.v); }
    /// xsimd 8 multiplies and adds on AVX-512 and leaves the rest to the compiler, which fuses what it pleases.
    WINNOW_HD static lanes fma(lanes a, lanes b, lanes c) {
#if defined(__AVX512F__)
        return batch(_mm512_fmadd_ps(a.v, b.v, c.v));
#else
        return xsimd::fma(a.v, b.v, c.v);
#endif
    }
    WINNOW_HD static lanes select(mask m, lanes a, lanes b) { return xsimd::select(m, a.v, b.v); }

    /// The machine's estimate and one Newton step: y (2 - x y).
    WINNOW_HD static lanes reciprocal(lanes x) {
        const batch y = xsimd::reciprocal(x.v);
        return y * (batch(2.0f) - x.v * y);
    }

    /// exp(x) for |x| <= 87, to a relative 2e-7 and exactly 1 at 0: x = n ln 2 + f, a polynomial for exp(f) =
    /// 1 + f (1 + ...) through the Chebyshev nodes of |f| <= ln 2 / 2, and n added to the exponent bits.
    WINNOW_HD static lanes exp(lanes x) {
        // In [2^23, 2^24) a float's last mantissa bit is worth 1: adding the constant rounds to an integer.
        const batch round(12582912.0f);
        const batch shifted = xsimd::fma(x.v, batch(1.44269504f), round);
        const batch n = shifted - round;
        batch f = xsimd::fma(n, batch(-0.693359375f), x.v);  // few bits: n times it is exact
        f = xsimd::fma(n, batch(2.12194440e-4f), f);
        batch poly(1.3933686e-3f);
        poly = xsimd::fma(poly, f, batch(8.3691844e-3f));
        poly = xsimd::fma(poly, f, batch(4.1666465e-2f));
        poly = xsimd::fma(poly, f, batch(1.6666505e-1f));
        poly = xsimd::fma(poly, f, batch(0.5f));
        poly = xsimd::fma(poly, f, batch(1.0f));
        poly = xsimd::fma(poly, f, batch(1.0f));
        using bits = xsimd::batch<std::int32_t>;
        return xsimd::bitwise_cast<batch>(xsimd::bitwise_cast<bits>(poly) + (xsimd::bitwise_cast<bits>(shifted) << 23));
    }
};

}  // namespace winnow
