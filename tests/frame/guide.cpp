// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <array>
#include <support/catch.hpp>
#include <support/scattered.hpp>
#include <winnow/frame/path_guides.hpp>

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

static_assert(covariance_of<position_t>::channels == 6 && covariance_of<motion_vector_t>::channels == 3 &&
              covariance_of<depth_t>::channels == 1);
static_assert(std::is_same_v<decltype(covariance(rest_position)), covariance_of<rest_position_t>>);
static_assert(is_point<position_t> && is_point<rest_position_t> && is_point<position2_t>);
static_assert(!is_point<normal_t> && !is_point<depth_t> && !is_point<mine::curvature_t>);
static_assert(pixel_value<float> && pixel_value<int> && pixel_value<std::array<double, 3>> && pixel_value<float[3]>);
static_assert(!pixel_value<mine::curvature_t>);

TEST_CASE("every buffer has a name of its own, as messages and files spell it") {
    CHECK(color.name() == "color");
    CHECK(mine::curvature.name() == "curvature");
    CHECK(variance(depth).name() == "depth.variance");
    CHECK(first_half(color).name() == "color.halfA");
    CHECK(second_half(color).name() == "color.halfB");
    CHECK(variance(first_half(color)).name() == "color.halfA.variance");
    CHECK(gradient_of<albedo_t>::name() == "albedo.gradient");
    CHECK(covariance(position).name() == "position.covariance");
    CHECK(motion_vector.name() == "motion_vector");
}

TEST_CASE("a guide is bound to memory without a copy") {
    const image<> made = pattern({4, 3}, 3);
    const bound<albedo_t> layer = albedo = made.view();
    CHECK(layer.layer == source(made.view()));
    const bound<variance_of<albedo_t>> noise = variance(albedo) = made.view();
    CHECK(noise.layer.at(2, 1) == made.at(2, 1));
}

TEST_CASE("a guide takes the value of one sample, whatever the renderer holds it in") {
    struct vector {
        half v[3];
        half operator[](int i) const { return v[i]; }
    };
    const vector n{{half(0.5f), half(-2), half(3)}};
    const auto given = normal = n;
    static_assert(std::is_same_v<decltype(given)::guide, normal_t>);
    CHECK(given[1] == -2.0);
    CHECK((depth = 7)[0] == 7.0);
    CHECK((color = 0.25f)[2] == 0.25);  // grey
    const double p[3] = {1e8 + 0.5, 0, 0};
    CHECK((position = p)[0] == 1e8 + 0.5);  // still a double
    CHECK((mine::curvature = std::array{1.0f, 2.0f})[1] == 2.0);
}
