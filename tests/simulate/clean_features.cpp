// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// What the covariance of positions is for: renders of things that move, their features cleaned.
#include <support/catch.hpp>
#include <support/simulated.hpp>
#include <winnow/metric/mse.hpp>
#include <winnow/paper/sure_prefilter_2017.hpp>
#include <winnow/simulate/pattern.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

constexpr extent size{48, 40};

/// MSE of the albedo of a render with 8 samples: as it is, and cleaned.
struct errors {
    double noisy, cleaned_by_rest, cleaned_by_place;
};

template <class World>
errors errors_of(const World& w) {
    using with_halves = planes<albedo_t, half_a<albedo_t>, half_b<albedo_t>>;
    using rest =
        planes<rest_position_t, half_a<rest_position_t>, half_b<rest_position_t>, covariance_of<rest_position_t>>;
    using place = planes<position_t, half_a<position_t>, half_b<position_t>, covariance_of<position_t>>;
    const auto truth = test::rendered<planes<albedo_t>>(w, size, {.samples = 2048, .seed = 77}).develop();
    const auto images = test::rendered<joined<with_halves, rest, place>>(w, size, {.samples = 8}).develop();
    const auto mse = [&](const source& albedo_image) { return metric::mse(albedo_image, truth[albedo].view()); };
    const auto cleaned = [&](auto guide) {
        paper::sure_prefilter_of<planes<albedo_t>, decltype(guide), estimator::noise::anisotropic> f;
        f.numbers.restraint = 3;
        workspace memory;
        return mse(f(images.frame(), executor::serial<>{}, memory)[0].mean);
    };
    return {mse(images[albedo].view()), cleaned(rest_position), cleaned(position)};
}

rgb stripes(const place& p) { return grey(0.2 + 0.6 * stripe(3 * p.rest.x())); }

}  // namespace

TEST_CASE("a ball that spins in place: its samples stay where they are, but not on what they show") {
    using shows = effects<effect::rotation, effect::texture>;
    scene<shows, quad, ellipsoid> s;
    s.camera_at = [](double) { return camera{.eye = {0, -4, 0}, .target = {0, 0, 0}, .field_of_view = 40}; };
    const vec3 middle(0, 0, 0);
    s.add(sphere(middle, 1), s.add(material{.name = "ball", .albedo = grey(1), .texture = stripes}),
          s.add(motion{.pivot = middle, .axis = vec3::UnitZ(), .spin = 0.4}));
    s.add(quad({-9, 6, -9}, {18, 0, 0}, {0, 0, 18}), s.add(material{.name = "wall", .albedo = grey(0.5)}));
    const errors e = errors_of(world(s));
    CAPTURE(e.noisy, e.cleaned_by_rest, e.cleaned_by_place);
    CHECK(e.cleaned_by_rest < e.noisy);
    CHECK(e.cleaned_by_rest < e.cleaned_by_place);
}

TEST_CASE("a plane that moves in itself: the picture is smeared along the motion, and noisy") {
    using shows = effects<effect::translation, effect::texture>;
    scene<shows, quad> s;
    s.camera_at = [](double) {
        return camera{.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .field_of_view = 40};
    };
    s.add(quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}),
          s.add(material{.name = "ground", .albedo = grey(1), .texture = stripes}),
          s.add(motion{.velocity = vec3(0.5, 0, 0)}));
    const errors e = errors_of(world(s));
    CAPTURE(e.noisy, e.cleaned_by_rest, e.cleaned_by_place);
    CHECK(e.cleaned_by_rest < e.noisy);
    CHECK(e.cleaned_by_rest < e.cleaned_by_place);
}
