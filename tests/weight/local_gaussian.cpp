// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/weight/local_gaussian.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("a Gaussian with the bandwidth of p, by hand") {
    neighbourhood<planes<depth_t, bandwidth_t>> around({2, 1});
    around.at(depth, 1, 0) = 3;
    around.at(bandwidth, 0, 0) = 2;
    around.at(bandwidth, 1, 0) = 0.5f;
    const auto w = gaussian(l2(depth), bandwidth);
    CHECK(w(around.pair(0, 0, 1, 0)) == Approx(std::exp(-9.0 / 8)));
    CHECK(w(around.pair(1, 0, -1, 0)) == Approx(std::exp(-9.0 / 0.5)));
    CHECK(w(around.pair(0, 0, 0, 0)) == 1);
}

TEST_CASE("a bandwidth that vanishes leaves the pixel alone, even with neighbours just like it") {
    neighbourhood<planes<depth_t, bandwidth_t>> around({2, 1});
    const auto w = gaussian(l2(depth), bandwidth);
    for (const float h : {0.0f, 1e-30f, 0.9e-3f, -1.0f}) {
        around.at(bandwidth, 0, 0) = h;
        CHECK(w(around.pair(0, 0, 0, 0)) == 1);
        CHECK(w(around.pair(0, 0, 1, 0)) < 2e-35f);
    }
    around.at(bandwidth, 0, 0) = 2e-3f;
    CHECK(w(around.pair(0, 0, 1, 0)) == 1);
    around.at(depth, 1, 0) = 1;
    CHECK(w(around.pair(0, 0, 1, 0)) < 2e-35f);
}
