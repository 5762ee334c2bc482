// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <limits>
#include <support/catch.hpp>
#include <winnow/frame/precision.hpp>

using namespace winnow;

namespace {

using triangle = std::array<float, 6>;

/// The largest entry of  A (S + floor I) - I.
double defect(const triangle& s, const triangle& a, double floor) {
    double worst = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double sum = 0;
            for (int k = 0; k < 3; ++k)
                sum += double{a[static_cast<std::size_t>(upper_triangle<3>(i, k))]} *
                       (s[static_cast<std::size_t>(upper_triangle<3>(k, j))] + (k == j ? floor : 0));
            worst = std::max(worst, std::abs(sum - (i == j)));
        }
    return worst;
}

double trace(const triangle& s) { return double{s[0]} + s[3] + s[5]; }

}  // namespace

TEST_CASE("the upper triangle of a symmetric matrix, row by row") {
    int expected = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j, ++expected) {
            CHECK(upper_triangle<3>(i, j) == expected);
            CHECK(upper_triangle<3>(j, i) == expected);
        }
    CHECK(upper_triangle<1>(0, 0) == 0);
    CHECK(upper_triangle<9>(8, 8) == 44);
}

TEST_CASE("the inverse of a covariance by hand") {
    // floor = 1e-4 (1 + 4 + 16): 1 / (1 + .0021), ...
    const triangle a = regularized_precision({1, 0, 0, 4, 0, 16}, 0, 1e-4);
    CHECK(a[0] == Approx(1 / 1.0021));
    CHECK(a[3] == Approx(1 / 4.0021));
    CHECK(a[5] == Approx(1 / 16.0021));
    for (const int off : {1, 2, 4}) CHECK(a[static_cast<std::size_t>(off)] == 0);
}

TEST_CASE("a covariance of any rank has an inverse, as exact as floats are") {
    const double ridge = 1e-4;
    // v v^T + w w^T of footprints from a thousandth to a thousand units
    for (const double size : {1e-3, 1.0, 1e3})
        for (const int rank : {0, 1, 2, 3}) {
            const double v[3][3] = {{0.3, -0.7, 0.2}, {0.5, 0.1, -0.4}, {-0.2, 0.3, 0.6}};
            triangle s{};
            for (int r = 0; r < rank; ++r)
                for (int i = 0; i < 3; ++i)
                    for (int j = i; j < 3; ++j)
                        s[static_cast<std::size_t>(upper_triangle<3>(i, j))] +=
                            static_cast<float>(size * size * v[r][i] * v[r][j]);
            const triangle a = regularized_precision(s, 0, ridge);
            CAPTURE(size, rank);
            if (rank == 0) CHECK(a[0] == static_cast<float>(largest_precision));
            // The condition is 1e4 at most, so that of the seven digits of a float three are left.
            else CHECK(defect(s, a, ridge * trace(s)) < 3e-3);
        }
}

TEST_CASE("coordinates far from the origin have no precision that their rounding does not leave") {
    const triangle s{1e-10f, 0, 0, 1e-10f, 0, 1e-10f};
    const double rounding = 4 * 6e-8 * 1000;
    const triangle a = regularized_precision(s, 1000, 1e-4);
    CHECK(a[0] == Approx(1 / (1e-10 + rounding * rounding)));
    CHECK(regularized_precision({}, 1000, 1e-4)[0] == Approx(1 / (rounding * rounding)));
}

TEST_CASE("what is no covariance gives numbers all the same") {
    const float huge = 1e30f;
    for (const triangle& s : {triangle{1, 5, 0, 1, 0, 1}, triangle{-1, 0, 0, -1, 0, -1},
                              triangle{huge, huge, huge, huge, huge, huge}, triangle{1e-38f, 0, 0, 0, 0, 0}})
        for (const float entry : regularized_precision(s, 1e-3, 1e-4)) {
            CHECK(std::isfinite(entry));
            CHECK(std::abs(entry) <= static_cast<float>(largest_precision));
        }
}
