// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/archetype.hpp>
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
using seen = planes<depth_t, albedo_t>;
neighbourhood<seen> around({6, 5}, scales{});
}  // namespace

TEST_CASE("a pair reads every channel of every buffer at p and at q") {
    const auto pq = around.pair(2, 1, 3, 2);
    CHECK(pq.p(depth) == around.at(depth, 2, 1));
    CHECK(pq.q(depth) == around.at(depth, 5, 3));
    for (int c = 0; c < 3; ++c) {
        CHECK(pq.p(albedo, c) == around.at(albedo, 2, 1, c));
        CHECK(pq.q(albedo, c) == around.at(albedo, 5, 3, c));
    }
    CHECK(pq.dx() == 3);
    CHECK(pq.dy() == 2);
    static_assert(std::is_same_v<decltype(pq)::real, float>);
}

TEST_CASE("shifting moves both pixels and keeps the offset") {
    const auto shifted = around.pair(2, 3, 1, -1).shifted(-2, 1);
    CHECK(shifted.p(depth) == around.at(depth, 0, 4));
    CHECK(shifted.q(albedo, 2) == around.at(albedo, 1, 3, 2));
    CHECK(shifted.dx() == 1);
    CHECK(shifted.dy() == -1);
}

TEST_CASE("a pair is covered where both of its pixels exist") {
    around.covered(3, 3) = 0;
    CHECK(around.pair(2, 3, 1, 0).covered() == 0);
    CHECK(around.pair(3, 3, 1, 0).covered() == 0);
    CHECK(around.pair(2, 2, 1, 0).covered() == 1);
    CHECK(around.pair(2, 2, 1, 0).shifted(0, 1).covered() == 0);
    around.covered(3, 3) = 1;
}

TEST_CASE("what was worked out ahead is read from its place") {
    const float ahead[] = {1, 2, 3, 4};
    const float planes[8] = {};
    const pixel_pair<float, winnow::planes<>> pq(planes, planes, {}, 0, 0, {ahead + 1, 2});
    CHECK(pq.ahead(0) == 2);
    CHECK(pq.ahead(1) == 4);
}

TEST_CASE("double and archetype see the same pixels") {
    CHECK(around.pair<double>(2, 1, 1, 1).q(albedo, 1) == around.at(albedo, 3, 2, 1));
    CHECK(value_of(around.pair<archetype>(2, 1, 1, 1).q(albedo, 1)) == around.at(albedo, 3, 2, 1));
}
