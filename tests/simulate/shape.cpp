// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/shape.hpp>

#include <random>
#include <support/catch.hpp>
#include <tuple>

using namespace winnow::simulate;

namespace {

using shapes = std::tuple<quad, disc, ellipsoid, triangle, frustum>;
const shapes examples{quad({-1, -1, 0.5}, {2, 0.3, 0}, {0, 2, 0.4}), disc({0.2, 0.1, 0}, {1, 2, 3}, 1.5),
                      ellipsoid({0.1, -0.2, 0.3}, {1, 0.5, 1.5}), triangle({-1, -1, 0}, {2, 0, 0.5}, {0, 2, -0.3}),
                      frustum({0, 0, -1}, {0.5, 0.2, 1}, 1, 0.4)};

/// Rays from a sphere of radius 5 towards points near the origin.
std::vector<ray> rays(int count) {
    std::mt19937 random(1);
    std::normal_distribution<double> gauss;
    std::vector<ray> all;
    for (int i = 0; i < count; ++i) {
        const vec3 from = 5 * vec3(gauss(random), gauss(random), gauss(random)).normalized();
        const vec3 to = 0.7 * vec3(gauss(random), gauss(random), gauss(random));
        all.push_back({from, (to - from).normalized()});
    }
    return all;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a point that a ray meets lies in the bounds, and the ray from there back meets nothing nearer",
                        "", shapes) {
    const auto& s = std::get<TestType>(examples);
    const bounds box = s.bounding();
    int met = 0;
    for (const ray& r : rays(2000)) {
        const double t = s.intersect(r, 0);
        if (t == infinity) continue;
        ++met;
        const vec3 p = r.at(t);
        CHECK(((p - box.low).array() > -1e-9).all());
        CHECK(((box.high - p).array() > -1e-9).all());
        // Seen from the point, the way to the origin of the ray is free.
        const double back = s.intersect({p, -r.direction}, 1e-9);
        CHECK((back == infinity || back > t - 1e-6 || back < 1e-6));
        // Beyond a far limit it is not met again at the same place.
        CHECK(s.intersect(r, t + 1e-6) > t + 1e-6);
    }
    CHECK(met > 100);
}

TEMPLATE_LIST_TEST_CASE("normal and tangent are of unit length and orthogonal, the tangent lies along the surface", "",
                        shapes) {
    const auto& s = std::get<TestType>(examples);
    for (const ray& r : rays(300)) {
        const double t = s.intersect(r, 0);
        if (t == infinity) continue;
        const surface_point at = s.at(r.at(t));
        CHECK(std::abs(at.normal.norm() - 1) < 1e-12);
        CHECK(std::abs(at.tangent.norm() - 1) < 1e-12);
        CHECK(std::abs(at.normal.dot(at.tangent)) < 1e-9);
        // A step along the tangent leaves the surface by the square of the step only.
        const double step = 1e-4;
        const ray above{r.at(t) + step * at.tangent + 0.1 * at.normal, -at.normal};
        const double down = s.intersect(above, 0);
        CHECK((down == infinity || std::abs(down - 0.1) < 1e-6));
    }
}

TEMPLATE_LIST_TEST_CASE("a ray in the plane of a shape or away from it does no harm", "", shapes) {
    const auto& s = std::get<TestType>(examples);
    for (const vec3& d : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0, 0, -1)})
        for (const vec3& o : {vec3(0, 0, 0), vec3(0, 0, 9), vec3(100, 100, 100)}) {
            const double t = s.intersect({o, d}, 1e-6);
            CHECK(!std::isnan(t));
            CHECK(t > 1e-6);
        }
}

TEST_CASE("hits worked by hand") {
    const ray down{{0.25, 0.5, 3}, {0, 0, -1}};
    CHECK(quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}).intersect(down, 0) == Approx(2));
    CHECK(quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}).at({0.25, 0.5, 1}).uv == vec2(0.25, 0.5));
    CHECK(quad({0.3, 0, 1}, {1, 0, 0}, {0, 1, 0}).intersect(down, 0) == infinity);
    CHECK(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).intersect(down, 0) == Approx(3));
    CHECK(triangle({0, 0, 0}, {0.7, 0, 0}, {0, 0.7, 0}).intersect(down, 0) == infinity);
    CHECK(disc({0, 0, 0}, {0, 0, 1}, 0.6).intersect(down, 0) == Approx(3));
    CHECK(disc({0, 0, 0}, {0, 0, 1}, 0.5).intersect(down, 0) == infinity);
    CHECK(sphere({0.25, 0.5, 0}, 1).intersect(down, 0) == Approx(2));
    CHECK(sphere({0.25, 0.5, 0}, 1).intersect(down, 2.5) == Approx(4));
    CHECK(sphere({0.25, 0.5, 0}, 1).intersect({{0.25, 0.5, 0}, {0, 0, 1}}, 0) == Approx(1));
    // A cone of slope 1/2 seen from the side at half its height: radius 0.75.
    const frustum cone({0, 0, 0}, {0, 0, 1}, 1, 0.5);
    CHECK(cone.intersect({{-3, 0, 0.5}, {1, 0, 0}}, 0) == Approx(2.25));
    CHECK(cone.intersect({{-3, 0, 0.5}, {1, 0, 0}}, 2.5) == Approx(3.75));
    CHECK(cone.intersect({{-3, 0, 1.5}, {1, 0, 0}}, 0) == infinity);
    CHECK(cone.at({-0.75, 0, 0.5}).normal.isApprox(vec3(-1, 0, 0.5).normalized(), 1e-12));
    CHECK(cone.at({0, 0.75, 0.5}).uv.y() == Approx(0.5));
}

TEST_CASE("a sphere is met where it is, from very far away") {
    const double distance = 1e6;
    const ray r{{-distance, 0, 0.999}, {1, 0, 0}};
    // sqrt(1 - 0.999^2) before the centre; the naive discriminant would be off by 1e12 ulps.
    CHECK(std::abs(sphere({0, 0, 0}, 1).intersect(r, 0) - (distance - std::sqrt(1 - 0.999 * 0.999))) < 1e-6);
}
