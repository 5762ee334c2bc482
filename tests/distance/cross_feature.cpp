// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/cross_feature.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
template <class G>
using feature = planes<G, variance_of<G>, gradient_of<G>>;

/// The distance of two depths at k = 0.5 and tau = 0.01.
float depths_apart(float p, float q, float var_p, float var_q, float gradient) {
    neighbourhood<feature<depth_t>> around({2, 1});
    around.at(depth, 0, 0) = p;
    around.at(depth, 1, 0) = q;
    around.at(variance(depth), 0, 0) = var_p;
    around.at(variance(depth), 1, 0) = var_q;
    around.at(gradient_of<depth_t>{}, 0, 0) = gradient;
    around.at(gradient_of<depth_t>{}, 1, 0) = 1e6f;  // only the contrast at p counts
    return cross(depth, {.k = 0.5f, .tau = 0.01f})(around.pair(0, 0, 1, 0));
}
}  // namespace

TEST_CASE("the feature distance, by hand, with each of its three floors") {
    // (1 - (.1 + .1)) / (.25 max(.01, .1, .2)) = .8 / .05
    CHECK(depths_apart(1, 2, 0.1f, 0.3f, 0.2f) == Approx(16).epsilon(1e-6));
    // The contrast below the noise: .8 / (.25 * .1)
    CHECK(depths_apart(1, 2, 0.1f, 0.3f, 0.05f) == Approx(32).epsilon(1e-6));
    // Both below tau: (1 - (.002 + .001)) / (.25 * .01)
    CHECK(depths_apart(1, 2, 0.002f, 0.001f, 0.005f) == Approx(398.8).epsilon(1e-6));
    // Noise explains more than is seen: (0 - (.1 + .1)) / (.25 * .1)
    CHECK(depths_apart(2, 2, 0.1f, 0.3f, 0) == Approx(-8).epsilon(1e-6));
}

TEST_CASE("channels are one vector: its squared difference over its noise or its contrast, whichever is more") {
    neighbourhood<feature<normal_t>> around({2, 1});
    const float q[] = {0.4f, 0.2f, -0.6f}, noise[] = {0.01f, 0, 0.03f}, contrast[] = {0, 0.05f, 0};
    for (int c = 0; c < 3; ++c) {
        around.at(normal, 1, 0, c) = q[c];
        around.at(variance(normal), 0, 0, c) = noise[c];
        around.at(gradient_of<normal_t>{}, 0, 0, c) = contrast[c];
    }
    // (.16 + .04 + .36 - .01 - .03) / (.25 max(.04, .05))
    CHECK(cross(normal, {.k = 0.5f})(around.pair(0, 0, 1, 0)) == Approx(0.52 / 0.0125).epsilon(1e-5));
    // A quarter more noise in the first channel: (.56 - .05 - .03) / (.25 * .08)
    around.at(variance(normal), 0, 0, 0) = 0.05f;
    CHECK(cross(normal, {.k = 0.5f})(around.pair(0, 0, 1, 0)) == Approx(0.48 / 0.02).epsilon(1e-5));
}

TEST_CASE("where there is neither noise nor contrast, tau is the unit") {
    neighbourhood<feature<normal_t>> around({2, 1});
    const float q[] = {0.1f, 0.2f, -0.3f};
    for (int c = 0; c < 3; ++c) around.at(normal, 1, 0, c) = q[c];
    // (.01 + .04 + .09) / (.36 * 1e-3)
    CHECK(cross(normal)(around.pair(0, 0, 1, 0)) == Approx(0.14 / 0.00036).epsilon(1e-5));
}

TEST_CASE("numbers that cross_feature cannot use are refused by name") {
    CHECK_NOTHROW(cross(albedo).check());
    CHECK_THROWS_WITH(cross(albedo, {.k = -1}).check(), Catch::Contains("cross_feature: k is -1.0"));
    CHECK_THROWS_WITH(cross(albedo, {.k = INFINITY}).check(), Catch::Contains("cross_feature: k is inf"));
    CHECK_THROWS_WITH(cross(albedo, {.tau = 0}).check(),
                      Catch::Contains("cross_feature: tau is 0") && Catch::Contains("between 1e-30 and 1e10"));
}
