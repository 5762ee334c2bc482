// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/effect.hpp>

#include <support/catch.hpp>
#include <winnow/frame/sample.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

using plain = effects<effect::texture, effect::area_light>;
using all =
    effects<effect::depth_of_field, effect::translation, effect::rotation, effect::camera_motion, effect::area_light,
            effect::glossy, effect::mirror, effect::caustics, effect::texture, effect::bump, effect::roughness_map,
            effect::medium, effect::global_illumination, effect::frames, effect::fireflies>;

template <class E>
inline constexpr int floats = E::gives::count;

}  // namespace

// What is always there: colour, albedo, normal, position, rest position, emission (3 each), depth, view depth, image
// point.
static_assert(floats<effects<>> == 6 * 3 + 1 + 1 + 2);
static_assert(sizeof(sample<effects<>::gives>) == 4 * floats<effects<>>);
// A light adds visibility, a point on it, the BRDF, the direct diffuse part; texture adds nothing.
static_assert(sizeof(sample<plain::gives>) == 4 * (floats<effects<>> + 1 + 2 + 3 + 3));
static_assert(!sample<plain::gives>::has(lens_point) && !sample<plain::gives>::has(shutter_time) &&
              !sample<plain::gives>::has(position2) && !sample<plain::gives>::has(light_point2));
static_assert(sizeof(sample<effects<effect::depth_of_field>::gives>) == 4 * (floats<effects<>> + 2));
static_assert(sizeof(sample<effects<effect::translation, effect::rotation, effect::camera_motion>::gives>) ==
              4 * (floats<effects<>> + 1));

// How many random numbers are drawn.
static_assert(effects<>::camera_numbers == 2 && effects<>::vertex_numbers == 0);
static_assert(plain::camera_numbers == 2 && plain::vertex_numbers == 6);
static_assert(effects<effect::depth_of_field>::camera_numbers == 4);
static_assert(effects<effect::translation, effect::rotation>::camera_numbers == 3);
static_assert(effects<effect::mirror>::vertex_numbers == 2);
static_assert(all::camera_numbers == 5 && all::vertex_numbers == 8);

static_assert(all::has<effect::bump> && !plain::has<effect::bump>);
static_assert(std::is_same_v<plain::without<effect::texture>, effects<effect::area_light>>);
static_assert(std::is_same_v<plain::without<effect::bump>, plain>);
static_assert(std::is_same_v<effects<effect::bump>::without<effect::bump>, effects<>>);

static_assert(!effect_policy<draw::lens>);
static_assert(effect_policy<effect::medium>);

TEST_CASE("dimensions have slots of their own, and pairs begin at an even one") {
    std::vector<int> camera, vertex;
    [&]<class... D>(dimensions<D...>) {
        (
            [&] {
                std::vector<int>& slots = D::at_vertex ? vertex : camera;
                if (D::count == 2) CHECK(D::slot % 2 == 0);
                for (int i = 0; i < D::count; ++i) {
                    CHECK(D::slot + i < slots_per_vertex);
                    CHECK(std::find(slots.begin(), slots.end(), D::slot + i) == slots.end());
                    slots.push_back(D::slot + i);
                }
            }(),
            ...);
    }(all_dimensions{});
    CHECK(camera.size() == std::size_t{all::camera_numbers});
    CHECK(vertex.size() == std::size_t{all::vertex_numbers});
}

TEST_CASE("effects are called by their names") {
    CHECK(plain::names() == std::vector<std::string>{"texture", "area_light"});
}
