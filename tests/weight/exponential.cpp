// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/weight/exponential.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("exponential is exp(-d), and never quite 0") {
    neighbourhood<planes<>> around({9, 9});
    const auto weight = exponential(spatial);
    CHECK(weight(around.pair(4, 4, 0, 0)) == 1);
    CHECK(weight(around.pair(4, 4, 1, 0)) == Approx(0.36787944).epsilon(1e-6));
    CHECK(weight(around.pair(4, 4, 1, -2)) == Approx(6.7379470e-3).epsilon(1e-6));  // exp(-5)
    CHECK(weight(around.pair(0, 0, 8, 4)) == Approx(1.8048514e-35).epsilon(1e-5));  // exp(-80): 8^2 + 4^2
    CHECK(weight(around.pair(0, 0, 8, 8)) == weight(around.pair(0, 0, 8, 4)));      // and no less
    CHECK(weight.exponent(around.pair(0, 0, 8, 8)) == 128);
}
