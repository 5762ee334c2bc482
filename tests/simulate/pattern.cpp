// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/pattern.hpp>

#include <support/catch.hpp>
#include <support/statistics.hpp>

using namespace winnow::simulate;

TEST_CASE("checkers, stripes and spokes alternate, on both sides of zero") {
    CHECK(checker(0.5, 0.5) == 0);
    CHECK(checker(1.5, 0.5) == 1);
    CHECK(checker(-0.5, 0.5) == 1);
    CHECK(checker(-0.5, -0.5) == 0);
    CHECK(stripe(0.9) == 0);
    CHECK(stripe(-0.1) == 1);
    CHECK(spoke({1, 0.01}, 4) != spoke({-0.01, 1}, 4));
    CHECK(spoke({1, 0.01}, 4) == spoke({-1, -0.01}, 4));
}

TEST_CASE("noise is continuous, from 0 to below 1, and varies over a distance of one") {
    winnow::test::statistic values;
    for (int i = 0; i < 3000; ++i) {
        const vec3 p(0.37 * i - 500, -0.73 * i, 0.11 * i);
        const double v = value_noise(p);
        values.add(v);
        CHECK((v >= 0 && v < 1));
        CHECK(std::abs(value_noise(p + vec3(1e-6, -1e-6, 1e-6)) - v) < 1e-4);
        CHECK((fractal_noise(p, 4) >= 0 && fractal_noise(p, 4) < 1));
    }
    CHECK(values.allows(0.5));
    CHECK(values.variance() > 0.01);
    // On the lattice, from both sides of a cell's wall.
    CHECK(value_noise({3, 4, 5}) == Approx(value_noise({3 - 1e-12, 4, 5 - 1e-12})));
}
