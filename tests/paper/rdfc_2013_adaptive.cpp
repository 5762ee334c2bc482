// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/rdfc_2013_adaptive.hpp>

#include <functional>
#include <limits>
#include <winnow/frame/sample_counts.hpp>
#include "support/catch.hpp"
#include "support/patterns.hpp"

using namespace winnow;
using namespace winnow::test;
using paper::rdfc_sampling_density;

// The typedef is the expression.
static_assert(std::is_same_v<rdfc_sampling_density::smoothing,
                             decltype(filter{exponential(patch(noise_normalized(color, {.k = 1}), {.radius = 1})),
                                             window::square{.radius = 10}})>);

namespace {

constexpr extent size{35, 23};

/// A frame, and what a filter might have said about it.
struct outcome {
    buffers in = make_buffers(size);
    image<> filtered = fill(size, 3, structure);
    image<> error = fill(size, 3, [](int x, int y, int c) { return 0.01 * (uniform(21, x, y, c) - 0.3); });
    image<> weights = fill(size, 1, [](int x, int y, int) { return 1 + 100 * uniform(22, x, y); });
    image<> samples = fill(size, 1, [](int x, int y, int) { return 2 + 10 * uniform(23, x, y); });

    paper::rdfc_outcome planes() const {
        return {.filtered = filtered.view(),
                .squared_error = error.view(),
                .weights = weights.view(),
                .samples = samples.view()};
    }
    auto frame() const { return winnow::frame{color = in.color.view(), variance(color) = in.color_variance.view()}; }
    image<> density(const rdfc_sampling_density& rho = {}) const {
        image<> result(size);
        rho(frame(), planes(), result.view());
        return result;
    }
};

image<> changed(const image<>& from, const std::function<double(double, int, int, int)>& f) {
    return fill(from.size(), from.channels(), [&](int x, int y, int c) { return f(from.at(x, y, c), x, y, c); });
}

}  // namespace

TEST_CASE("the sampling density before it is smoothed, worked by hand") {
    // Two pixels, two channels.
    const float f[] = {1, 0, 2, 0}, e[] = {0.3f, 0.01f, -0.1f, -0.02f}, s[] = {9, 3}, n[] = {4, 4};
    const paper::rdfc_outcome of{.filtered = planar(f, {2, 1}, 2),
                                 .squared_error = planar(e, {2, 1}, 2),
                                 .weights = planar(s, {2, 1}, 1),
                                 .samples = planar(n, {2, 1}, 1)};
    rdfc_sampling_density rho;
    rho.epsilon = 0.5f;
    // relMSE = ((0.3 - 0.1) / 2) / ((1 + 4) / 2 + 0.5) = 1/30;  W = 9 / (1 + 9 * 4).
    CHECK(rho.unsmoothed(of).at(0, 0) == Approx(9 / 37.0 / 30).epsilon(1e-6));
    // An error below 0 in the mean of the channels is none.
    CHECK(rho.unsmoothed(of).at(1, 0) == 0);
    rho.behind = paper::samples_behind::pixel;  // W = 9 / (1 + 4)
    CHECK(rho.unsmoothed(of).at(0, 0) == Approx(9 / 5.0 / 30).epsilon(1e-6));
    // The paper's epsilon.
    CHECK(rdfc_sampling_density{}.unsmoothed(of).at(0, 0) == Approx(0.1 / 2.51 * 9 / 37).epsilon(1e-6));
}

TEST_CASE("the density is smoothed by non-local means of the colour") {
    const outcome o;
    const rdfc_sampling_density rho;
    const image<> raw = rho.unsmoothed(o.planes());
    image<> wanted(size);
    filter{exponential(patch(noise_normalized(color, {.k = 1}), {.radius = 1})), window::square{.radius = 10}}(
        o.frame(), output{}.layer(raw.view(), wanted.view()));
    CHECK(other_bits(o.density(), wanted) == "");
    CHECK(beyond(0.1 * largest_magnitude(raw), wanted, raw) != "");
}

TEST_CASE("the unit of radiance does not matter, where the epsilons are in that unit; and hardly, where it is bright") {
    const outcome o;
    for (const double a : {1e-3, 1e3}) {
        outcome scaled = o;
        const auto by = [](double factor) { return [factor](double v, int, int, int) { return factor * v; }; };
        scaled.in.color = changed(o.in.color, by(a)),
        scaled.in.color_variance = changed(o.in.color_variance, by(a * a));
        scaled.filtered = changed(o.filtered, by(a)), scaled.error = changed(o.error, by(a * a));
        rdfc_sampling_density rho;
        rho.epsilon = static_cast<float>(rho.epsilon * a * a);
        rho.smooth.weight = exponential(
            patch(noise_normalized(color, {.k = 1, .epsilon = static_cast<float>(1e-10 * a * a)}), {.radius = 1}));
        CHECK(beyond_relative(1e-5, scaled.density(rho), o.density()) == "");
    }
    rdfc_sampling_density less;
    less.epsilon = 5e-3f;
    CHECK(beyond_relative(0.1, o.density(less), o.density()) == "");
}

TEST_CASE("more error, more samples; twice the error everywhere, the same density up to a factor") {
    const outcome o;
    outcome twice = o, local = o;
    twice.error = changed(o.error, [](double e, int, int, int) { return 2 * e; });
    local.error.at(17, 11, 1) += 1;
    const image<> before = o.density(), doubled = twice.density(), after = local.density();
    CHECK(beyond_relative(1e-6, doubled, changed(before, [](double v, int, int, int) { return 2 * v; })) == "");
    CHECK(after.at(17, 11) > 1.5f * before.at(17, 11));
    int fewer = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) fewer += after.at(x, y) < before.at(x, y);
    CHECK(fewer == 0);
    const sample_budget b{.total = 4 * size.pixels(), .cap = 16};
    CHECK(counts_from_density(after.view(), b).at(17, 11) > counts_from_density(before.view(), b).at(17, 11));
}

TEST_CASE("more samples behind a pixel, fewer to come; wider support, more") {
    const outcome o;
    for (const auto behind : {paper::samples_behind::filter, paper::samples_behind::pixel}) {
        rdfc_sampling_density rho;
        rho.behind = behind;
        const image<> before = rho.unsmoothed(o.planes());
        outcome had = o, wide = o;
        had.samples = changed(o.samples, [](double n, int, int, int) { return 2 * n; });
        wide.weights = changed(o.weights, [](double s, int, int, int) { return 2 * s; });
        const image<> after = rho.unsmoothed(had.planes()), wider = rho.unsmoothed(wide.planes());
        int wrong = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                if (before.at(x, y) > 0)
                    wrong += !(after.at(x, y) < 0.75f * before.at(x, y)) + !(wider.at(x, y) > before.at(x, y));
        CHECK(wrong == 0);
    }
}

TEST_CASE("where there is no error there are no samples, beyond what rounding brings") {
    // Left a wrong half, right a perfect one of another colour, both without noise.
    outcome o;
    const auto wrong = [](int x) { return x < 15; };
    o.in.color = fill(size, 3, [&](int x, int, int) { return wrong(x) ? 0.2 : 0.8; });
    o.in.color_variance = fill(size, 3, [](int, int, int) { return 1e-6; });
    o.error = fill(size, 3, [&](int x, int y, int) { return wrong(x) ? 0.01 * uniform(4, x, y) : -0.001; });
    const sample_counts n = counts_from_density(o.density().view(), {.total = 8 * size.pixels(), .cap = 40});
    CHECK(n.total() == 8 * size.pixels());
    int right = 0, left = 40;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (wrong(x)) left = std::min(left, n.at(x, y));
            else if (x > 16) right = std::max(right, n.at(x, y));  // patches see the edge from one pixel beside it
    CHECK(left > 2);
    CHECK(right == 0);
    // No error at all: no pixel before another.
    o.error = image<>(size, 3);
    const sample_counts even = counts_from_density(o.density().view(), {.total = 8 * size.pixels(), .cap = 40});
    CHECK(even == sample_counts(size, 8));
}

TEST_CASE("a pixel of which nothing is known is sampled as its neighbours are") {
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
    const outcome o;
    const image<> before = o.density();
    for (const float value : bad) {
        outcome hole = o;
        hole.error.at(17, 11, 2) = value, hole.weights.at(3, 3) = value, hole.filtered.at(30, 20, 0) = bad[0];
        const image<> after = hole.density();
        CHECK(all_finite(after));
        CHECK(after.at(17, 11) > 0);
        CHECK(beyond_relative(0.25, after, before) == "");
    }
}

TEST_CASE("any executor gives the density") {
    const outcome o;
    image<> doubles(size);
    rdfc_sampling_density{}(o.frame(), o.planes(), doubles.view(), executor::serial<double>{});
    CHECK(beyond_relative(1e-5, o.density(), doubles) == "");
}

TEST_CASE("planes that do not fit are refused with their sizes") {
    const outcome o;
    image<> result(size);
    const rdfc_sampling_density rho;
    const image<> small({4, 3}), colors(size, 3), none;
    const auto with = [&](auto member, const image<>& plane) {
        paper::rdfc_outcome of = o.planes();
        of.*member = plane.view();
        rho(o.frame(), of, result.view());
    };
    using of = paper::rdfc_outcome;
    CHECK_THROWS_WITH(with(&of::weights, small), "the sum of weights is 4x3 with 1 channels, not 35x23 with 1");
    CHECK_THROWS_WITH(with(&of::samples, colors), "the number of samples is 35x23 with 3 channels, not 35x23 with 1");
    CHECK_THROWS_WITH(with(&of::squared_error, result), "the squared error is 35x23 with 1 channels, not 35x23 with 3");
    CHECK_THROWS_WITH(with(&of::filtered, none), "the filtered image has no channels");
    CHECK_THROWS_AS(rho(o.frame(), o.planes(), image<>({4, 3}).view()), invalid_input);
    CHECK_THROWS_AS(rho(o.frame(), o.planes(), image<>(size, 3).view()), invalid_input);
    rdfc_sampling_density bad;
    bad.epsilon = 0;
    CHECK_THROWS_WITH(o.density(bad), Catch::Contains("epsilon is 0.0"));
}
