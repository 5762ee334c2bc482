// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/cutoff.hpp>
#include <winnow/weight/exponential.hpp>
#include <winnow/weight/gaussian.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
const auto of_albedo = exponential(l2(albedo));
const auto of_depth = exponential(l2(depth));
const auto of_offset = gaussian(spatial, 1);
const auto cut = cutoff(spatial, 1);

/// Two pixels side by side, 0.5 apart in albedo and 0.25 in depth.
const auto albedo_weight = std::exp(-0.25), depth_weight = std::exp(-0.0625), offset_weight = std::exp(-0.5);
template <class Weight>
float weigh(const Weight& weight, int dy = 0) {
    neighbourhood<planes<albedo_t, depth_t>> around({2, 2});
    for (int y = 0; y < 2; ++y) {
        around.at(albedo, 1, y, 1) = 0.5f;
        around.at(depth, 1, y) = 0.25f;
    }
    return weight(around.pair(0, 0, 1, dy));
}
}  // namespace

// Three fold from the left.
static_assert(std::is_same_v<decltype(min(of_albedo, of_depth, cut)),
                             weight::min_of<weight::min_of<weight::exponential<distance::squared_difference<albedo_t>>,
                                                           weight::exponential<distance::squared_difference<depth_t>>>,
                                            weight::cutoff<distance::spatial>>>);
static_assert(
    std::is_same_v<decltype(of_albedo * of_depth * cut),
                   weight::product_of<weight::product_of<weight::exponential<distance::squared_difference<albedo_t>>,
                                                         weight::exponential<distance::squared_difference<depth_t>>>,
                                      weight::cutoff<distance::spatial>>>);
// Exponential weights stay exponential; a cutoff is none.
static_assert(exponential_weight<decltype(min(of_albedo, of_depth, of_offset))>);
static_assert(exponential_weight<decltype(of_albedo * of_depth * of_offset)>);
static_assert(!exponential_weight<decltype(min(of_albedo, cut))> && !exponential_weight<decltype(cut * of_albedo)>);
// A buffer that both operands read is read once.
static_assert(std::is_same_v<decltype(of_albedo * of_depth * of_albedo)::reads, planes<albedo_t, depth_t>>);

TEST_CASE("min is the smallest of its weights") {
    CHECK(weigh(min(of_albedo, of_depth)) == Approx(albedo_weight).epsilon(1e-6));
    CHECK(weigh(min(of_depth, of_albedo)) == Approx(albedo_weight).epsilon(1e-6));
    CHECK(weigh(min(of_depth, of_offset, of_albedo)) == Approx(offset_weight).epsilon(1e-6));
    CHECK(weigh(min(of_depth, cut)) == Approx(depth_weight).epsilon(1e-6));
    CHECK(weigh(min(cut, of_depth)) == Approx(depth_weight).epsilon(1e-6));
    CHECK(weigh(min(cut, of_depth), 1) == 0);
}

TEST_CASE("the product is the product") {
    CHECK(weigh(of_albedo * of_depth) == Approx(albedo_weight * depth_weight).epsilon(1e-6));
    CHECK(weigh(of_albedo * of_depth * of_offset) ==
          Approx(albedo_weight * depth_weight * offset_weight).epsilon(1e-6));
    CHECK(weigh(cut * of_albedo) == Approx(albedo_weight).epsilon(1e-6));
    CHECK(weigh(of_albedo * cut, 1) == 0);
}
