// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <winnow/core/cholesky.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

/// The sum of `count` products v v^T, each v of its own, and `ridge` on the diagonal.
template <int N>
symmetric<double, N> sum_of_products(int count, double ridge) {
    symmetric<double, N> a{};
    for (int i = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j) {
            a.at(i, j) = i == j ? ridge : 0;
            for (int k = 0; k < count; ++k) a.at(i, j) += (uniform(1, k, i) - 0.5) * (uniform(1, k, j) - 0.5);
        }
    return a;
}

template <class Real, int N>
symmetric<Real, N> converted(const symmetric<double, N>& from) {
    symmetric<Real, N> to;
    for (int i = 0; i < to.count; ++i) to.lower[i] = Real(static_cast<float>(from.lower[i]));
    return to;
}

/// The largest |A x - b| / max |b|, where x is what the factors say.
template <int N>
double residual(const symmetric<double, N>& a, double smallest) {
    double x[N], b[N], worst = 0, scale = 0;
    for (int i = 0; i < N; ++i) x[i] = b[i] = uniform(2, i, 0) - 0.3, scale = std::max(scale, std::abs(b[i]));
    cholesky<double, N>(a, smallest).solve(x);
    for (int i = 0; i < N; ++i) {
        double sum = -b[i];
        for (int j = 0; j < N; ++j) sum += a.at(i, j) * x[j];
        worst = std::max(worst, std::abs(sum) / scale);
    }
    return worst;
}

}  // namespace

TEST_CASE("cholesky: a 2x2 and a 3x3 system worked by hand") {
    // 4 x + 2 y = 8, 2 x + 3 y = 8:  D = 4, 2 and L = 1/2.
    const cholesky<double, 2> two({4, 2, 3}, 1e-9);
    CHECK(two.factors.at(0, 0) == 0.25);
    CHECK(two.factors.at(1, 0) == 0.5);
    CHECK(two.factors.at(0, 1) == 0.5);
    CHECK(two.factors.at(1, 1) == 0.5);
    double x[2] = {8, 8};
    two.solve(x);
    CHECK(x[0] == 1);
    CHECK(x[1] == 2);

    // L = [1; 2 1; 3 4 1], D = 1, 2, 4, x = (1, -1, 2).
    const cholesky<float, 3> three({1, 2, 6, 3, 14, 45}, 1e-9f);
    CHECK(three.factors.at(2, 1) == 4);
    CHECK(three.factors.at(2, 2) == 0.25f);
    float y[3] = {5, 24, 79};
    three.solve(y);
    CHECK(y[0] == 1);
    CHECK(y[1] == -1);
    CHECK(y[2] == 2);
}

TEST_CASE("cholesky: what it finds solves the system, for sizes from 1 to 10") {
    CHECK(residual(sum_of_products<1>(2, 0), 1e-9) < 1e-15);
    CHECK(residual(sum_of_products<4>(20, 0), 1e-9) < 1e-13);
    CHECK(residual(sum_of_products<7>(40, 0), 1e-9) < 1e-13);
    CHECK(residual(sum_of_products<10>(80, 0), 1e-9) < 1e-13);
}

TEST_CASE("cholesky: with a ridge a matrix of low rank, or none, is no hazard") {
    CHECK(residual(sum_of_products<5>(2, 1e-4), 1e-4) < 1e-10);
    CHECK(residual(sum_of_products<5>(0, 1e-4), 1e-4) < 1e-12);
}

TEST_CASE("cholesky: pivots that rounding has made negative, zero or no number are taken for the smallest") {
    for (const float pivot : {-1.0f, 0.0f, NAN}) {
        float x[2] = {2, 3};
        cholesky<float, 2>({pivot, 0, 4}, 0.5f).solve(x);
        CHECK(x[0] == 4);
        CHECK(x[1] == 0.75f);
    }
}

TEST_CASE("cholesky: a system padded with the unit matrix has the bits of the smaller one") {
    const auto small = sum_of_products<3>(9, 0.1);
    symmetric<double, 5> padded{};
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j <= i; ++j) padded.at(i, j) = i < 3 ? small.at(i, j) : i == j;
    double x[3] = {1, 2, 3}, y[5] = {1, 2, 3, 0, 0};
    cholesky<double, 3>(small, 1e-6).solve(x);
    cholesky<double, 5>(padded, 1e-6).solve(y);
    for (int i = 0; i < 3; ++i) CHECK(x[i] == y[i]);
    CHECK(y[3] == 0);
    CHECK(y[4] == 0);
}

TEST_CASE("cholesky: the factors are all there is to keep, and float loses what the condition number says") {
    const auto a = sum_of_products<4>(20, 1e-3);  // eigenvalues between 0.5 and 3
    const cholesky<float, 4> kept(cholesky<float, 4>(converted<float>(a), 1e-3f).factors);
    double x[4] = {1, 2, -1, 0.5};
    float y[4] = {1, 2, -1, 0.5f};
    cholesky<double, 4>(a, 1e-3).solve(x);
    kept.solve(y);
    for (int i = 0; i < 4; ++i) CHECK(y[i] == Approx(x[i]).epsilon(0).margin(20 * 0x1p-24 * 6));
}

TEST_CASE("cholesky: systems too large to be unrolled, and padded ones, solve alike") {
    CHECK(residual(sum_of_products<12>(30, 1e-3), 1e-3) < 1e-12);
    CHECK(residual(sum_of_products<19>(40, 1e-3), 1e-3) < 1e-12);
    // 9 unknowns, and 6 rows and columns of the unit matrix behind them.
    const symmetric<double, 9> a = sum_of_products<9>(20, 1e-3);
    symmetric<double, 15> padded{};
    double x[9], y[15] = {};
    for (int i = 0; i < 15; ++i) padded.at(i, i) = 1;
    for (int i = 0; i < 9; ++i) {
        for (int j = 0; j <= i; ++j) padded.at(i, j) = a.at(i, j);
        x[i] = y[i] = uniform(3, i, 0) - 0.5;
    }
    cholesky<double, 9>(a, 1e-3).solve(x);
    cholesky<double, 15>(padded, 1e-3).solve(y);
    for (int i = 0; i < 9; ++i) CHECK(y[i] == Approx(x[i]).epsilon(1e-12));
    for (int i = 9; i < 15; ++i) CHECK(y[i] == 0);
}
