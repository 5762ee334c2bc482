// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/squared_difference.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("l2 sums the squared differences over the channels") {
    neighbourhood<planes<depth_t, albedo_t>> around({3, 2});
    const float p[] = {1, 2, 3}, q[] = {2, 0, 6};
    for (int c = 0; c < 3; ++c) {
        around.at(albedo, 0, 0, c) = p[c];
        around.at(albedo, 2, 1, c) = q[c];
    }
    around.at(depth, 0, 0) = 5;
    around.at(depth, 2, 1) = 1.5f;
    CHECK(l2(albedo)(around.pair(0, 0, 2, 1)) == 14);    // 1 + 4 + 9
    CHECK(l2(albedo)(around.pair(2, 1, -2, -1)) == 14);  // symmetric
    CHECK(l2(depth)(around.pair(0, 0, 2, 1)) == 12.25f);
}
