// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <winnow/core/symmetric_eigen.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("symmetric_eigen: a 2x2 matrix worked by hand") {
    // (5 2; 2 2) has the eigenvalues 6 and 1, with (2 1) / sqrt 5 and (1 -2) / sqrt 5.
    const double a[2][2] = {{5, 2}, {2, 2}};
    const symmetric_eigen<double, 2> e(a);
    CHECK(e.values[0] == Approx(6).epsilon(1e-12));
    CHECK(e.values[1] == Approx(1).epsilon(1e-12));
    CHECK(std::abs(e.vectors[0][0]) == Approx(2 / std::sqrt(5.0)).epsilon(1e-12));
    CHECK(e.vectors[1][0] / e.vectors[0][0] == Approx(0.5).epsilon(1e-12));
    CHECK(e.vectors[1][1] / e.vectors[0][1] == Approx(-2).epsilon(1e-12));
}

TEMPLATE_TEST_CASE("symmetric_eigen: V is orthogonal and V diag V^T is the matrix, also where it is singular", "",
                   float, double) {
    constexpr int n = 9;
    const double e = sizeof(TestType) == 4 ? 4e-6 : 4e-7;  // columns orthogonal to 1e-6 stay as they are
    for (const int rank : {9, 4, 1, 0}) {
        TestType a[n][n];
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= i; ++j) {
                double sum = 0;
                for (int k = 0; k < rank; ++k) sum += (uniform(1, k, i) - 0.5) * (uniform(1, k, j) - 0.5);
                a[i][j] = a[j][i] = static_cast<TestType>(sum);
            }
        const symmetric_eigen<TestType, n> eigen(a);
        int positive = 0;
        for (const TestType v : eigen.values) positive += v > 1e-5;
        CHECK(positive == rank);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                double product = 0, matrix = 0;
                for (int k = 0; k < n; ++k) {
                    product += double{eigen.vectors[k][i]} * eigen.vectors[k][j];
                    matrix += double{eigen.vectors[i][k]} * eigen.values[k] * eigen.vectors[j][k];
                }
                CHECK(std::abs(product - (i == j)) < e);
                CHECK(std::abs(matrix - double{a[i][j]}) < e);
            }
    }
}

TEST_CASE("symmetric_eigen: where an eigenvalue is double, rounding does not turn the axes") {
    const float a[3][3] = {{2, 1e-7f, 0}, {1e-7f, 2, 0}, {0, 0, 1}};
    const symmetric_eigen<float, 3> e(a);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) CHECK(e.vectors[i][j] == (i == j ? 1 : 0));
}
