// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <limits>
#include <support/catch.hpp>
#include <winnow/core/half.hpp>

using namespace winnow;

static_assert(sizeof(half) == 2 && std::is_trivially_copyable_v<half>);
static_assert(!std::is_convertible_v<float, half>);  // losing digits takes a word

namespace {
half from_bits(unsigned bits) {
    half h;
    h.bits = static_cast<std::uint16_t>(bits);
    return h;
}

/// IEEE 754, 3.4: sign, five exponent bits, ten mantissa bits.
double value_of(unsigned bits) {
    const int exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    const double magnitude = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    return bits & 0x8000 ? -magnitude : magnitude;
}
}  // namespace

TEST_CASE("every finite half has its value and comes back to its bits, signed zeros included") {
    int wrong = 0;
    for (unsigned bits = 0; bits < 0x10000; ++bits) {
        if ((bits & 0x7c00) == 0x7c00) continue;
        const float value = from_bits(bits);
        if (value != value_of(bits) || std::signbit(value) != (bits >= 0x8000) || half(value).bits != bits) ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("infinities come back, and every NaN stays one with its sign") {
    CHECK(float(from_bits(0x7c00)) == std::numeric_limits<float>::infinity());
    CHECK(float(from_bits(0xfc00)) == -std::numeric_limits<float>::infinity());
    CHECK(half(std::numeric_limits<float>::infinity()).bits == 0x7c00);
    CHECK(half(-std::numeric_limits<float>::infinity()).bits == 0xfc00);
    int wrong = 0;
    for (const unsigned sign : {0u, 0x8000u})
        for (unsigned mantissa = 1; mantissa < 1024; ++mantissa) {
            const float value = from_bits(sign | 0x7c00 | mantissa);
            const half back(value);
            if (!std::isnan(value) || (back.bits & 0x7c00) != 0x7c00 || (back.bits & 1023) == 0 ||
                (back.bits & 0x8000) != sign)
                ++wrong;
        }
    CHECK(wrong == 0);
}

TEST_CASE("known values") {
    CHECK(half(1.0f).bits == 0x3c00);
    CHECK(half(-2.0f).bits == 0xc000);
    CHECK(half(0.1f).bits == 0x2e66);
    CHECK(half(65504.0f).bits == 0x7bff);  // the largest
    CHECK(half(0x1p-14f).bits == 0x0400);  // the smallest normal
    CHECK(half(0x1p-24f).bits == 0x0001);  // the smallest of all
    CHECK(float(half(1.0f / 3)) == 0.333251953125f);
}

TEST_CASE("between two neighbours the nearer one is taken, half way the even one") {
    int wrong = 0;
    for (unsigned bits = 0; bits < 0x7bff; ++bits) {
        const float below = from_bits(bits), above = from_bits(bits + 1), middle = (below + above) / 2;
        const unsigned even = bits % 2 ? bits + 1 : bits;
        if (half(middle).bits != even || half(std::nextafter(middle, below)).bits != bits ||
            half(std::nextafter(middle, above)).bits != bits + 1 || half(-middle).bits != (0x8000 | even))
            ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("what is too large becomes infinite, what is too small zero") {
    CHECK(half(65519.996f).bits == 0x7bff);  // below the middle of 65504 and 65536
    CHECK(half(65520.0f).bits == 0x7c00);    // the middle: to even, that is to infinity
    CHECK(half(1e30f).bits == 0x7c00);
    CHECK(half(-1e30f).bits == 0xfc00);
    CHECK(half(0x1p-25f).bits == 0);  // half of the smallest: to even
    CHECK(half(std::nextafter(0x1p-25f, 1.0f)).bits == 1);
    CHECK(half(-1e-30f).bits == 0x8000);
    CHECK(half(std::numeric_limits<float>::denorm_min()).bits == 0);
}
