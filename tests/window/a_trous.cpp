// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/window/a_trous.hpp>

using namespace winnow;

TEST_CASE("an a-trous window has 25 offsets at every level, twice as far apart at each") {
    for (int level = 0; level < 6; ++level) {
        const window::a_trous holes{.level = level};
        CHECK(area(holes) == 25);
        CHECK(step(holes) == 1 << level);
        CHECK(holes.reach() == 2 << level);
    }
    CHECK(area(window::a_trous{.level = 3, .radius = 1}) == 9);
}

TEST_CASE("an a-trous window refuses what it cannot be by name") {
    CHECK_THROWS_WITH(window::a_trous{.level = -1}.check(), Catch::Contains("level is -1"));
    CHECK_THROWS_WITH((window::a_trous{.level = 0, .radius = -2}.check()), Catch::Contains("radius is -2"));
    CHECK_NOTHROW(window::a_trous{}.check());
}
