// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/spatial.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("spatial is the squared length of the offset") {
    neighbourhood<planes<>> around({9, 9});
    CHECK(spatial(around.pair(4, 4, 0, 0)) == 0);
    CHECK(spatial(around.pair(4, 4, 3, -4)) == 25);
    CHECK(spatial(around.pair(4, 4, -4, 1)) == 17);
}
