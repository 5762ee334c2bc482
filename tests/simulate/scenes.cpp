// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The built-in scenes: each shows exactly the effects that it declares, and the one that is known in closed form looks
// as it must.
#include <algorithm>
#include <support/catch.hpp>
#include <support/simulated.hpp>
#include <tuple>
#include <winnow/simulate/scenes/balls.hpp>
#include <winnow/simulate/scenes/cars.hpp>
#include <winnow/simulate/scenes/chess.hpp>
#include <winnow/simulate/scenes/conference.hpp>
#include <winnow/simulate/scenes/fireflies.hpp>
#include <winnow/simulate/scenes/fog.hpp>
#include <winnow/simulate/scenes/foliage.hpp>
#include <winnow/simulate/scenes/mirror.hpp>
#include <winnow/simulate/scenes/orbit.hpp>
#include <winnow/simulate/scenes/planes.hpp>
#include <winnow/simulate/scenes/ramp.hpp>
#include <winnow/simulate/scenes/rings.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

using all_scenes =
    std::tuple<scenes::balls, scenes::cars, scenes::chess, scenes::conference, scenes::fireflies, scenes::fog,
               scenes::foliage, scenes::mirror, scenes::orbit, scenes::planes, scenes::ramp, scenes::rings>;

template <class Scene, class Test>
bool any_material(const Scene& s, const Test& test) {
    return std::any_of(s.materials.begin(), s.materials.end(), test);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a scene shows what it declares, and declares what it shows", "", all_scenes) {
    using shows = typename TestType::shows;
    const auto s = TestType::make();
    INFO(TestType::name());
    REQUIRE(s.camera_at);
    CHECK(shows::template has<effect::depth_of_field> == (s.camera_at(0).lens_radius > 0));
    CHECK(shows::template has<effect::frames> == (s.camera_at(0).eye != s.camera_at(1).eye));
    CHECK(shows::template has<effect::translation> ==
          std::any_of(s.objects.begin(), s.objects.end(), [](const motion& m) { return m.moves(); }));
    CHECK(shows::template has<effect::rotation> ==
          std::any_of(s.objects.begin(), s.objects.end(), [](const motion& m) { return m.turns(); }));
    CHECK(shows::template has<effect::texture> == any_material(s, [](const material& m) { return m.texture; }));
    CHECK(shows::template has<effect::bump> == any_material(s, [](const material& m) { return m.height; }));
    CHECK(shows::template has<effect::roughness_map> ==
          any_material(s, [](const material& m) { return m.roughness_map; }));
    CHECK(shows::template has<effect::mirror> == any_material(s, [](const material& m) { return m.is_mirror(); }));
    CHECK(shows::template has<effect::glossy> ==
          any_material(s, [](const material& m) { return m.is_specular() && !m.is_mirror(); }));
    CHECK(shows::template has<effect::fireflies> ==
          any_material(s, [](const material& m) { return m.selection != 1; }));
    CHECK(shows::template has<effect::medium> == (s.medium.extinction > 0));
    const bool lit = s.sky || any_material(s, [](const material& m) { return m.emits(); });
    CHECK(lit);
    if (!shows::template has<effect::area_light>) CHECK_FALSE(shows::template has<effect::global_illumination>);
    if (shows::template has<effect::caustics>) CHECK(shows::template has<effect::mirror>);
    CHECK_NOTHROW(world(s));
}

TEMPLATE_LIST_TEST_CASE("no surface gives more light than it gets, and no part of the sky is dark below zero", "",
                        all_scenes) {
    const auto s = TestType::make();
    for (const material& m : s.materials) {
        INFO(TestType::name() << ": " << m.name);
        CHECK((m.albedo + m.f0).maxCoeff() <= 1);
        CHECK((m.albedo.minCoeff() >= 0 && m.f0.minCoeff() >= 0 && m.emission.minCoeff() >= 0));
    }
    if (s.sky)
        for (int i = 0; i < 2000; ++i) {
            const double z = -1 + (i + 0.5) / 1000;
            CHECK(s.sky(polar_direction(z, 0.618034 * i)).minCoeff() >= 0);
        }
}

TEST_CASE("the ramp is what lens and shutter make of it, column by column") {
    const world w(scenes::ramp::make());
    const extent size{256, 192};
    const auto images =
        test::rendered<planes<color_t>>(w, size, {.samples = 8, .pattern = pattern::independent}).develop();
    for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < 3; ++c) {
            test::statistic column;
            for (int y = 0; y < size.height; ++y) column.add(images[color].at(x, y, c));
            INFO("column " << x << ", channel " << c << ": " << column);
            // Five standard errors: there are 768 of these, of which four would be passed by one in twenty.
            CHECK(std::abs(column.mean - scenes::ramp::expected(x)[c]) <= 5 * column.standard_error() + 1e-5);
        }
}
