// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/weight/cutoff.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("cutoff is 1 up to its limit, and 0 beyond") {
    neighbourhood<planes<>> around({9, 9});
    const auto weight = cutoff(spatial, 5);
    CHECK(weight(around.pair(4, 4, 0, 0)) == 1);
    CHECK(weight(around.pair(4, 4, 2, -1)) == 1);  // 5: the limit itself
    CHECK(weight(around.pair(4, 4, 2, 2)) == 0);   // 8
    CHECK(cutoff(spatial, 0)(around.pair(4, 4, 0, 0)) == 1);
    CHECK(cutoff(spatial, 0)(around.pair(4, 4, 0, 1)) == 0);
}

TEST_CASE("a limit that cutoff cannot use is refused by name") {
    CHECK_NOTHROW(cutoff(spatial, 0).check());
    CHECK_THROWS_WITH(cutoff(spatial, -1).check(),
                      Catch::Contains("cutoff: limit is -1.0") && Catch::Contains("0 or more"));
    CHECK_THROWS_WITH(cutoff(spatial, NAN).check(), Catch::Contains("cutoff: limit is nan"));
}
