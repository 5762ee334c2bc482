// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/image/extent.hpp>

using namespace winnow;

TEST_CASE("an extent counts its pixels beyond the range of int, and prints as in messages") {
    CHECK(extent{100000, 50000}.pixels() == 5000000000);
    CHECK(to_string(extent{640, 480}) == "640x480");
    CHECK(extent{3, 4} != extent{4, 3});
}

TEST_CASE("a rectangle has a size and grows on every side") {
    const rectangle r{2, 3, 7, 5};
    CHECK(r.size() == extent{5, 2});
    CHECK(r.grown(4) == rectangle{-2, -1, 11, 9});
}
