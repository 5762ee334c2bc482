// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/sbf_2012_adaptive.hpp>
#include "support/catch.hpp"

using namespace winnow;

TEST_CASE("the sampling density of SBF, worked by hand") {
    // Three pixels, two channels.
    const float f[] = {1, 0, 3, 2, 0, 3}, e[] = {0.3f, 0.01f, -2, -0.1f, -0.02f, -2}, v[] = {0.2f, 0, 1, 0.4f, 0.1f, 1};
    const float s[] = {9, 3, 3}, n[] = {4, 9, 4};
    const extent size{3, 1};
    const paper::filter_outcome of{.filtered = planar(f, size, 2),
                                   .squared_error = planar(e, size, 2),
                                   .weights = planar(s, size, 1),
                                   .samples = planar(n, size, 1)};
    const image<float> rho = paper::sbf_sampling_density{.epsilon = 0.5f}(of, planar(v, size, 2));
    // ((0.3 - 0.1) / 2 + (0.2 + 0.4) / 2) / ((1 + 4) / 2 + 0.5) / (1 + 4)
    CHECK(rho.at(0, 0) == Approx(0.4 / 3 / 5).epsilon(1e-6));
    // ((0.01 - 0.02) / 2 + 0.05) / 0.5 / 10
    CHECK(rho.at(1, 0) == Approx(0.045 / 0.5 / 10).epsilon(1e-6));
    CHECK(rho.at(2, 0) == 0);  // an error far below 0
}

TEST_CASE("the sampling density of SBF refuses what does not fit") {
    const float zeros[8] = {};
    const auto plane = [&](int width, int channels) { return source(planar(zeros, {width, 1}, channels)); };
    const paper::filter_outcome of{plane(2, 3), plane(2, 3), plane(2, 1), plane(2, 1)};
    CHECK_THROWS_WITH(paper::sbf_sampling_density{}(of, plane(1, 3)), Catch::Contains("the variance is 1x1"));
    CHECK_THROWS_WITH(paper::sbf_sampling_density{.epsilon = 0}(of, plane(2, 3)), Catch::Contains("epsilon is 0"));
}
