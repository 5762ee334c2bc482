// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/camera.hpp>

#include <support/catch.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

const camera tilted{.eye = {1, -2, 3}, .target = {0, 4, 1}, .field_of_view = 50, .lens_radius = 0.2, .focus = 3};
constexpr extent size{64, 48};

}  // namespace

TEST_CASE("the middle of the image looks at the target, its right edge by half the field of view") {
    const view v(tilted, size);
    const vec3 axis = (tilted.target - tilted.eye).normalized();
    CHECK(v.through({32, 24}).direction.isApprox(axis, 1e-12));
    CHECK(std::acos(v.through({64, 24}).direction.dot(axis)) == Approx(25 * pi / 180));
    CHECK(v.through({32, 0}).direction.z() > axis.z());  // up is up
    const camera north{.eye = {0, 0, 0}, .target = {0, 1, 0}};
    CHECK(view(north, size).through({64, 24}).direction.x() > 0);  // and east is right
}

TEST_CASE("what a ray meets is projected onto the image point that it came from") {
    const view v(tilted, size);
    for (const vec2& image : {vec2(0.3, 0.2), vec2(63.1, 12.5), vec2(31, 47.9)}) {
        const ray r = v.through(image);
        CHECK((v.project(r.at(7.3)) - image).norm() < 1e-9);
        CHECK(v.depth(r.at(2)) == Approx(2 * r.direction.dot((tilted.target - tilted.eye).normalized())));
    }
}

TEST_CASE("a point out of focus spreads over a circle of radius R |1/z_f - 1/z| f") {
    const view v(tilted, size);
    const double f = 32 / std::tan(25 * pi / 180);  // focal length in pixels
    const vec2 image(20.5, 30.25);
    for (const double depth : {1.0, 2.0, 3.0, 5.0, 50.0}) {
        const vec3 axis = (tilted.target - tilted.eye).normalized();
        const double expected = tilted.lens_radius * std::abs(1 / tilted.focus - 1 / depth) * f;
        for (double angle = 0; angle < 6; ++angle) {
            const ray r = v.from_lens(image, {std::cos(angle), std::sin(angle)});
            // Where the ray is at that depth, seen from the centre of the lens.
            const double t = (depth - v.depth(r.origin)) / r.direction.dot(axis);
            CHECK(std::abs((v.project(r.at(t)) - image).norm() - expected) < 1e-9);
        }
    }
}

TEST_CASE("a lens of radius 0 is a pinhole, bit by bit") {
    camera pinhole = tilted;
    pinhole.lens_radius = 0;
    const view v(pinhole, size);
    for (const vec2& image : {vec2(0.3, 0.2), vec2(63.1, 12.5)}) {
        CHECK(v.from_lens(image, {0.3, -0.8}).origin == v.through(image).origin);
        CHECK(v.from_lens(image, {0.3, -0.8}).direction == v.through(image).direction);
    }
}

TEST_CASE("the solid angles of all pixels are that of the image") {
    const view v(tilted, size);
    double sum = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) sum += v.solid_angle(v.through({x + 0.5, y + 0.5}).direction);
    // A rectangle of half sides a and b at distance 1.
    const double a = std::tan(25 * pi / 180), b = a * 48 / 64;
    CHECK(sum == Approx(4 * std::asin(a * b / std::sqrt((1 + a * a) * (1 + b * b)))).epsilon(1e-3));
}
