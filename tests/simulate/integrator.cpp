// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The simulator against what can be worked out without it.
#include <winnow/simulate/integrator.hpp>

#include <support/catch.hpp>
#include <support/simulated.hpp>
#include <winnow/simulate/pattern.hpp>

using namespace winnow;
using namespace winnow::simulate;
using test::statistic;

namespace {

constexpr extent small{16, 12};
const render_settings independent{.samples = 64, .pattern = pattern::independent};

camera straight_down(double height, double field_of_view) {
    return {.eye = {0, 0, height}, .target = {0, 0, 0}, .up = vec3::UnitY(), .field_of_view = field_of_view};
}

/// A room seen from its middle; walls look inwards.
template <class Scene>
void add_room(Scene& s, double half, int material) {
    const double h = half, d = 2 * half;
    s.add(quad({-h, -h, -h}, {d, 0, 0}, {0, d, 0}), material);
    s.add(quad({-h, -h, h}, {0, d, 0}, {d, 0, 0}), material);
    s.add(quad({-h, -h, -h}, {0, d, 0}, {0, 0, d}), material);
    s.add(quad({h, -h, -h}, {0, 0, d}, {0, d, 0}), material);
    s.add(quad({-h, -h, -h}, {0, 0, d}, {d, 0, 0}), material);
    s.add(quad({-h, h, -h}, {d, 0, 0}, {0, 0, d}), material);
}

}  // namespace

namespace {

/// Counts what a path draws.
template <class Effects>
struct counted_numbers {
    random_numbers<Effects> numbers;
    int& count;

    template <class D>
    requires(Effects::template draws<D>) auto operator()(D, int vertex = 0) const {
        count += D::count;
        return numbers(D{}, vertex);
    }
};

/// How many random numbers a path draws that meets a floor, and nothing afterwards.
template <class... E>
int drawn() {
    using shows = effects<E...>;
    scene<shows, quad> s;
    s.camera_at = [](double) { return straight_down(2, 1); };
    s.add(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.add(material{.name = "floor", .albedo = grey(0.5)}));
    s.sky = [](const vec3&) { return grey(1); };
    const world w(s);
    const path_tracer<decltype(w), typename shows::gives> trace(w, small);
    int count = 0;
    trace(3, 4,
          counted_numbers<shows>{random_numbers<shows>(sample_numbers(pattern::stratified, 1, 0, 3, 4, 0)), count});
    return count;
}

}  // namespace

TEST_CASE("a path draws the numbers that its effects take, and no others") {
    CHECK(drawn<>() == 2);  // where in the pixel
    CHECK(drawn<effect::depth_of_field>() == 4);
    CHECK(drawn<effect::translation>() == 3);
    CHECK(drawn<effect::translation, effect::rotation, effect::camera_motion>() == 3);
    CHECK(drawn<effect::texture, effect::bump, effect::frames, effect::fireflies>() == 2);
    // A light and where on it; a lobe and where to.
    CHECK(drawn<effect::area_light>() == 2 + 1 + 2 + 1 + 2);
    CHECK(drawn<effect::area_light, effect::texture>() == 8);
    CHECK(drawn<effect::area_light, effect::glossy, effect::mirror, effect::global_illumination>() == 8);
    // How far the medium lets it, here and after the floor.
    CHECK(drawn<effect::area_light, effect::medium>() == 8 + 2);
    CHECK(drawn<effect::global_illumination>() == 2 + 1 + 2);
}

TEST_CASE("white furnace: in a room whose walls all shine and reflect, radiance is Le / (1 - a)") {
    using shows = effects<effect::area_light, effect::global_illumination>;
    scene<shows, quad> s;
    s.camera_at = [](double) { return camera{.eye = {0.3, 0.1, 0.2}, .target = {1, 0.5, 0}}; };
    const double reflected = 0.6;
    add_room(s, 1, s.add(material{.name = "wall", .albedo = grey(reflected), .emission = grey(0.5)}));
    for (const int bounces : {2, 8, 1000}) {
        s.bounces = bounces;
        const world w(s);
        // The sum that ends after so many bounces.
        const double truth = 0.5 * (1 - std::pow(reflected, bounces + 1)) / (1 - reflected);
        const statistic mean = test::mean_of<planes<color_t>>(w, small, independent, color);
        INFO(bounces << " bounces: " << mean << ", truth " << truth);
        CHECK(mean.allows(truth));
    }
}

TEST_CASE("furnace of a rough metal: under a sky of 1 it shows its directional albedo, F0 A + B") {
    using shows = effects<effect::area_light, effect::glossy>;
    struct oracle {
        double cosine, alpha, a, b;
    };
    for (const oracle& o : {oracle{1, 0.25, 0.91579, 0.00003},
                            {0.5, 0.1, 0.93707, 0.03214},
                            {0.5, 1, 0.44771, 0.00299},
                            {0.2, 0.5, 0.74891, 0.04102}})
        for (const double at_normal : {1.0, 0.04}) {
            static double cosine;
            cosine = o.cosine;
            scene<shows, quad> s;
            s.camera_at = [](double) {
                return camera{.eye = {-3 * std::sqrt(1 - cosine * cosine), 0, 3 * cosine},
                              .target = {0, 0, 0},
                              .up = vec3::UnitY(),
                              .field_of_view = 0.01};
            };
            s.sky = [](const vec3&) { return grey(1); };
            s.add(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                  s.add(material{.name = "metal", .f0 = grey(at_normal), .roughness = std::sqrt(o.alpha)}));
            const world w(s);
            const statistic mean = test::mean_of<planes<color_t>>(w, small, independent, color);
            const double truth = at_normal * o.a + o.b;
            INFO("cosine " << o.cosine << ", alpha " << o.alpha << ", F0 " << at_normal << ": " << mean << ", truth "
                           << truth);
            // The table has five digits, of 1024 samples.
            CHECK(std::abs(mean.mean - truth) <= 4 * mean.standard_error() + 2e-3 * truth);
        }
}

TEST_CASE("light samples, surface samples and both weighted agree in the mean") {
    using shows = effects<effect::area_light, effect::glossy, effect::global_illumination>;
    scene<shows, quad, ellipsoid> s;
    s.camera_at = [](double) { return camera{.eye = {0, -4, 2}, .target = {0, 0, 0.5}, .field_of_view = 50}; };
    s.sky = [](const vec3& d) { return rgb(0.1 + 0.1 * d.z(), 0.1, 0.2); };
    s.add(quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}),
          s.add(material{.name = "floor", .albedo = grey(0.4), .f0 = grey(0.3), .roughness = 0.4}));
    s.add(sphere({0.8, 0, 0.5}, 0.5), s.add(material{.name = "ball", .f0 = grey(0.8), .roughness = 0.5}));
    s.add(quad({-1.5, 0, 0.2}, {0, 0, 1.5}, {1, 1, 0}), s.add(material{.name = "window", .emission = grey(4)}));
    s.add(sphere({-1, -1, 1.2}, 0.3), s.add(material{.name = "bulb", .emission = grey(3)}));
    const world w(s);
    const auto by = [&](direct_light direct, std::uint64_t seed) {
        return test::mean_of<planes<color_t>>(
            w, small, {.samples = 400, .seed = seed, .pattern = pattern::independent, .direct = direct}, color);
    };
    const statistic both = by(direct_light::both, 1), lights = by(direct_light::by_lights, 2),
                    surfaces = by(direct_light::by_surfaces, 3);
    INFO("both " << both << ", lights " << lights << ", surfaces " << surfaces);
    CHECK(test::agree(both, lights));
    CHECK(test::agree(both, surfaces));
    CHECK(both.variance() < lights.variance());
    CHECK(both.variance() < surfaces.variance());
}

TEST_CASE("a lamp out of focus spreads over the circle that optics says, to a tenth of a pixel") {
    using shows = effects<effect::depth_of_field>;
    scene<shows, ellipsoid> s;
    s.camera_at = [](double) {
        return camera{.eye = {0, 0, 0}, .target = {0, 1, 0}, .field_of_view = 20, .lens_radius = 0.25, .focus = 4};
    };
    const double away = 8, radius = 0.1;
    s.add(sphere({0, away, 0}, radius), s.add(material{.name = "lamp", .emission = grey(1)}));
    const world w(s);
    const extent size{40, 40};
    const double f = 20 / std::tan(10 * pi / 180), circle = 0.25 * (1.0 / 4 - 1 / away) * f, lamp = radius / away * f;
    // The mean squared distance from the middle is half the squared radius of each disc that the image is blurred by.
    const statistic spread = test::of_samples<planes<color_t, image_point_t>>(
        w, size, {.samples = 600, .pattern = pattern::independent}, [&](statistic& all, const auto& p, int, int) {
            const double x = p.at(image_point, 0) - 20, y = p.at(image_point, 1) - 20;
            if (p.at(color) > 0) all.add(x * x + y * y);
        });
    REQUIRE(spread.n > 1000);
    const double measured = std::sqrt(2 * spread.mean - lamp * lamp);
    INFO("circle " << circle << ", measured " << measured);
    CHECK(4 * spread.standard_error() / measured < 0.1);  // precise enough to tell
    CHECK(std::abs(measured - circle) < 0.1);
}

TEST_CASE("motion removed, a moving plane is as spread as a still one, plus v v^T / 12") {
    using shows = effects<effect::translation>;
    const auto covariances = [](const vec3& velocity) {
        scene<shows, quad> s;
        s.camera_at = [](double) { return straight_down(4, 1); };
        s.add(quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), s.add(material{.name = "ground", .albedo = grey(0.5)}),
              s.add(motion{.velocity = velocity}));
        const world w(s);
        return test::rendered<planes<covariance_of<rest_position_t>>>(w, {4, 4}, {.samples = 4096}).develop();
    };
    const vec3 v(0.3, -0.2, 0);
    const auto still = covariances(vec3::Zero()), moved = covariances(v);
    const std::pair<int, int> axes[] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 6; ++c) {
                const double gained =
                    moved[covariance(rest_position)].at(x, y, c) - still[covariance(rest_position)].at(x, y, c);
                // A pixel is .017 wide: with 4096 samples, chance makes position and time covary by 1e-5.
                CHECK(std::abs(gained - v[axes[c].first] * v[axes[c].second] / 12) < 1e-4);
            }
}

TEST_CASE("a point of a turning wheel that is seen at all times keeps its rest position") {
    using shows = effects<effect::rotation>;
    scene<shows, disc> s;
    s.camera_at = [](double) { return straight_down(4, 40); };
    s.add(disc({0, 0, 0}, {0, 0, 1}, 1), s.add(material{.name = "wheel", .albedo = grey(0.5)}),
          s.add(motion{.spin = 2}));
    const world w(s);
    // The hub is at the corner of four pixels, whose rest positions have the hub as their mean; elsewhere they turn.
    statistic hub[2], radius;
    double worst_angle = 0;
    test::of_samples<planes<position_t, rest_position_t, shutter_time_t>>(
        w, {2, 2}, independent, [&](statistic&, const auto& p, int, int) {
            for (int c = 0; c < 2; ++c) hub[c].add(p.at(rest_position, c));
            const auto length = [&](auto g) { return std::hypot(p.at(g, 0), p.at(g, 1)); };
            if (length(position) < 0.9) radius.add(length(rest_position) - length(position));
            // It has turned by 2 radians a frame since it was at rest.
            const auto angle = [&](auto g) { return std::atan2(p.at(g, 1), p.at(g, 0)); };
            const double turned = angle(position) - angle(rest_position) - 2 * p.at(shutter_time);
            if (length(position) > 0.01 && length(position) < 0.9)
                worst_angle = std::max(worst_angle, std::abs(std::remainder(turned, 2 * pi)));
        });
    CHECK(hub[0].allows(0));
    CHECK(hub[1].allows(0));
    CHECK(std::abs(radius.mean) < 1e-6);
    CHECK(radius.variance() < 1e-10);
    CHECK((worst_angle > 0 && worst_angle < 1e-4));
}

TEST_CASE("behind the edge of a wall, the light of a window fades as the window is covered") {
    using shows = effects<effect::area_light>;
    scene<shows, quad> s;
    // Window at height 2, y from -0.5 to 0.5; the edge of the wall at height 1, y = 0, covers y < 0.
    s.camera_at = [](double) { return straight_down(0.9, 90); };
    s.add(quad({-30, -30, 0}, {60, 0, 0}, {0, 60, 0}), s.add(material{.name = "ground", .albedo = grey(0.5)}));
    s.add(quad({-1, -0.5, 2}, {0, 1, 0}, {2, 0, 0}), s.add(material{.name = "window", .emission = grey(1)}));
    s.add(quad({-30, -60, 1}, {60, 0, 0}, {0, 60, 0}), s.add(material{.name = "wall", .albedo = grey(0.5)}));
    const world w(s);
    std::array<statistic, 12> seen, expected;
    test::of_samples<planes<visibility_t, position_t>>(
        w, {12, 12}, {.samples = 500, .pattern = pattern::independent}, [&](statistic&, const auto& p, int, int y) {
            seen[y].add(p.at(visibility));
            expected[y].add(std::clamp(0.5 + p.at(position, 1), 0.0, 1.0));
        });
    int tried = 0;
    for (int y = 0; y < 12; ++y) {
        INFO("row " << y << ": " << seen[y] << ", expected " << expected[y]);
        CHECK(std::abs(seen[y].mean - expected[y].mean) <= 4 * seen[y].standard_error() + 1e-6);
        tried += expected[y].mean > 0.05 && expected[y].mean < 0.95;
    }
    CHECK(tried >= 3);
}

TEST_CASE("the second hit is where the mirror image is") {
    using shows = effects<effect::mirror>;
    const auto content = [](auto& s) {
        const int paint = s.add(material{.name = "paint", .albedo = rgb(0.2, 0.4, 0.6)});
        s.add(sphere({1.5, 0.5, 0.3}, 0.6), paint);
        s.add(quad({-5, -5, -1}, {10, 0, 0}, {0, 10, 0}), paint);
    };
    scene<shows, quad, ellipsoid> s, behind;
    s.camera_at = [](double) { return camera{.eye = {3, -2, 1}, .target = {0, 0, 0}, .field_of_view = 30}; };
    content(s), content(behind);
    s.add(quad({0, -5, -5}, {0, 10, 0}, {0, 0, 10}), s.add(material{.name = "mirror", .f0 = grey(0.9)}));
    const world w(s), without_mirror(behind);
    const vec3 eye(3, -2, 1);
    int mirrored = 0;
    test::of_samples<planes<position_t, position2_t, normal2_t, albedo2_t, hit_distance_t, specular_share_t>>(
        w, small, {.samples = 4}, [&](statistic&, const auto& p, int, int) {
            const auto point = [&](auto g) { return vec3(vec3(p.at(g, 0), p.at(g, 1), p.at(g, 2)) + eye); };
            if (p.at(specular_share) != 1) return;
            // From the mirrored eye through the first hit, as if there were no mirror.
            const vec3 hit = point(position), image(-eye.x(), eye.y(), eye.z());
            REQUIRE(std::abs(hit.x()) < 1e-5);
            const ray r{image, (hit - image).normalized()};
            const meeting m = without_mirror.meet(r, 0);
            if (!m) return;
            ++mirrored;
            CHECK((r.at(m.distance) - point(position2)).norm() < 1e-4);
            CHECK(std::abs(p.at(hit_distance) - (m.distance - (hit - image).norm())) < 1e-4);
            CHECK(std::abs(p.at(albedo2, 2) - 0.6) < 1e-6);
            const surface met = without_mirror.at(r, m, 0);
            CHECK((met.shading - vec3(p.at(normal2, 0), p.at(normal2, 1), p.at(normal2, 2))).norm() < 1e-4);
        });
    CHECK(mirrored > 50);
}

TEST_CASE("motion vectors lead a point to where it was in the previous frame, still or moving") {
    using shows = effects<effect::frames, effect::translation>;
    scene<shows, quad, ellipsoid> s;
    s.camera_at = [](double t) {
        return camera{.eye = {0.1 * t, -4 + 0.05 * t, 1}, .target = {0.2 * t, 0, 0.5}, .field_of_view = 50};
    };
    const int paint = s.add(material{.name = "paint", .albedo = grey(0.5)});
    const vec3 velocity(0.15, 0, 0.02);
    s.add(quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), paint);
    s.add(sphere({0, 0, 0.4}, 0.5), paint, s.add(motion{.velocity = velocity}));
    const world w(s, 3);
    const view before(s.camera_at(2), small), now(s.camera_at(3), small);
    const vec3 eye = s.camera_at(3).eye;
    int still = 0, moving = 0;
    test::of_samples<planes<rest_position_t, instance_t, motion_vector_t>>(
        w, small, {.samples = 4}, [&](statistic&, const auto& p, int, int) {
            const vec3 rest = vec3(p.at(rest_position, 0), p.at(rest_position, 1), p.at(rest_position, 2)) + eye;
            const bool moves = p.at(instance) == 2;
            const vec3 was = moves ? vec3(rest + 2 * velocity) : rest, is = moves ? vec3(rest + 3 * velocity) : rest;
            const vec2 moved(p.at(motion_vector, 0), p.at(motion_vector, 1));
            CHECK((now.project(is) + moved - before.project(was)).norm() < 1e-3);
            (moves ? moving : still) += 1;
        });
    CHECK(still > 50);
    CHECK(moving > 50);
}

TEST_CASE("what fog hides of the first surface is recorded all the same") {
    using shows = effects<effect::area_light, effect::medium>;
    scene<shows, quad> s;
    s.camera_at = [](double) { return straight_down(2, 1); };
    s.medium = {.extinction = 0.7, .albedo = grey(0.5), .anisotropy = 0};
    s.add(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.add(material{.name = "floor", .albedo = grey(0.5)}));
    s.add(quad({-1, -1, 3}, {0, 2, 0}, {2, 0, 0}), s.add(material{.name = "lamp", .emission = grey(1)}));
    const world w(s);
    for (const auto& [mean, truth] : {std::pair(test::mean_of<planes<brdf_t>>(w, small, independent, brdf), 0.5),
                                      {test::mean_of<planes<albedo_t>>(w, small, independent, albedo), 0.5},
                                      {test::mean_of<planes<visibility_t>>(w, small, independent, visibility), 1}}) {
        CHECK(std::abs(mean.mean - truth) < 1e-6);
        CHECK(mean.variance() < 1e-10);
    }
}

TEST_CASE("radiance by the way it took adds up to the colour") {
    using shows =
        effects<effect::area_light, effect::glossy, effect::mirror, effect::global_illumination, effect::medium>;
    scene<shows, quad, ellipsoid> s;
    s.camera_at = [](double) { return camera{.eye = {0, -2, 0.4}, .target = {0, 0, 0}, .field_of_view = 70}; };
    s.medium = {.extinction = 0.1, .albedo = grey(0.8), .anisotropy = 0.3};
    add_room(s, 3, s.add(material{.name = "wall", .albedo = grey(0.4), .f0 = grey(0.2), .roughness = 0.5}));
    s.add(sphere({0.5, 0, -0.5}, 0.6), s.add(material{.name = "mirror", .f0 = grey(0.9)}));
    s.add(sphere({-0.8, 0.5, 0.2}, 0.3), s.add(material{.name = "bulb", .emission = grey(5)}));
    const world w(s);
    statistic parts[5];
    test::of_samples<
        planes<color_t, emission_t, direct_diffuse_t, direct_specular_t, indirect_diffuse_t, indirect_specular_t>>(
        w, small, {.samples = 32}, [&](statistic&, const auto& p, int, int) {
            const double value[5] = {p.at(emission), p.at(direct_diffuse), p.at(direct_specular),
                                     p.at(indirect_diffuse), p.at(indirect_specular)};
            double sum = 0;
            for (int i = 0; i < 5; ++i) sum += value[i], parts[i].add(value[i]);
            CHECK(std::abs(sum - p.at(color)) <= 1e-5 * (1 + p.at(color)));
        });
    for (const statistic& part : parts) CHECK(part.mean > 0);
}

TEST_CASE("the parts that a scene gives add up, however few effects it declares") {
    const auto check = []<class Shows>(Shows) {
        scene<Shows, quad> s;
        s.camera_at = [](double) { return camera{.eye = {0, -2, 0.4}, .target = {0, 0, 0}, .field_of_view = 70}; };
        if constexpr (Shows::template has<effect::medium>) s.medium = {.extinction = 0.3, .albedo = grey(0.8)};
        add_room(s, 3, s.add(material{.name = "wall", .albedo = grey(0.4)}));
        s.add(quad({-0.5, -0.5, 2.9}, {0, 1, 0}, {1, 0, 0}), s.add(material{.name = "lamp", .emission = grey(9)}));
        const world w(s);
        using given = typename Shows::gives;
        const statistic missing =
            test::of_samples<given>(w, small, {.samples = 16}, [](statistic& all, const auto& p, int, int) {
                double sum = 0;
                const auto add = [&]<class G>(G g) {
                    if constexpr (contains<G, given>) sum += p.at(g);
                };
                add(emission), add(direct_diffuse), add(direct_specular), add(indirect_diffuse), add(indirect_specular);
                all.add(p.at(color) - sum);
            });
        CHECK(std::abs(missing.mean) < 1e-5);
        CHECK(missing.variance() < 1e-8);
    };
    check(effects<effect::area_light>{});
    check(effects<effect::area_light, effect::medium>{});
    check(effects<effect::global_illumination>{});
    check(effects<effect::area_light, effect::global_illumination>{});
    check(effects<effect::glossy>{});
}

TEST_CASE("a medium dims what is behind it by exp(-extinction distance)") {
    using shows = effects<effect::medium>;
    scene<shows, quad> s;
    s.camera_at = [](double) { return straight_down(2, 1); };
    s.medium = {.extinction = 0.7, .albedo = grey(0), .anisotropy = 0};
    s.add(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.add(material{.name = "lamp", .emission = grey(3)}));
    const world w(s);
    const statistic mean = test::mean_of<planes<color_t>>(w, small, independent, color);
    CHECK(mean.allows(3 * std::exp(-1.4)));
    const statistic through = test::mean_of<planes<transmittance_t>>(w, small, independent, transmittance);
    CHECK(std::abs(through.mean - std::exp(-1.4)) < 1e-4);
    // How far light comes at all: (1 - exp(-2 e)) / e on average.
    const statistic flight = test::mean_of<planes<scatter_distance_t>>(w, small, independent, scatter_distance);
    CHECK(std::abs(flight.mean - (1 - std::exp(-1.4)) / 0.7) <= 4 * flight.standard_error() + 1e-4);
}

TEST_CASE("in a furnace of fog that absorbs nothing, radiance is everywhere that of the walls") {
    using shows = effects<effect::area_light, effect::medium>;
    scene<shows, quad> s;
    s.camera_at = [](double) { return camera{.eye = {0.3, 0.1, 0.2}, .target = {1, 0.5, 0}}; };
    add_room(s, 1, s.add(material{.name = "wall", .emission = grey(0.5)}));
    s.medium = {.extinction = 1, .albedo = grey(1), .anisotropy = 0.6};
    s.bounces = 1000;
    const world w(s);
    const statistic mean = test::mean_of<planes<color_t>>(w, small, independent, color);
    INFO(mean);
    CHECK(mean.allows(0.5));
}

TEST_CASE("photons bring the light that paths by way of mirrors bring, onto half mirrors as well") {
    // A lamp behind a screen lights a floor by a mirror alone.  Without caustics declared, paths find the lamp by the
    // mirror; with them, photons do.
    const auto brightness = []<class Shows>(Shows, const rgb& polish) {
        scene<Shows, quad> s;
        s.camera_at = [](double) { return camera{.eye = {0, -1, 2}, .target = {0, 0.5, 0}, .field_of_view = 20}; };
        s.sky = [](const vec3&) { return grey(0.01); };
        const int floor = s.add(material{.name = "floor", .albedo = grey(0.5), .f0 = polish});
        s.add(quad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), floor);
        s.add(quad({-2, 2, 0}, {4, 0, 0}, {0, 0, 4}), s.add(material{.name = "mirror", .f0 = grey(0.9)}));
        s.add(quad({-0.5, -1, 1.2}, {1, 0, 0}, {0, 0, 1}), s.add(material{.name = "black"}));  // hides the lamp
        s.add(quad({-0.5, -0.9, 1.2}, {0, 0, 1}, {1, 0, 0}), s.add(material{.name = "lamp", .emission = grey(8)}));
        s.photons_per_sample = 20;
        const world w(s);
        statistic mean;
        for (std::uint64_t seed = 1; seed <= 24; ++seed) {
            const auto images = test::rendered<planes<color_t>>(w, small, {.samples = 16, .seed = seed}).develop();
            statistic image;
            for (int y = 0; y < small.height; ++y)
                for (int x = 0; x < small.width; ++x) image.add(images[color].at(x, y));
            mean.add(image.mean);
        }
        return mean;
    };
    using without = effects<effect::area_light, effect::mirror, effect::global_illumination>;
    using with = effects<effect::area_light, effect::mirror, effect::global_illumination, effect::caustics>;
    for (const double polish : {0.0, 0.4}) {
        const statistic paths = brightness(without{}, grey(polish)), photons = brightness(with{}, grey(polish));
        INFO("polish " << polish << ": paths " << paths << ", photons " << photons);
        // A footprint of photons is not a point: a bias of half a per cent is allowed for.
        CHECK(std::abs(paths.mean - photons.mean) <=
              4 * std::hypot(paths.standard_error(), photons.standard_error()) + 0.005 * paths.mean);
    }
}
