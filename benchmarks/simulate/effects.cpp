// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// What each effect costs: not declared, declared for a scene that does not show it, and shown.  A film of the colour
/// with its variance and halves, albedo, normal and depth; one thread.
#include <benchmark/benchmark.h>

#include <cstring>
#include <winnow/executor/pool.hpp>
#include <winnow/simulate/film_for.hpp>
#include <winnow/simulate/pattern.hpp>
#include <winnow/simulate/render.hpp>

#include "support/timed.hpp"

namespace {

using namespace winnow;
using namespace winnow::simulate;

constexpr extent size{128, 96};
constexpr int samples = 4;

/// Six balls on a floor under a lamp and a sky.
template <class Effects>
auto still_life() {
    scene<Effects, quad, ellipsoid> s;
    s.camera_at = [](double) { return camera{.eye = {0, -4, 2}, .target = {0, 0, 0.4}, .field_of_view = 40}; };
    s.sky = [](const vec3& d) { return rgb(0.2, 0.2, 0.3 + 0.1 * d.z()); };
    s.add(quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}), s.add(material{.name = "floor", .albedo = grey(0.4)}));
    const int paint = s.add(material{.name = "paint", .albedo = rgb(0.7, 0.3, 0.1)});
    for (int i = 0; i < 6; ++i) s.add(sphere({0.8 * (i % 3 - 1), 0.9 * (i / 3) - 0.4, 0.35}, 0.35), paint);
    s.add(quad({-1, -1, 3}, {0, 1, 0}, {1, 0, 0}), s.add(material{.name = "lamp", .emission = grey(9)}));
    return s;
}
constexpr int floor_paint = 0, ball_paint = 1, lamp_paint = 2;

using kept = film<planes<color_t, variance_of<color_t>, half_a<color_t>, half_b<color_t>, albedo_t, normal_t, depth_t>>;

template <class World>
kept rendered(const World& w) {
    kept f(size);
    render(w, f, {.samples = samples}, executor::fresh_threads{1});
    return f;
}

template <class Scene>
void run(benchmark::State& state, const Scene& s, const kept* expected) {
    const world w(s);
    const kept result = rendered(w);
    if (expected && std::memcmp(result.raw().data(), expected->raw().data(), result.raw().size()) != 0)
        return state.SkipWithError("declaring the effect has changed the picture");
    if (result.rejected() > 0) return state.SkipWithError("there are samples that are no numbers");
    const double seconds = benchmarks::seconds_each(state, [&] { benchmark::DoNotOptimize(rendered(w)); });
    using effects = typename Scene::effects;
    state.counters["ns/sample"] = 1e9 * seconds / (static_cast<double>(size.pixels()) * samples);
    state.counters["sample bytes"] = sizeof(sample<typename effects::gives>);
    state.counters["film bytes"] = complete_film<effects>::pixel_bytes;
    state.counters["numbers"] = effects::camera_numbers + effects::vertex_numbers;
}

template <class Effects, class E>
struct with;
template <class... Declared, class E>
struct with<effects<Declared...>, E> {
    using type = effects<Declared..., E>;
};

/// Three benchmarks for effect E beside those of Without; show(scene) makes the scene show it.  What a scene shows
/// without doing anything for it can't be declared alone.
template <class Without, class E, bool ShownAnyway = false, class Show>
void measure(const Show& show) {
    using With = typename with<Without, E>::type;
    const auto add = [](const std::string& how, auto f) {
        benchmark::RegisterBenchmark((E::name() + "/" + how).c_str(), f)->Unit(benchmark::kMillisecond);
    };
    add("undeclared", [](benchmark::State& state) { run(state, still_life<Without>(), nullptr); });
    if (!ShownAnyway)
        add("declared", [](benchmark::State& state) {
            const kept expected = rendered(world(still_life<Without>()));
            run(state, still_life<With>(), &expected);
        });
    add("shown", [show](benchmark::State& state) {
        auto s = still_life<With>();
        show(s);
        run(state, s, nullptr);
    });
}

}  // namespace

int main(int argc, char** argv) {
    using lit = effects<effect::area_light>;
    measure<lit, effect::depth_of_field>([](auto& s) {
        s.camera_at = [](double) {
            return camera{
                .eye = {0, -4, 2}, .target = {0, 0, 0.4}, .field_of_view = 40, .lens_radius = 0.1, .focus = 4};
        };
    });
    const auto move_balls = [](auto& s, const motion& m) {
        const int object = s.add(m);
        for (auto& part : s.parts)
            if (part.material == ball_paint) part.object = object;
    };
    measure<lit, effect::translation>([=](auto& s) { move_balls(s, motion{.velocity = {0.3, 0, 0}}); });
    measure<lit, effect::rotation>([=](auto& s) { move_balls(s, motion{.spin = 0.3}); });
    measure<lit, effect::camera_motion>([](auto& s) {
        s.camera_at = [](double t) {
            return camera{.eye = {0.1 * t, -4, 2}, .target = {0, 0, 0.4}, .field_of_view = 40};
        };
    });
    measure<lit, effect::texture>([](auto& s) {
        s.materials[floor_paint].texture = [](const place& p) -> rgb {
            return grey(0.5 + 0.5 * checker(3 * p.rest.x(), 3 * p.rest.y()));
        };
    });
    measure<lit, effect::bump>([](auto& s) {
        s.materials[ball_paint].height = [](const place& p) { return 0.02 * std::sin(40 * p.rest.z()); };
    });
    measure<lit, effect::glossy>([](auto& s) {
        s.materials[ball_paint].f0 = grey(0.3);
        s.materials[ball_paint].roughness = 0.4;
    });
    measure<effects<effect::area_light, effect::glossy>, effect::roughness_map>([](auto& s) {
        s.materials[ball_paint].f0 = grey(0.3);
        s.materials[ball_paint].roughness_map = [](const place& p) {
            return 0.3 + 0.3 * checker(9 * p.rest.x(), 9 * p.rest.z());
        };
    });
    measure<lit, effect::mirror>([](auto& s) {
        s.materials[ball_paint].albedo = grey(0);
        s.materials[ball_paint].f0 = grey(0.9);
    });
    measure<effects<effect::area_light, effect::mirror>, effect::caustics>([](auto& s) {
        s.materials[ball_paint].albedo = grey(0);
        s.materials[ball_paint].f0 = grey(0.9);
    });
    measure<lit, effect::medium>([](auto& s) { s.medium = {.extinction = 0.1, .albedo = grey(0.9)}; });
    measure<lit, effect::global_illumination, true>([](auto&) {});
    measure<lit, effect::frames>([](auto& s) {
        s.camera_at = [](double t) {
            return camera{.eye = {0.1 * t, -4, 2}, .target = {0, 0, 0.4}, .field_of_view = 40};
        };
    });
    measure<lit, effect::fireflies>([](auto& s) { s.materials[lamp_paint].selection = 0.05; });
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
