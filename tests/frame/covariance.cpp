// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <limits>
#include <support/catch.hpp>
#include <winnow/frame/covariance.hpp>

using namespace winnow;

namespace {

image<> pixel(float x, float y, float z) {
    image<> i({1, 1}, 3);
    i.at(0, 0, 0) = x, i.at(0, 0, 1) = y, i.at(0, 0, 2) = z;
    return i;
}

image<> covariance_of(const std::vector<image<>>& renders) {
    const std::vector<source> all = [&] {
        std::vector<source> s;
        for (const image<>& r : renders) s.emplace_back(r.view());
        return s;
    }();
    image<> to({1, 1}, 6);
    covariance_of_renders(all, to.view());
    return to;
}

}  // namespace

TEST_CASE("the covariance of three renders by hand") {
    // About the mean (2, 1, 5): (-1, 2, 0), (0, -1, 0), (1, -1, 0)
    const image<> c = covariance_of({pixel(1, 3, 5), pixel(2, 0, 5), pixel(3, 0, 5)});
    const double expected[] = {2 / 3.0, -1, 0, 2, 0, 0};
    for (int k = 0; k < 6; ++k) CHECK(c.at(0, 0, k) == Approx(expected[k]));
}

TEST_CASE("far from the origin it is as exact as the renders are") {
    const float far = 16777216.0f / 4;  // a quarter of a unit is the least that a float can tell apart there
    const image<> c = covariance_of({pixel(far, 0, 0), pixel(far + 0.5f, 0, 0)});
    CHECK(c.at(0, 0, 0) == Approx(0.0625));
}

TEST_CASE("renders without the pixel do not count") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(covariance_of({pixel(1, 3, 5), pixel(nan, 0, 5), pixel(3, 3, 5)}).at(0, 0, 0) == 1);
    CHECK(covariance_of({pixel(1, 3, 5), pixel(nan, 0, 5)}).at(0, 0, 0) == 0);
    CHECK(std::isnan(covariance_of({pixel(nan, 3, 5)}).at(0, 0, 5)));
}

TEST_CASE("what has no covariance of this kind is refused") {
    image<> three({2, 1}, 3), one({2, 1}, 1), six({2, 1}, 6), small({1, 1}, 6);
    const source a(three.view()), b(one.view());
    CHECK_THROWS_WITH(covariance_of_renders(std::span(&b, 1), six.view()), Catch::Contains("2x1 with 1 channels"));
    CHECK_THROWS_WITH(covariance_of_renders(std::span(&a, 1), small.view()), Catch::Contains("as 1x1 with 6"));
    CHECK_THROWS_WITH(covariance_of_renders({}, six.view()), Catch::Contains("no renders"));
}
