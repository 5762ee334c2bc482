// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <limits>
#include <support/catch.hpp>
#include <support/scattered.hpp>
#include <winnow/image/plane.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("finite is what is neither NaN nor infinite") {
    for (const float x : {0.0f, -0.0f, 1e-45f, -3.4e38f}) CHECK(is_finite(x));
    for (const float x : {INFINITY, -INFINITY, NAN, -NAN}) CHECK(!is_finite(x));
}

TEST_CASE("a layer knows its memory, or that it has none") {
    image<> made = pattern({4, 3}, 3);
    const source layer = made.view();
    CHECK(layer);
    CHECK(!source{});
    CHECK(layer.size == extent{4, 3});
    CHECK(layer.channels == 3);
    CHECK(layer.type == scalar::float32);
    CHECK(layer == source(made.view()));
    CHECK(layer.channel(2).at(3, 1) == made.at(3, 1, 2));
    CHECK(layer.channel(2).channels == 1);
    CHECK(source(image<half>({1, 1}).view()).type == scalar::float16);
}

TEST_CASE("a bad pixel is the mean of its finite neighbours, by hand") {
    // 1 2 3
    // 4 x 6
    // 7 8 y
    float memory[] = {1, 2, 3, 4, NAN, 6, 7, 8, INFINITY};
    const source plane = planar(memory, {3, 3}, 1);
    CHECK(contained(plane, 0, 0) == 1);
    CHECK(contained(plane, 1, 1) == Approx((1 + 2 + 3 + 4 + 6 + 7 + 8) / 7.0));
    CHECK(contained(plane, 2, 2) == Approx((6 + 8) / 2.0));
    const float alone[] = {-INFINITY};
    CHECK(contained(planar(alone, {1, 1}, 1), 0, 0) == 0);
    // Large neighbours do not overflow on the way.
    const float large[] = {3e38f, 3e38f, NAN, 3e38f};
    CHECK(contained(planar(large, {2, 2}, 1), 0, 1) == 3e38f);
}
