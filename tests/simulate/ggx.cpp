// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/ggx.hpp>

#include <support/catch.hpp>

using namespace winnow::simulate;

namespace {

vec3 at_cosine(double c) { return {std::sqrt(1 - c * c), 0, c}; }

/// f(u) averaged over the middles of a grid on the unit square.
template <class F>
auto averaged(int n, const F& f) {
    auto sum = f(vec2(0.5 / n, 0.5 / n));
    for (int i = 1; i < n * n; ++i) sum += f(vec2((i % n + 0.5) / n, (i / n + 0.5) / n));
    return decltype(sum)(sum / (n * n));
}

}  // namespace

TEST_CASE("Schlick's Fresnel is F0 at normal incidence and 1 at grazing") {
    CHECK((schlick(rgb(0.04, 0.5, 1), 1) == rgb(0.04, 0.5, 1)).all());
    CHECK((schlick(rgb(0.04, 0.5, 1), 0) == rgb(1, 1, 1)).all());
    CHECK(schlick(grey(0.04), 0.5)[0] == Approx(0.04 + 0.96 / 32));
}

TEST_CASE("a dielectric reflects ((n-1)/(n+1))^2 at normal incidence, all at grazing and beyond the critical angle") {
    CHECK(dielectric(1, 1.5) == Approx(0.04));
    CHECK(dielectric(1, 1 / 1.5) == Approx(0.04));
    CHECK(dielectric(1e-9, 1.5) == Approx(1));
    CHECK(dielectric(std::sqrt(1 - 0.7 * 0.7), 1 / 1.5) == 1);
    // Brewster's angle: the parallel part vanishes, the other is ((n^2-1)/(n^2+1))^2.
    const double brewster = std::cos(std::atan(1.5));
    CHECK(dielectric(brewster, 1.5) == Approx(0.5 * std::pow((2.25 - 1) / (2.25 + 1), 2)));
}

TEST_CASE("the density of microfacets, projected, is one") {
    for (const double alpha : {0.05, 0.3, 1.0}) {
        // d omega cos = pi d(cos^2).
        const int n = 1'000'000;
        double sum = 0;
        for (int i = 0; i < n; ++i) sum += ggx{alpha}.density(std::sqrt((i + 0.5) / n)) * pi / n;
        CHECK(sum == Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("the pdf of a sample is the share of samples that go there") {
    // Weighted by 1/pdf, samples measure solid angle: of a cap about the mirrored direction that is well covered.
    for (const double alpha : {0.3, 1.0})
        for (const double cosine : {0.95, 0.5}) {
            const vec3 out = at_cosine(cosine), mirrored(-out.x(), -out.y(), out.z());
            const double cap = 0.9;
            const double area = averaged(1500, [&](const vec2& u) {
                const vec3 in = ggx{alpha}.sample(out, u);
                const double pdf = ggx{alpha}.pdf(out, in);
                return in.z() > 0 && in.dot(mirrored) > cap && pdf > 0 ? 1 / pdf : 0.0;
            });
            CHECK(area == Approx(2 * pi * (1 - cap)).epsilon(0.01));
        }
}

TEST_CASE("the directional albedo is that of the table of pre-integrated BRDFs") {
    // A and B of Zhuang et al. 2022 with height-correlated Smith: the albedo for F0 is F0 A + B.
    struct oracle {
        double cosine, alpha, a, b;
    };
    for (const oracle& o : {oracle{1, 0.1, 0.98830, 0.00001},
                            {1, 0.5, 0.68780, 0.00005},
                            {1, 1, 0.30682, 0.00003},
                            {0.5, 0.1, 0.93707, 0.03214},
                            {0.5, 0.5, 0.68810, 0.01015},
                            {0.2, 0.25, 0.74990, 0.09826},
                            {0.05, 1, 0.81568, 0.03209}}) {
        const ggx g{o.alpha};
        const vec3 out = at_cosine(o.cosine);
        const auto albedo = [&](double f0) {
            return averaged(400, [&](const vec2& u) {
                const vec3 in = g.sample(out, u);
                const double pdf = g.pdf(out, in);
                return pdf > 0 ? schlick(grey(f0), out.dot((out + in).normalized()))[0] * g.value(out, in) / pdf : 0.0;
            });
        };
        INFO("cosine " << o.cosine << ", alpha " << o.alpha);
        CHECK(std::abs(albedo(0) - o.b) < 2e-3);
        CHECK(std::abs(albedo(1) - (o.a + o.b)) < 2e-3);
    }
    // At normal incidence and alpha 1 in closed form: 1 - ln 2.
    CHECK(std::abs(averaged(400,
                            [&](const vec2& u) {
                                const vec3 in = ggx{1}.sample({0, 0, 1}, u);
                                return in.z() > 0 ? ggx{1}.value({0, 0, 1}, in) / ggx{1}.pdf({0, 0, 1}, in) : 0.0;
                            }) -
                   (1 - std::log(2.0))) < 1e-4);
}

TEST_CASE("nothing is reflected from or to below the horizon, and nothing is NaN at grazing or nearly smooth") {
    const ggx g{0.3};
    CHECK(g.value({0.8, 0, -0.6}, {0, 0, 1}) == 0);
    CHECK(g.value({0, 0, 1}, {0.8, 0, -0.6}) == 0);
    CHECK(g.pdf({0, 0, 1}, {0.8, 0, -0.6}) == 0);
    for (const double alpha : {1e-6, 1e-3, 1.0})
        for (const double cosine : {1e-9, 1e-3, 1.0})
            for (const vec2& u : {vec2(0, 0), vec2(0.5, 0.5), vec2(0.999999, 0.999999), vec2(0.25, 0)}) {
                const vec3 in = ggx{alpha}.sample(at_cosine(cosine), u);
                CHECK(in.allFinite());
                CHECK(std::isfinite(ggx{alpha}.value(at_cosine(cosine), in)));
                CHECK(std::isfinite(ggx{alpha}.pdf(at_cosine(cosine), in)));
            }
}
