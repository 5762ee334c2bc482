// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/core/error.hpp>

using namespace winnow;

TEST_CASE("bad input is one exception type, which is also a standard one, and carries its message") {
    CHECK_THROWS_WITH(fail("albedo is 640x480, color is 1280x960"), "albedo is 640x480, color is 1280x960");
    CHECK_THROWS_AS(fail(""), invalid_input);
    CHECK_THROWS_AS(fail(""), std::invalid_argument);
}
