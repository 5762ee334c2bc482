// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/window/disk.hpp>

using namespace winnow;

TEST_CASE("a disk of radius 2 is a square of 3 with four tips") {
    constexpr window::disk disk{.radius = 2};
    const int half[] = {0, 1, 2, 1, 0};
    for (int dy = -2; dy <= 2; ++dy) CHECK(disk.half_width(dy) == half[dy + 2]);
    CHECK(disk.half_width(3) < 0);
    CHECK(area(disk) == 13);
}

// The number of lattice points in a circle: Gauss's circle problem.
static_assert(area(window::disk{.radius = 0}) == 1);
static_assert(area(window::disk{.radius = 1}) == 5);
static_assert(area(window::disk{.radius = 3}) == 29);
static_assert(area(window::disk{.radius = 5}) == 81);
static_assert(area(window::disk{.radius = 10}) == 317);

TEST_CASE("a disk is right where the square of its radius is no int") {
    CHECK(window::disk{.radius = 50000}.half_width(0) == 50000);
    CHECK(window::disk{.radius = 50000}.half_width(-30000) == 40000);
}

TEST_CASE("a disk refuses a negative radius by name") {
    CHECK_NOTHROW(window::disk{.radius = 0}.check());
    CHECK_THROWS_WITH(window::disk{.radius = -3}.check(), "window: radius is -3, it must be 0 or more");
}
