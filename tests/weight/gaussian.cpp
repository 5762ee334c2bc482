// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/weight/gaussian.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("gaussian is exp(-d / (2 sigma^2)) of a squared distance") {
    neighbourhood<planes<>> around({9, 9});
    CHECK(gaussian(spatial, 2)(around.pair(4, 4, 2, 2)) == Approx(0.36787944).epsilon(1e-6));   // exp(-8 / 8)
    CHECK(gaussian(spatial, 1)(around.pair(4, 4, -1, 0)) == Approx(0.60653066).epsilon(1e-6));  // exp(-1 / 2)
    CHECK(gaussian(spatial, 0.5f).exponent(around.pair(4, 4, 3, 0)) == 18);                     // 9 / 0.5
}

TEST_CASE("at sigma 0 only pixels at distance 0 count") {
    neighbourhood<planes<>> around({9, 9});
    CHECK(gaussian(spatial, 0)(around.pair(4, 4, 0, 0)) == 1);
    CHECK(gaussian(spatial, 0)(around.pair(4, 4, 0, 1)) < 1e-34f);
    CHECK(gaussian(spatial, 1e-30f)(around.pair(4, 4, 0, 1)) < 1e-34f);  // its square is no float
}

TEST_CASE("a sigma that gaussian cannot use is refused by name") {
    CHECK_NOTHROW(gaussian(spatial, 0).check());
    CHECK_THROWS_WITH(gaussian(spatial, -2).check(),
                      Catch::Contains("gaussian: sigma is -2.0") && Catch::Contains("0 or more"));
    CHECK_THROWS_WITH(gaussian(spatial, NAN).check(), Catch::Contains("gaussian: sigma is nan"));
}
