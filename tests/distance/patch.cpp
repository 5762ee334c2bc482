// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/distance/squared_difference.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
/// An image of 3x3 depths, (x + 1)^2 (y + 1), amid pixels that do not exist but hold a number.
neighbourhood<planes<depth_t>> three_by_three() {
    neighbourhood<planes<depth_t>> around({9, 9});
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const bool inside = x >= 3 && x < 6 && y >= 3 && y < 6;
            around.covered(x, y) = inside ? 1.0f : 0.0f;
            around.at(depth, x, y) = inside ? static_cast<float>((x - 2) * (x - 2) * (y - 2)) : 777;
        }
    return around;
}
}  // namespace

TEST_CASE("a patch averages over the pairs that exist, by hand") {
    // 1  4  9
    // 2  8 18
    // 3 12 27
    auto around = three_by_three();
    const auto distance = patch(l2(depth), {.radius = 1});
    // From the corner to its right: the pairs 1-4, 4-9, 2-8 and 8-18.
    CHECK(distance(around.pair(3, 3, 1, 0)) == Approx((9 + 25 + 36 + 100) / 4.0));
    // From the centre to its right: also 3-12 and 12-27.
    CHECK(distance(around.pair(4, 4, 1, 0)) == Approx((9 + 25 + 36 + 100 + 81 + 225) / 6.0));
    // From corner to corner nothing but the corners: 1-27.
    CHECK(distance(around.pair(3, 3, 2, 2)) == Approx(26 * 26));
    CHECK(distance(around.pair(5, 5, -2, -2)) == Approx(26 * 26));
}

TEST_CASE("a patch of radius 0 is its pixel, and a patch larger than the image is the mean of all pairs") {
    auto around = three_by_three();
    CHECK(patch(l2(depth), {.radius = 0})(around.pair(4, 4, 1, 1)) == 19 * 19);
    // Offset (1, 1): 1-8, 4-18, 2-12 and 8-27.
    CHECK(patch(l2(depth), {.radius = 2})(around.pair(3, 3, 1, 1)) == Approx((49 + 196 + 100 + 361) / 4.0));
}

TEST_CASE("a patch says what it averages, how far it looks, and which radius it refuses") {
    const auto distance = patch(l2(depth), {.radius = 2});
    static_assert(std::is_same_v<decltype(distance)::prepares, distance::squared_difference<depth_t>>);
    CHECK(distance.reach() == 2);
    CHECK(patch(l2(depth)).radius == 3);
    CHECK_NOTHROW(patch(l2(depth), {.radius = 0}).check());
    CHECK_THROWS_WITH(patch(l2(depth), {.radius = -1}).check(), "patch: radius is -1, it must be 0 or more");
}
