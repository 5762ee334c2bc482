// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/window/square.hpp>

using namespace winnow;

static_assert(window::square{.radius = 2}.half_width(-2) == 2);
static_assert(area(window::square{.radius = 0}) == 1);
static_assert(area(window::square{.radius = 7}) == 225);
static_assert(area(window::square{}) == 441);
static_assert(area(window::square{.radius = 30000}) == 60001LL * 60001);

TEST_CASE("a square refuses a negative radius by name") {
    CHECK_NOTHROW(window::square{.radius = 0}.check());
    CHECK_THROWS_WITH(window::square{.radius = -1}.check(), "window: radius is -1, it must be 0 or more");
}
