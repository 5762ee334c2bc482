// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <limits>
#include <support/catch.hpp>
#include <winnow/image/srgb.hpp>

using namespace winnow;

TEST_CASE("the tone curve is that of sRGB") {
    CHECK(srgb(0.0f) == 0.0);
    CHECK(srgb(0.002f) == Approx(0.02584).epsilon(1e-6));     // 12.92 * 0.002
    CHECK(srgb(0.5f) == Approx(0.7353570).epsilon(1e-6));     // 1.055 * 0.5^(1/2.4) - 0.055
    CHECK(srgb(0.2140411f) == Approx(0.5).epsilon(1e-6));     // its inverse at one half
    CHECK(srgb(0.0031308f) == Approx(0.04045).margin(1e-6));  // where line and power meet
    CHECK(srgb(1.0f) == Approx(1).epsilon(1e-15));
    CHECK(srgb(-3.0f) == 0.0);
    CHECK(srgb(40.0f) == srgb(1.0f));
}

TEST_CASE("what is no number shows as black, and what is infinite as white") {
    CHECK(srgb(std::numeric_limits<double>::quiet_NaN()) == 0);
    CHECK(srgb(std::numeric_limits<double>::infinity()) == Approx(1));
    CHECK(srgb(-std::numeric_limits<double>::infinity()) == 0);
}
