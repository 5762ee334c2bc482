// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/render.hpp>

#include <cstring>
#include <support/catch.hpp>
#include <support/simulated.hpp>
#include <thread>
#include <winnow/simulate/pattern.hpp>

using namespace winnow;
using namespace winnow::simulate;
using test::statistic;

namespace {

constexpr extent size{37, 29};  // no multiple of a tile

/// Diffuse things under a lamp and a sky: shows no effect but area_light, whatever is declared.
template <class Effects>
auto still_life() {
    scene<Effects, quad, ellipsoid> s;
    s.camera_at = [](double) { return camera{.eye = {0, -4, 2}, .target = {0, 0, 0.5}, .field_of_view = 40}; };
    s.sky = [](const vec3& d) { return rgb(0.2, 0.2, 0.3 + 0.1 * d.z()); };
    s.add(quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}), s.add(material{.name = "floor", .albedo = grey(0.4)}));
    s.add(sphere({0.4, 0, 0.5}, 0.5), s.add(material{.name = "ball", .albedo = rgb(0.7, 0.3, 0.1)}));
    s.add(quad({-1, -1, 3}, {0, 1, 0}, {1, 0, 0}), s.add(material{.name = "lamp", .emission = grey(9)}));
    return s;
}

using watched = planes<color_t, variance_of<color_t>, half_a<color_t>, half_b<color_t>, albedo_t, normal_t, depth_t,
                       position_t, rest_position_t, visibility_t>;

template <class Planes>
bool same(const film<Planes>& a, const film<Planes>& b) {
    return a.raw().size() == b.raw().size() && std::memcmp(a.raw().data(), b.raw().data(), a.raw().size()) == 0;
}

template <class Effects>
film<watched> shown_with() {
    return test::rendered<watched>(world(still_life<Effects>()), size, {.samples = 5});
}

}  // namespace

TEST_CASE("the same bits by 1, 2 and 7 threads and tiles of three sizes", "[threads]") {
    auto s = still_life<effects<effect::area_light, effect::mirror, effect::caustics, effect::global_illumination>>();
    s.add(sphere({-0.7, -0.5, 0.4}, 0.4), s.add(material{.name = "glass", .ior = 1.5}));
    const world w(s);
    const render_settings settings{.samples = 20};  // more than one map of photons
    const auto reference = test::rendered<watched>(w, size, settings, 1);
    REQUIRE(reference.rejected() == 0);
    for (const int threads : {1, 2, 7})
        for (const int tile : {1, 8, 64}) {
            render_settings other = settings;
            other.tile = tile;
            CHECK(same(reference, test::rendered<watched>(w, size, other, threads)));
        }
    render_settings other = settings;
    other.seed = 2;
    CHECK_FALSE(same(reference, test::rendered<watched>(w, size, other)));
}

TEST_CASE("a render in parts is the render") {
    const world w(still_life<effects<effect::area_light>>());
    film<watched> parts(size);
    render(w, parts, {.samples = 3}, executor::fresh_threads{2});
    render(w, parts, {.samples = 5, .first = 3}, executor::fresh_threads{2});
    CHECK(same(parts, test::rendered<watched>(w, size, {.samples = 8})));
}

TEST_CASE("an effect that a scene does not show changes no bit when it is declared") {
    const auto plain = shown_with<effects<effect::area_light>>();
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::depth_of_field>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::translation>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::rotation, effect::camera_motion>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::glossy>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::mirror>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::mirror, effect::caustics>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::texture, effect::bump, effect::roughness_map>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::medium>>()));
    CHECK(same(plain, shown_with<effects<effect::area_light, effect::frames, effect::fireflies>>()));
    // And one that it does show changes many.
    CHECK_FALSE(same(plain, shown_with<effects<effect::area_light, effect::global_illumination>>()));
}

TEST_CASE("half buffers are independent: a quarter of their squared difference is the variance of the mean") {
    const world w(still_life<effects<effect::area_light>>());
    constexpr extent few{6, 4};
    for (const simulate::pattern p : {pattern::stratified, pattern::independent}) {
        statistic from_halves, from_samples;
        std::vector<statistic> means(static_cast<std::size_t>(few.pixels()));
        for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
            const auto images = test::rendered<planes<color_t, variance_of<color_t>, half_a<color_t>, half_b<color_t>>>(
                                    w, few, {.samples = 8, .seed = seed, .pattern = p}, 1)
                                    .develop();
            double halves = 0, samples = 0;
            for (int y = 0; y < few.height; ++y)
                for (int x = 0; x < few.width; ++x) {
                    const double d = images[first_half(color)].at(x, y) - images[second_half(color)].at(x, y);
                    halves += d * d / 4;
                    samples += images[variance(color)].at(x, y);
                    means[static_cast<std::size_t>(y * few.width + x)].add(images[color].at(x, y));
                }
            from_halves.add(halves / static_cast<double>(few.pixels()));
            from_samples.add(samples / static_cast<double>(few.pixels()));
        }
        double truth = 0, uncertainty = 0;
        for (const statistic& m : means) {
            truth += m.variance() / static_cast<double>(few.pixels());
            // A variance from n values is known to sqrt(2 / (n - 1)); tails may double that.
            uncertainty += std::pow(2 * m.variance() * std::sqrt(2 / (m.n - 1)) / static_cast<double>(few.pixels()), 2);
        }
        const double error = std::hypot(from_halves.standard_error(), std::sqrt(uncertainty));
        INFO("halves " << from_halves << ", samples " << from_samples << ", truth " << truth);
        CHECK(std::abs(from_halves.mean - truth) <= 4 * error);
        // What the samples of a pixel say is right for independent ones, and too large for stratified ones.
        if (p == pattern::independent) CHECK(std::abs(from_samples.mean - truth) <= 4 * error);
        else CHECK(truth < 0.8 * from_samples.mean);
    }
}

TEST_CASE("a render can be watched and cancelled") {
    const world w(still_life<effects<effect::area_light>>());
    film<planes<color_t>> f(size);
    render_progress progress;
    render(w, f, {.samples = 3}, executor::fresh_threads{2}, progress);
    CHECK(progress.done == 3 * size.pixels());
    // From another thread, in the midst of it.
    render_progress watched;
    film<planes<color_t>> part(size);
    {
        const std::jthread impatient([&] {
            while (watched.done == 0) std::this_thread::yield();
            watched.cancel = true;
        });
        render(w, part, {.samples = 100'000, .tile = 4}, executor::fresh_threads{2}, watched);
    }
    CHECK(watched.done > 0);
    CHECK(watched.done < 100'000 * size.pixels());
    progress.cancel = true;
    film<planes<color_t>> none(size);
    render(w, none, {.samples = 3}, executor::fresh_threads{2}, progress);
    CHECK(none.samples(0, 0) == 0);
    CHECK_THROWS_WITH(render(w, f, {.samples = 0}, executor::fresh_threads{1}),
                      "0 samples per pixel: there must be at least one");
    CHECK_THROWS_WITH(render(w, f, {.first = -1}, executor::fresh_threads{1}), "the first sample is number -1, of 8");
    CHECK_THROWS_WITH(render(w, f, {.tile = 0}, executor::fresh_threads{1}),
                      "tiles of 0 pixels: there must be at least one");
}
