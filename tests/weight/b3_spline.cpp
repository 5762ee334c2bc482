// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/weight/b3_spline.hpp>

using namespace winnow;

TEST_CASE("the taps of a B3 spline are 1, 4, 6, 4, 1 along both axes, and none beyond") {
    const double taps[] = {1, 4, 6, 4, 1};
    const auto at = [](int step, int dx, int dy) {
        return weight::b3_spline{step}(pixel_pair<double, planes<>>(nullptr, nullptr, {}, dx, dy));
    };
    for (const int step : {1, 2, 16}) {
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j)
                CHECK(at(step, step * i, step * j) == Approx(taps[i + 2] * taps[j + 2] / 36).epsilon(1e-6));
        CHECK(at(step, 3 * step, 0) == 0);
        CHECK(at(step, 0, -40 * step) == 0);
    }
    CHECK_THROWS_WITH(weight::b3_spline{0}.check(), Catch::Contains("step is 0"));
}
