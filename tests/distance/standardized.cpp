// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/standardized.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
/// Two normals with their variances.
neighbourhood<planes<normal_t, variance_of<normal_t>>> two_pixels() {
    neighbourhood<planes<normal_t, variance_of<normal_t>>> around({2, 1});
    const float p[] = {0.1f, 0.2f, 0.3f}, q[] = {0.3f, 0.5f, -0.1f};
    const float var_p[] = {0.01f, 0, 0.001f}, var_q[] = {0.03f, 0, 0.003f};
    for (int c = 0; c < 3; ++c) {
        around.at(normal, 0, 0, c) = p[c];
        around.at(normal, 1, 0, c) = q[c];
        around.at(variance(normal), 0, 0, c) = var_p[c];
        around.at(variance(normal), 1, 0, c) = var_q[c];
    }
    return around;
}
}  // namespace

TEST_CASE("the standardized distance, by hand: each channel in units of its noise or of the floor") {
    auto around = two_pixels();
    // .04 / .04 + .09 / .01 + .16 / .01, both ways
    CHECK(standardized(normal)(around.pair(0, 0, 1, 0)) == Approx(26).epsilon(1e-6));
    CHECK(standardized(normal)(around.pair(1, 0, -1, 0)) == Approx(26).epsilon(1e-6));
    // .04 / .16 + .09 / .01 + .16 / .016
    CHECK(standardized(normal, {.spread = 4})(around.pair(0, 0, 1, 0)) == Approx(0.25 + 9 + 10).epsilon(1e-6));
    // .04 / .04 + .09 / .001 + .16 / .004
    CHECK(standardized(normal, {.floor = 1e-3f})(around.pair(0, 0, 1, 0)) == Approx(1 + 90 + 40).epsilon(1e-6));
}

TEST_CASE("a channel that is noise throughout does not tell pixels apart") {
    auto around = two_pixels();
    for (int x = 0; x < 2; ++x) around.at(variance(normal), x, 0, 1) = around.at(variance(normal), x, 0, 2) = 1e20f;
    CHECK(standardized(normal)(around.pair(0, 0, 1, 0)) == Approx(1).epsilon(1e-6));
}

TEST_CASE("numbers that standardized cannot use are refused by name") {
    CHECK_THROWS_WITH(standardized(normal, {.floor = 0}).check(), Catch::Contains("standardized: floor is 0.0"));
    CHECK_THROWS_WITH(standardized(normal, {.spread = -1}).check(), Catch::Contains("standardized: spread is -1.0"));
    CHECK_NOTHROW(standardized(normal).check());
}
