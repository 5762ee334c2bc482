// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/distance/chessboard.hpp>

using namespace winnow;

TEST_CASE("the chessboard distance is the larger of both, whatever the sign") {
    const auto at = [](int dx, int dy) {
        return chessboard(pixel_pair<double, planes<>>(nullptr, nullptr, {}, dx, dy));
    };
    CHECK(at(0, 0) == 0);
    CHECK(at(-3, 2) == 3);
    CHECK(at(3, -5) == 5);
    CHECK(at(4, 4) == 4);
}
