// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/light.hpp>

#include <support/catch.hpp>

using namespace winnow::simulate;

static_assert(light_shape<quad> && light_shape<ellipsoid> && !light_shape<disc>);

TEST_CASE("the densities of light samples are those of their directions") {
    // Averaged over directions that are even over the sphere, a density is 1 / (4 pi); a light sample of density p
    // counts the light's solid angle as the mean of 1 / p.
    const quad window({-1, -1, 2}, {0, 2, 0}, {2, 0, 0});
    const ellipsoid ball = sphere({0.5, 0.3, 2}, 0.7);
    const auto solid_angle = [](const auto& light) {
        double sum = 0;
        const int n = 400;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const light_sample s = sample_light(light, vec3::Zero(), {(i + 0.5) / n, (j + 0.5) / n});
                sum += 1 / s.pdf;
            }
        return sum / (n * n);
    };
    // A square of side 2 at distance 2: 4 asin(1 / (1 + 4)).
    CHECK(solid_angle(window) == Approx(4 * std::asin(1.0 / 5)).epsilon(1e-4));
    CHECK(solid_angle(ball) == Approx(2 * pi * (1 - std::sqrt(1 - 0.49 / 4.34))).epsilon(1e-9));
    for (const vec2& u : {vec2(0.1, 0.7), vec2(0.9, 0.2), vec2(0.5, 0.5)}) {
        const light_sample s = sample_light(window, vec3::Zero(), u);
        CHECK(window.intersect({vec3::Zero(), s.direction}, 0) == Approx(s.distance));
        CHECK(light_pdf(window, {vec3::Zero(), s.direction}, s.distance) == Approx(s.pdf));
        const light_sample b = sample_light(ball, vec3::Zero(), u);
        CHECK(ball.intersect({vec3::Zero(), b.direction}, 0) == Approx(b.distance));
        CHECK(light_pdf(ball, {vec3::Zero(), b.direction}, b.distance) == Approx(b.pdf));
    }
    // From behind, a quad is dark.
    CHECK(sample_light(window, {0, 0, 5}, {0.5, 0.5}).pdf == 0);
    CHECK(sample_light(ball, {0.5, 0.3, 2.1}, {0.5, 0.5}).pdf == 0);  // from inside
}
