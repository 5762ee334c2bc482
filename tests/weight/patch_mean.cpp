// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/weight/cutoff.hpp>
#include <winnow/weight/patch_mean.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("the mean of a weight over a patch counts the pairs that exist, by hand") {
    // Depths 1 to 9 in three rows, amid pixels that do not exist.
    neighbourhood<planes<depth_t>> around({9, 9});
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const bool inside = x >= 3 && x < 6 && y >= 3 && y < 6;
            around.covered(x, y) = inside ? 1.0f : 0.0f;
            around.at(depth, x, y) = inside ? static_cast<float>((x - 2) * (x - 2) * (y - 2)) : 777;
        }
    // 1  4  9
    // 2  8 18
    // 3 12 27
    // Offset (1, 0), squared differences up to 81 count: 1-4, 4-9, 2-8, 3-12 do; 8-18 and 12-27 do not.
    const auto weight = patch_mean(cutoff(l2(depth), 81), {.radius = 1});
    CHECK(weight(around.pair(4, 4, 1, 0)) == Approx(4.0 / 6));
    CHECK(weight(around.pair(3, 3, 1, 0)) == Approx(3.0 / 4));  // the corner knows of 1-4, 4-9, 2-8 and 8-18
    CHECK(weight(around.pair(4, 4, 0, 0)) == 1);
}

TEST_CASE("a mean of weights says what it averages, how far it looks, and which radius it refuses") {
    const auto weight = patch_mean(cutoff(l2(depth), 1), {.radius = 2});
    static_assert(std::is_same_v<decltype(weight)::prepares, weight::cutoff<distance::squared_difference<depth_t>>>);
    CHECK(weight.reach() == 2);
    CHECK_THROWS_WITH(patch_mean(cutoff(l2(depth), 1), {.radius = -1}).check(),
                      "patch_mean: radius is -1, it must be 0 or more");
}
