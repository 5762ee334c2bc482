// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/combine.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/distance/squared_difference.hpp>

using namespace winnow;
using namespace winnow::test;
using winnow::distance::max_of, winnow::distance::squared_difference, winnow::distance::sum_of;

// Three fold from the left.
static_assert(
    std::is_same_v<decltype(max(l2(albedo), l2(depth), spatial)),
                   max_of<max_of<squared_difference<albedo_t>, squared_difference<depth_t>>, distance::spatial>>);
static_assert(
    std::is_same_v<decltype(l2(albedo) + l2(depth) + spatial),
                   sum_of<sum_of<squared_difference<albedo_t>, squared_difference<depth_t>>, distance::spatial>>);
// A buffer that both operands read is read once.
static_assert(std::is_same_v<decltype(max(l2(albedo), l2(depth), l2(albedo)))::reads, planes<albedo_t, depth_t>>);

TEST_CASE("max is the largest of its distances, + their sum") {
    neighbourhood<planes<albedo_t, depth_t>> around({3, 1});
    around.at(albedo, 1, 0, 2) = 3;  // albedo: 9 apart
    around.at(depth, 1, 0) = 2;      // depth: 4 apart
    const auto near = around.pair(0, 0, 1, 0), far = around.pair(1, 0, 1, 0);
    CHECK(max(l2(albedo), l2(depth))(near) == 9);
    CHECK(max(l2(depth), l2(albedo))(near) == 9);
    CHECK((l2(albedo) + l2(depth))(near) == 13);
    CHECK(max(spatial, l2(depth), l2(albedo))(far) == 9);
    CHECK((spatial + l2(depth) + l2(albedo))(far) == 14);
}
