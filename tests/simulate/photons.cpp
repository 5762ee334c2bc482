// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/photons.hpp>

#include <random>
#include <support/catch.hpp>
#include <support/statistics.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

using shows = effects<effect::area_light, effect::mirror, effect::caustics>;

template <class World>
std::vector<photon> shot(const World& w, int count) {
    std::vector<photon> all;
    for (int i = 0; i < count; ++i)
        if (photon p; trace_photon(w, 1, 0, i, p)) all.push_back(p);
    return all;
}

}  // namespace

TEST_CASE("the grid finds exactly the photons of the disc") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<photon> photons;
    for (int i = 0; i < 3000; ++i)
        photons.push_back({{u(random), u(random), i % 10 == 0 ? 0.2 : 0},
                           (i % 7 ? 1 : -1) * vec3::UnitZ(),
                           rgb(u(random) + 1, 1, 0)});
    const photon_map map(photons, 10000, 0.07);
    REQUIRE(map.size() == 3000);
    for (const double radius : {0.01, 0.1, 0.4})
        for (int i = 0; i < 30; ++i) {
            const vec3 p(u(random), u(random), 0);
            rgb power = grey(0);
            int count = 0;
            for (const photon& f : photons)
                if (f.position.z() == 0 && f.facing.z() > 0 && (f.position - p).norm() <= radius)
                    power += f.power, ++count;
            const photon_map::estimate e = map.at(p, vec3::UnitZ(), radius);
            const double share = 1 / (pi * radius * radius * 10000);
            CHECK(e.density == Approx(count * share));
            CHECK((e.irradiance - power * share).abs().maxCoeff() < 1e-9 * (1 + power.maxCoeff() * share));
        }
    CHECK(photon_map({}, 0, 1).at(vec3::Zero(), vec3::UnitZ(), 1).density == 0);
    CHECK(photon_map().at(vec3::Zero(), vec3::UnitZ(), 1).density == 0);
}

TEST_CASE("all power that leaves a lamp arrives where mirrors cannot lose it") {
    // A box with a diffuse ceiling and mirrors all around; the lamp on the ceiling looks down.
    scene<shows, quad> s;
    const int mirror = s.add(material{.name = "mirror", .f0 = grey(1)});
    const int ceiling = s.add(material{.name = "ceiling", .albedo = grey(0.5)});
    const int lamp = s.add(material{.name = "lamp", .emission = rgb(3, 2, 1)});
    s.add(quad({0, 0, 0}, {4, 0, 0}, {0, 4, 0}), mirror);
    s.add(quad({0, 0, 2}, {4, 0, 0}, {0, 4, 0}), ceiling);
    for (const auto& [corner, side] : {std::pair{vec3(0, 0, 0), vec3(4, 0, 0)},
                                       {vec3(0, 4, 0), vec3(4, 0, 0)},
                                       {vec3(0, 0, 0), vec3(0, 4, 0)},
                                       {vec3(4, 0, 0), vec3(0, 4, 0)}})
        s.add(quad(corner, side, {0, 0, 2}), mirror);
    s.add(quad({1.75, 1.75, 1.999}, {0, 0.5, 0}, {0.5, 0, 0}), lamp);
    s.bounces = 1000;
    const world w(s);
    const std::vector<photon> photons = shot(w, 4000);
    CHECK(photons.size() + 200 > 4000);  // all but those that come back to the lamp
    const double area = 0.25;
    for (const photon& p : photons) {
        CHECK((p.power - pi * area * rgb(3, 2, 1)).abs().maxCoeff() < 1e-9);
        CHECK(std::abs(p.position.z() - 2) < 1e-9);
    }
    const photon_map map(photons, 4000, 0.5);
    CHECK((map.power() / (pi * area * rgb(3, 2, 1)) - static_cast<double>(photons.size()) / 4000).abs().maxCoeff() <
          1e-9);
}

TEST_CASE(
    "a ring lit from afar shows a nephroid whose cusp lies where the mirror equation says, near half the radius") {
    // Rays from a distance D meet after reflection at the far side of a ring of radius 1 at 1/(D+1) + 1/x = 2.
    const double distance = 3;
    scene<shows, quad, frustum> s;
    const int ring = s.add(material{.name = "ring", .f0 = grey(1)});
    const int table = s.add(material{.name = "table", .albedo = grey(0.5)});
    const int lamp = s.add(material{.name = "lamp", .emission = grey(1)});
    s.add(frustum({0, 0, 0}, {0, 0, 0.5}, 1, 1), ring);
    s.add(quad({-30, -30, 0}, {60, 0, 0}, {0, 60, 0}), table);
    // Small, above the plane, and looking at the ring.
    const vec3 at(-distance, 0, 2), towards = vec3(distance, 0, -2).normalized();
    const basis b(towards);
    s.add(quad(at, 0.01 * b.s, 0.01 * b.t), lamp);
    const world w(s);

    // Along the axis the light is brightest at the cusp, as far as a band can tell: the arms of the cusp leave one that
    // is .008 wide to each side .02 behind it.
    std::vector<int> bins(100, 0);
    int inside = 0;
    for (const photon& p : shot(w, 4'000'000))
        if (std::abs(p.position.y()) < 0.008 && std::abs(p.position.x()) < 1) {
            ++bins[static_cast<std::size_t>((p.position.x() + 1) * 50)];
            ++inside;
        }
    REQUIRE(inside > 1000);
    const auto brightest = std::max_element(bins.begin(), bins.end()) - bins.begin();
    const double cusp = (static_cast<double>(brightest) + 0.5) / 50 - 1;
    const double expected = 1 - 1 / (2 - 1 / (distance + 1));
    INFO("brightest at " << cusp << ", expected " << expected);
    CHECK(std::abs(cusp - expected) < 0.03);
}

TEST_CASE("without lamps there are no photons") {
    photon p;
    scene<effects<effect::mirror, effect::caustics>, quad> unlit;
    unlit.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), unlit.add(material{.name = "lamp", .emission = grey(1)}));
    CHECK_FALSE(trace_photon(world(unlit), 1, 0, 0, p));
    scene<shows, quad> sky_only;
    sky_only.sky = [](const vec3&) { return grey(1); };
    CHECK_FALSE(trace_photon(world(sky_only), 1, 0, 0, p));
    scene<effects<effect::mirror, effect::caustics, effect::medium>, quad> foggy;
    foggy.medium.extinction = 1;
    CHECK_THROWS_WITH(world(foggy), "caustics in a medium are not simulated");
}

TEST_CASE("the time of a photon does not depend on where it goes") {
    // Up from the lamp to a mirror that moves towards -y, the way of the first coordinate of a direction, and down to
    // the floor: where the photons arrive, the mirror was at all times alike.
    scene<effects<effect::area_light, effect::mirror, effect::caustics, effect::translation>, quad> s;
    s.add(quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), s.add(material{.name = "floor", .albedo = grey(0.5)}));
    s.add(quad({-0.05, -0.05, 0.5}, {0.1, 0, 0}, {0, 0.1, 0}), s.add(material{.name = "lamp", .emission = grey(1)}));
    const int mirror = s.add(material{.name = "mirror", .f0 = grey(1)});
    // It covers y > 0 at the beginning and y > -1 at the end.
    s.add(quad({-9, 0, 1}, {18, 0, 0}, {0, 9, 0}), mirror, s.add(motion{.velocity = {0, -1, 0}}));
    const world w(s);
    test::statistic share;
    for (int i = 0; i < 100'000; ++i) {
        photon p;
        // Those that leave towards -y meet the plane of the mirror at a third of the distance at which they come down.
        const bool stored = trace_photon(w, 1, 0, i, p);
        if (stored && -p.position.y() > 0.6 && -p.position.y() < 0.9) share.add(1);
        else share.add(0);
    }
    // Cosine emission from height 0.5 to 1 and back: at x of the floor, x / 3 at the mirror; covered from time x / 3
    // on. The share that leaves towards the strip is found by counting with a mirror that covers everything.
    auto all = s;
    all.objects.back() = motion{.velocity = {0, 0, 0}};
    std::get<quad>(all.parts.back().shape) = quad({-9, -9, 1}, {18, 0, 0}, {0, 18, 0});
    const world covered(all);
    test::statistic expected;
    for (int i = 0; i < 100'000; ++i) {
        photon p;
        const bool stored = trace_photon(covered, 2, 0, i, p) && -p.position.y() > 0.6 && -p.position.y() < 0.9;
        expected.add(stored ? 1 + p.position.y() / 3 : 0);
    }
    INFO(share << ", expected " << expected);
    CHECK(test::agree(share, expected));
}
