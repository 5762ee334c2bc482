// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/scatter.hpp>

#include <support/catch.hpp>

using namespace winnow::simulate;

namespace {

using all = effects<effect::area_light, effect::glossy, effect::mirror, effect::global_illumination>;
using diffuse_only = effects<effect::area_light>;

surface upward(const rgb& albedo, const rgb& f0, double roughness, double ior = 0) {
    surface s{};
    s.position = s.rest = vec3::Zero();
    s.outward = s.facing = s.shading = vec3::UnitZ();
    s.albedo = albedo, s.f0 = f0, s.emission = grey(0), s.roughness = roughness, s.ior = ior;
    s.light = -1;
    return s;
}
const vec3 out = vec3(0.6, 0, 0.8);

/// What both lobes reflect of a constant surrounding: all choices and directions, on a grid.
template <class Effects>
std::array<rgb, 2> reflected(const surface& s) {
    const scattering<Effects> lobes(s, out);
    std::array<rgb, 2> sum{grey(0), grey(0)};
    const int choices = 50, n = 60;
    for (int c = 0; c < choices; ++c)
        for (int i = 0; i < n * n; ++i) {
            const vec2 u((i % n + 0.5) / n, (i / n + 0.5) / n);
            const scattered next = lobes.sample((c + 0.5) / choices, [&] { return u; });
            sum[static_cast<std::size_t>(next.by)] += next.weight / (choices * n * n);
        }
    return sum;
}

}  // namespace

TEST_CASE("the diffuse lobe reflects the albedo, the specular one what its table says, the mirror its Fresnel") {
    const auto rough = reflected<all>(upward(rgb(0.5, 0.2, 0.1), grey(0.3), std::sqrt(0.5)));
    CHECK((rough[0] - rgb(0.5, 0.2, 0.1)).abs().maxCoeff() < 0.02);  // the choice has 50 steps
    const auto mirror = reflected<all>(upward(grey(0), rgb(0.9, 0.5, 0.2), 0));
    CHECK((mirror[0] == 0).all());
    CHECK((mirror[1] - schlick(rgb(0.9, 0.5, 0.2), 0.8)).abs().maxCoeff() < 1e-9);
    const auto glass = reflected<all>(upward(grey(0), grey(0), 0, 1.5));
    CHECK((glass[1] - 1).abs().maxCoeff() < 1e-9);
}

TEST_CASE("values and densities are those of the samples: weight = f cos / pdf") {
    const surface s = upward(rgb(0.5, 0.2, 0.1), grey(0.2), 0.6);
    const scattering<all> lobes(s, out);
    for (const double choice : {0.01, 0.99})
        for (const vec2& u : {vec2(0.2, 0.3), vec2(0.7, 0.1)}) {
            const scattered next = lobes.sample(choice, [&] { return u; });
            CHECK(next.by == (choice < 0.5 ? lobe::specular : lobe::diffuse));
            CHECK(next.pdf == Approx(lobes.pdf(next.by, next.direction)));
            CHECK((next.weight * next.pdf - lobes.value(next.by, next.direction)).abs().maxCoeff() < 1e-12);
        }
}

TEST_CASE("a mirror mirrors, and glass refracts by Snell's law") {
    const auto mirrored = scattering<all>(upward(grey(0), grey(1), 0), out).sample(0.5, [] { return vec2(0, 0); });
    CHECK(mirrored.direction.isApprox(vec3(-0.6, 0, 0.8), 1e-12));
    CHECK(mirrored.is_delta());
    const surface pane = upward(grey(0), grey(0), 0, 1.5);
    const auto through = scattering<all>(pane, out).sample(0.99, [] { return vec2(0, 0); });
    CHECK(through.direction.isApprox(vec3(-0.4, 0, -std::sqrt(1 - 0.16)), 1e-12));
    // From within, steeper than the critical angle: all is reflected.
    surface within = pane;
    within.outward = -within.facing;
    const auto total = scattering<all>(within, vec3(0.8, 0, 0.6)).sample(0.99, [] { return vec2(0, 0); });
    CHECK(total.direction.isApprox(vec3(-0.8, 0, 0.6), 1e-12));
}

TEST_CASE("a diffuse surface is the same, bit by bit, whether specular effects are declared or not") {
    const surface s = upward(rgb(0.5, 0.2, 0.1), grey(0), 0.3);
    const scattering<all> rich(s, out);
    const scattering<diffuse_only> plain(s, out);
    const auto u = [] { return vec2(0.3, 0.8); };
    CHECK(rich.specular_share() == 0);
    CHECK(rich.sample(0.4, u).direction == plain.sample(0.4, u).direction);
    CHECK((rich.sample(0.4, u).weight == plain.sample(0.4, u).weight).all());
    CHECK(rich.sample(0.4, u).pdf == plain.sample(0.4, u).pdf);
    CHECK(rich.pdf(lobe::diffuse, out) == plain.pdf(lobe::diffuse, out));
}

TEST_CASE("nothing is lit from behind the surface, whatever the bumps say") {
    surface s = upward(grey(0.5), grey(0.2), 0.5);
    s.shading = vec3(0.8, 0, 0.6);
    const scattering<all> lobes(s, vec3(0, 0, 1));
    const vec3 below = vec3(0.9, 0, -0.1).normalized();
    CHECK((lobes.value(lobe::diffuse, below) == 0).all());
    CHECK((lobes.value(lobe::specular, below) == 0).all());
}

TEST_CASE("the phase function integrates to one, and its samples follow it") {
    for (const double g : {-0.5, 0.0, 0.8}) {
        const phase p{g};
        double integral = 0, mean = 0;
        const int n = 20000;
        for (int i = 0; i < n; ++i) integral += p.pdf(-1 + (2.0 * i + 1) / n) * 2 * pi * 2 / n;
        CHECK(integral == Approx(1).epsilon(1e-3));
        for (int i = 0; i < n; ++i) mean += p.sample(vec3::UnitX(), {(i + 0.5) / n, 0.3}).x() / n;
        CHECK(std::abs(mean - g) < 1e-3);  // the mean cosine is g
    }
}
