// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/mahalanobis.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("the distance of Mahalanobis, by hand: both spreads count") {
    neighbourhood<planes<position_t, precision_of<position_t>>> around({2, 1});
    around.at(position, 0, 0, 0) = 1;
    around.at(position, 1, 0, 0) = 3;  // difference (2, 0, 0)
    around.at(precision(position), 0, 0, 0) = 0.25f;
    around.at(precision(position), 1, 0, 0) = 0.5f;
    CHECK(mahalanobis(position)(around.pair(0, 0, 1, 0)) == Approx(4 * 0.75));
    CHECK(mahalanobis(position)(around.pair(1, 0, -1, 0)) == Approx(4 * 0.75));
    around.at(position, 1, 0, 2) = -1;  // (2, 0, -1), with xz = .1 and zz = 3
    around.at(precision(position), 0, 0, 2) = 0.1f;
    around.at(precision(position), 1, 0, 5) = 3;
    CHECK(mahalanobis(position)(around.pair(0, 0, 1, 0)) == Approx(4 * 0.75 - 2 * 0.2 + 3));
    CHECK(mahalanobis(position)(around.pair(0, 0, 0, 0)) == 0);
}

TEST_CASE("whatever the units and the axes: an affine map of the positions changes no distance") {
    // p -> L p + t and S -> L S L^T, so A -> L^-T A L^-1, worked out for a shear and a scale.
    neighbourhood<planes<position_t, precision_of<position_t>>> before({2, 1}), after({2, 1});
    const float p[2][3] = {{0.2f, -0.4f, 1}, {0.9f, 0.3f, 0.5f}};
    const float a[2][6] = {{2, 0.5f, 0.1f, 3, -0.2f, 1}, {1, -0.3f, 0.2f, 2, 0.4f, 4}};
    // L = diag(2, 10, .5) (1 .5 0; 0 1 0; 0 0 1);  L^-1 = (1 -.5 0; 0 1 0; 0 0 1) diag(.5, .1, 2)
    const double m[3][3] = {{0.5, -0.05, 0}, {0, 0.1, 0}, {0, 0, 2}};
    for (int x = 0; x < 2; ++x) {
        for (int c = 0; c < 3; ++c) before.at(position, x, 0, c) = p[x][c];
        for (int c = 0; c < 6; ++c) before.at(precision(position), x, 0, c) = a[x][c];
        after.at(position, x, 0, 0) = 2 * (p[x][0] + 0.5f * p[x][1]) + 7;
        after.at(position, x, 0, 1) = 10 * p[x][1] - 3;
        after.at(position, x, 0, 2) = 0.5f * p[x][2] + 1;
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) {
                double sum = 0;
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l < 3; ++l) sum += m[k][i] * a[x][upper_triangle<3>(k, l)] * m[l][j];
                after.at(precision(position), x, 0, upper_triangle<3>(i, j)) = static_cast<float>(sum);
            }
    }
    const float expected = mahalanobis(position)(before.pair(0, 0, 1, 0));
    CHECK(expected > 1);
    CHECK(mahalanobis(position)(after.pair(0, 0, 1, 0)) == Approx(expected).epsilon(1e-4));
}
