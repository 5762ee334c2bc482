// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <vector>
#include <winnow/image/border.hpp>

using namespace winnow;

namespace {
std::vector<int> indices(border rule, int size, int from, int to) {
    std::vector<int> all;
    for (int i = from; i < to; ++i) all.push_back(resolve(rule, i, size));
    return all;
}
}  // namespace

TEST_CASE("inside, every rule gives the pixel itself") {
    for (const border rule : {border::clip, border::mirror, border::clamp})
        CHECK(indices(rule, 3, 0, 3) == std::vector{0, 1, 2});
}

TEST_CASE("outside, clip has nothing") {
    CHECK(indices(border::clip, 3, -2, 5) == std::vector{-1, -1, 0, 1, 2, -1, -1});
    CHECK(resolve(border::clip, 1000000, 1) == -1);
}

TEST_CASE("outside, mirror reflects without repeating the edge, again and again") {
    CHECK(indices(border::mirror, 3, -7, 10) == std::vector{1, 2, 1, 0, 1, 2, 1, 0, 1, 2, 1, 0, 1, 2, 1, 0, 1});
    CHECK(indices(border::mirror, 4, -4, 8) == std::vector{2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1});
    CHECK(indices(border::mirror, 2, -3, 5) == std::vector{1, 0, 1, 0, 1, 0, 1, 0});
    CHECK(indices(border::mirror, 1, -3, 4) == std::vector(7, 0));
}

TEST_CASE("outside, clamp repeats the edge") {
    CHECK(indices(border::clamp, 3, -2, 6) == std::vector{0, 0, 0, 1, 2, 2, 2, 2});
    CHECK(resolve(border::clamp, -1000000, 5) == 0);
    CHECK(resolve(border::clamp, 1000000, 5) == 4);
}
