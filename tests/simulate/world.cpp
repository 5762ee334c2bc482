// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/world.hpp>

#include <support/folder.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

using everything = effects<effect::area_light, effect::translation, effect::rotation, effect::texture, effect::bump,
                           effect::roughness_map, effect::glossy, effect::mirror, effect::fireflies>;
template <class Effects>
using any_scene = scene<Effects, quad, ellipsoid, triangle>;

/// Why a scene with this material, put on a quad, is refused.
template <class Effects>
std::string refusal(const material& m) {
    any_scene<Effects> s;
    s.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), s.add(m));
    return test::message_of([&] { world w(s); });
}

ray down(double x, double y) { return {{x, y, 5}, {0, 0, -1}}; }

}  // namespace

TEST_CASE("what a scene has but does not declare is refused by name") {
    const auto white = [](const place&) { return grey(1); };
    const auto flat = [](const place&) { return 0.1; };
    CHECK(refusal<effects<>>({.name = "paint", .albedo = grey(0.5)}).empty());
    CHECK(refusal<effects<>>({.name = "paint", .texture = white}) ==
          "material paint has a texture, but the scene does not declare the effect texture");
    CHECK(refusal<effects<>>({.name = "paint", .height = flat}) ==
          "material paint has bumps, but the scene does not declare the effect bump");
    CHECK(refusal<effects<effect::glossy>>({.name = "tin", .f0 = grey(0.9), .roughness_map = flat}) ==
          "material tin has a roughness map, but the scene does not declare the effect roughness_map");
    CHECK(refusal<effects<effect::glossy>>({.name = "tin", .f0 = grey(0.9)}) ==
          "material tin is a mirror, but the scene does not declare the effect mirror");
    CHECK(refusal<effects<>>({.name = "pane", .ior = 1.5}) ==
          "material pane is a mirror, but the scene does not declare the effect mirror");
    CHECK(refusal<effects<effect::mirror>>({.name = "tin", .f0 = grey(0.9), .roughness = 0.1}) ==
          "material tin is glossy, but the scene does not declare the effect glossy");
    CHECK(refusal<effects<>>({.name = "lamp", .emission = grey(1), .selection = 3}) ==
          "material lamp is chosen unlike others, but the scene does not declare the effect fireflies");

    any_scene<effects<>> moves;
    moves.add(motion{.velocity = {1, 0, 0}});
    CHECK_THROWS_WITH(world(moves), "an object moves, but the scene does not declare the effect translation");
    any_scene<effects<>> turns;
    turns.add(motion{.spin = 1});
    CHECK_THROWS_WITH(world(turns), "an object turns, but the scene does not declare the effect rotation");
    any_scene<effects<>> foggy;
    foggy.medium.extinction = 1;
    CHECK_THROWS_WITH(world(foggy), "there is a medium, but the scene does not declare the effect medium");
}

TEST_CASE("parts without a material and lamps that cannot be sampled are refused") {
    any_scene<everything> s;
    s.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 3);
    CHECK_THROWS_WITH(world(s), "a part is of material 3, there are 0");
    const int lamp = s.add(material{.name = "lamp", .emission = grey(1)});
    s.parts.clear();
    s.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), lamp, 2);
    CHECK_THROWS_WITH(world(s), "a part is of object 2, there are 1");
    s.parts.clear();
    s.add(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), lamp);
    CHECK_THROWS_WITH(world(s), "material lamp emits from a shape that is neither a quad nor a sphere");
    s.parts.clear();
    s.add(ellipsoid({0, 0, 0}, {1, 1, 2}), lamp);
    CHECK_THROWS_WITH(world(s), "material lamp emits from a shape that is neither a quad nor a sphere");
    s.parts.clear();
    s.add(sphere({0, 0, 0}, 1), lamp, s.add(motion{.velocity = {1, 0, 0}}));
    CHECK_THROWS_WITH(world(s), "material lamp emits and moves, which is not supported");
}

TEST_CASE("the nearest part is met, at the time of the ray") {
    any_scene<everything> s;
    const int grey_paint = s.add(material{.name = "paint", .albedo = grey(0.5)});
    s.add(quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}), grey_paint);
    s.add(sphere({0, 0, 1}, 0.5), grey_paint, s.add(motion{.velocity = {2, 0, 0}}));
    const world w(s);
    CHECK(w.meet(down(0, 0), 0).part == 1);
    CHECK(w.meet(down(0, 0), 0).distance == Approx(3.5));
    CHECK(w.meet(down(0, 0), 0.5).part == 0);
    CHECK(w.meet(down(1, 0), 0.5).part == 1);
    CHECK_FALSE(w.meet(down(9, 0), 0));
    CHECK(w.occluded(down(0, 0), 0, 5));
    CHECK_FALSE(w.occluded(down(0, 0), 0, 3.5));  // only up to the sphere itself
    CHECK_FALSE(w.occluded(down(0, 0), 0.5, 5));
    const surface met = w.at(down(1.2, 0), w.meet(down(1.2, 0), 0.5), 0.5);
    CHECK(met.rest.isApprox(met.position - vec3(1, 0, 0), 1e-12));
    CHECK(met.object == 1);
    CHECK(w.carried(1, met.rest, 0.5).isApprox(met.position, 1e-12));
}

TEST_CASE("maps are read where the surface rests, and normals face the viewer") {
    any_scene<everything> s;
    material m{.name = "painted", .albedo = grey(0.5), .f0 = grey(0.1), .roughness = 0.9};
    m.texture = [](const place& p) { return rgb(p.uv.x(), p.uv.y(), p.rest.x()); };
    m.roughness_map = [](const place& p) { return p.uv.x(); };
    m.height = [](const place& p) { return 0.5 * p.rest.x(); };  // a slope of 1/2 along x
    s.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), s.add(m), s.add(motion{.velocity = {0, 1, 0}}));
    const world w(s);
    const ray r = down(0.25, 1.5);
    const surface met = w.at(r, w.meet(r, 1), 1);
    CHECK((met.albedo - rgb(0.125, 0.25, 0.125)).abs().maxCoeff() < 1e-9);
    CHECK(met.roughness == Approx(0.25));
    CHECK(met.facing == vec3(0, 0, 1));
    CHECK(met.shading.isApprox(vec3(-0.5, 0, 1).normalized(), 1e-6));
    // From below, everything is turned over; a bump that would face away is left out.
    const ray up{{0.25, 1.5, -5}, {0, 0, 1}};
    const surface back = w.at(up, w.meet(up, 1), 1);
    CHECK(back.facing == vec3(0, 0, -1));
    CHECK(back.outward == vec3(0, 0, 1));
    const ray grazing{{0.24, 1.5, -0.001}, vec3(1, 0, 0.1).normalized()};
    const surface flat = w.at(grazing, w.meet(grazing, 1), 1);
    CHECK(flat.shading == flat.facing);
}

TEST_CASE("lamps shine from the side of their normal, and are chosen as the scene says") {
    any_scene<everything> s;
    s.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), s.add(material{.name = "lamp", .emission = rgb(1, 2, 3)}));
    s.add(sphere({3, 0, 0}, 0.5), s.add(material{.name = "bulb", .emission = grey(1), .selection = 2}));
    s.sky = [](const vec3&) { return grey(0.1); };
    const world w(s);
    REQUIRE(w.lights() == 3);
    CHECK(w.sky_light() == 2);
    CHECK(w.choice_probability(0) == 0.25);
    CHECK(w.choice_probability(1) == 0.5);
    CHECK(w.choose(0.24) == 0);
    CHECK(w.choose(0.26) == 1);
    CHECK(w.choose(0.9999) == 2);
    CHECK((w.at(down(0.5, 0.5), w.meet(down(0.5, 0.5), 0), 0).emission == rgb(1, 2, 3)).all());
    const ray up{{0.5, 0.5, -5}, {0, 0, 1}};
    CHECK((w.at(up, w.meet(up, 0), 0).emission == 0).all());
    CHECK((w.emission(2, vec3::UnitZ()) == 0.1).all());
    // The sky by the cosine of a surface, or evenly where there is none.
    const light_sample above = w.sample(2, vec3::Zero(), vec3::UnitZ(), {0.3, 0.4});
    CHECK(above.pdf == Approx(above.direction.z() / pi));
    CHECK(w.pdf(2, vec3::UnitZ(), {vec3::Zero(), above.direction}, infinity) == Approx(0.25 * above.pdf));
    CHECK(w.sample(2, vec3::Zero(), vec3::Zero(), {0.3, 0.4}).pdf == Approx(1 / (4 * pi)));
}
