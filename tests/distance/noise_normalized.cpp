// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/noise_normalized.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
neighbourhood<planes<color_t, variance_of<color_t>>> two_pixels(const float (&p)[3], const float (&q)[3],
                                                                const float (&var_p)[3], const float (&var_q)[3]) {
    neighbourhood<planes<color_t, variance_of<color_t>>> around({2, 1});
    for (int c = 0; c < 3; ++c) {
        around.at(color, 0, 0, c) = p[c];
        around.at(color, 1, 0, c) = q[c];
        around.at(variance(color), 0, 0, c) = var_p[c];
        around.at(variance(color), 1, 0, c) = var_q[c];
    }
    return around;
}
}  // namespace

TEST_CASE("the noise-normalised distance, by hand") {
    auto around = two_pixels({1, 2, 3}, {1.5f, 2, 1}, {0.1f, 0.2f, 0.5f}, {0.3f, 0.1f, 0.5f});
    const auto distance = noise_normalized(color, {.k = 0.5f});
    // ( .25 - (.1 + .1)) / (.25 * .4) = .5,  (0 - (.2 + .1)) / (.25 * .3) = -4,  (4 - (.5 + .5)) / (.25 * 1) = 12
    CHECK(distance(around.pair(0, 0, 1, 0)) == Approx((0.5 - 4 + 12) / 3).epsilon(1e-6));
    // Seen from q only what is subtracted changes: (.25 - (.3 + .1)) / .1 = -1.5,  (0 - (.1 + .1)) / .075,  12
    CHECK(distance(around.pair(1, 0, -1, 0)) == Approx((-1.5 - 0.2 / 0.075 + 12) / 3).epsilon(1e-6));
    // Twice the k divides by four.
    CHECK(noise_normalized(color, {.k = 1})(around.pair(0, 0, 1, 0)) == Approx((0.5 - 4 + 12) / 12).epsilon(1e-6));
}

TEST_CASE("two different pixels without noise are far apart, but finitely; equal ones are not apart at all") {
    auto around = two_pixels({1, 2, 3}, {1, 2, 1e15f}, {0, 0, 0}, {0, 0, 0});
    CHECK(noise_normalized(color)(around.pair(0, 0, 1, 0)) == Approx(1e4 / 3));
    CHECK(noise_normalized(color)(around.pair(0, 0, 0, 0)) == 0);
    // A difference of 0.1 in one channel at an epsilon of 1e-3: 0.01 / 1e-3.
    auto close = two_pixels({1, 2, 3}, {1, 2, 3.1f}, {0, 0, 0}, {0, 0, 0});
    CHECK(noise_normalized(color, {.epsilon = 1e-3f})(close.pair(0, 0, 1, 0)) == Approx(10.0 / 3).epsilon(1e-5));
}

TEST_CASE("numbers that noise_normalized cannot use are refused by name") {
    CHECK_NOTHROW(noise_normalized(color).check());
    CHECK_THROWS_WITH(noise_normalized(color, {.k = 0}).check(), Catch::Contains("noise_normalized: k is 0.0"));
    CHECK_THROWS_WITH(noise_normalized(color, {.k = NAN}).check(), Catch::Contains("noise_normalized: k is nan"));
    CHECK_THROWS_WITH(noise_normalized(color, {.k = INFINITY}).check(), Catch::Contains("noise_normalized: k is inf"));
    CHECK_THROWS_WITH(noise_normalized(color, {.epsilon = 0}).check(),
                      Catch::Contains("noise_normalized: epsilon is 0") && Catch::Contains("between 1e-30 and 1e10"));
}
