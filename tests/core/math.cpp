// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <limits>
#include <support/archetype.hpp>
#include <support/catch.hpp>
#include <winnow/core/math.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("min and max take the second argument where the first is NaN or equal") {
    CHECK(math::min(1.0f, 2.0f) == 1);
    CHECK(math::min(2.0f, 1.0f) == 1);
    CHECK(math::max(1.0, 2.0) == 2);
    CHECK(math::max(-1.0f, 0) == 0);  // a plain number will do
    CHECK(math::min(NAN, 3.0f) == 3);
    CHECK(math::max(NAN, 3.0f) == 3);
    CHECK(std::isnan(math::min(3.0f, NAN)));
    CHECK(std::isnan(math::max(3.0f, NAN)));
    CHECK(std::signbit(math::min(0.0f, -0.0f)));
}

TEST_CASE("select chooses without a branch") {
    CHECK(math::select(true, 1.0f, 2) == 1);
    CHECK(math::select(1.0 < 0.5, 1.0, 2.0) == 2);
}

TEST_CASE("exp_neg is exp(-x) up to its last exponent, and nothing, not even a NaN, is beyond it") {
    for (float x = 0; x <= 80; x += 0.37f) CHECK(math::exp_neg(x) == Approx(std::exp(-double(x))).epsilon(2e-7));
    CHECK(math::exp_neg(0.0f) == 1);
    CHECK(math::exp_neg(-0.0f) == 1);
    const float last = math::exp_neg(math::last_exponent);
    CHECK(last >= std::numeric_limits<float>::min());  // normal: a sum of such weights can be divided by
    for (const float x : {81.0f, 1e30f, INFINITY, NAN}) CHECK(math::exp_neg(x) == last);
}

TEST_CASE("the rest is what it is called") {
    CHECK(math::sqrt(9.0f) == 3);
    CHECK(math::fma(2.0f, 3, 4) == 10);
    CHECK(math::reciprocal(8.0) == 0.125);
    CHECK(math::square(-3.0f) == 9);
}

TEST_CASE("all of it is there for a Real that offers only what it must") {
    const archetype two(2), three(3);
    CHECK(value_of(math::min(two, three)) == 2);
    CHECK(value_of(math::max(two, three)) == 3);
    CHECK(value_of(math::select(two < three, two, three)) == 2);
    CHECK(value_of(math::sqrt(two + two)) == 2);
    CHECK(value_of(math::fma(two, three, two)) == 8);
    CHECK(value_of(math::reciprocal(two)) == 0.5);
    CHECK(value_of(math::exp_neg(two)) == Approx(std::exp(-2.0)));
    CHECK(value_of(math::square(three)) == 9);
}

TEST_CASE("the archetype bounds what rounding does") {
    // 1 + 2^-24 - 1 is 2^-24, but in float it is 0.
    const archetype sum = archetype(1) + archetype(0x1p-24f) - archetype(1);
    CHECK(value_of(sum) == 0x1p-24);
    CHECK(bound_of(sum) >= 0x1p-24);
    CHECK(bound_of(sum) <= 0x1p-23);
}
