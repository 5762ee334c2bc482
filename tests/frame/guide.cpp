// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/scattered.hpp>
#include <winnow/frame/guide.hpp>

using namespace winnow;
using namespace winnow::test;

namespace mine {
WINNOW_GUIDE(curvature, 2);  // a guide of the user's own, in a namespace of the user's own
}

static_assert(guide<mine::curvature_t> && mine::curvature.channels == 2);
static_assert(guide<color_t> && guide<variance_of<half_a<color_t>>> && guide<gradient_of<depth_t>>);
static_assert(!guide<int>);
static_assert(variance_of<depth_t>::channels == 1 && half_b<color_t>::channels == 3);
static_assert(std::is_same_v<decltype(variance(first_half(color))), variance_of<half_a<color_t>>>);

TEST_CASE("every buffer has a name of its own, as messages and files spell it") {
    CHECK(color.name() == "color");
    CHECK(mine::curvature.name() == "curvature");
    CHECK(variance(depth).name() == "depth.variance");
    CHECK(first_half(color).name() == "color.halfA");
    CHECK(second_half(color).name() == "color.halfB");
    CHECK(variance(first_half(color)).name() == "color.halfA.variance");
    CHECK(gradient_of<albedo_t>::name() == "albedo.gradient");
}

TEST_CASE("a guide is bound to memory without a copy") {
    const image<> made = pattern({4, 3}, 3);
    const bound<albedo_t> layer = albedo = made.view();
    CHECK(layer.layer == source(made.view()));
    const bound<variance_of<albedo_t>> noise = variance(albedo) = made.view();
    CHECK(noise.layer.at(2, 1) == made.at(2, 1));
}
