// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/rdfc_2013_selection.hpp>
#include "support/catch.hpp"
#include "support/patterns.hpp"

using namespace winnow;
using namespace winnow::test;
using paper::binary_maps;
using paper::convex_blend;

namespace {

using shares = std::array<float, 3>;
using statistics = std::array<float, convex_blend::statistics>;

/// Candidates that are off by these vectors, whatever the space that they live in, with v_i = Var dF_i/du.
struct vector2 {
    double x, y;
};
statistics of(const std::array<vector2, 3>& off, const std::array<double, 3>& v = {}, double variance = 0) {
    const auto dot = [&](int i, int j) { return static_cast<float>(off[i].x * off[j].x + off[i].y * off[j].y); };
    return {dot(0, 0),
            dot(0, 1),
            dot(0, 2),
            dot(1, 1),
            dot(1, 2),
            dot(2, 2),
            static_cast<float>(v[0]),
            static_cast<float>(v[1]),
            static_cast<float>(v[2]),
            static_cast<float>(variance)};
}

void check_shares(const statistics& s, const shares& expected) {
    const shares found = convex_blend::decide(s, {});
    CAPTURE(found[0], found[1], found[2]);
    for (std::size_t k = 0; k < 3; ++k) CHECK(found[k] == Approx(expected[k]).margin(1e-6));
}

/// A pixel in which every number differs.
paper::rdfc_candidates_pixel any_pixel(std::uint64_t seed) {
    paper::rdfc_candidates_pixel p;
    for (int c = 0; c < 3; ++c) {
        p.input[c] = static_cast<float>(uniform(seed, 0, 0, c));
        p.variance[c] = static_cast<float>(0.1 * uniform(seed, 1, 0, c));
        for (int k = 0; k < 3; ++k) {
            p.filtered[k][c] = static_cast<float>(uniform(seed, 2, k, c));
            p.derivative[k][c] = static_cast<float>(uniform(seed, 3, k, c));
        }
    }
    return p;
}

}  // namespace

TEST_CASE("a candidate's error is Stein's estimate, mean over channels") {
    paper::rdfc_candidates_pixel p{};
    p.input = {1, 2, 3}, p.variance = {0.5f, 0.25f, 1};
    p.filtered[1] = {2, 2, 1}, p.derivative[1] = {0.5f, 0, 0.25f};
    // (1 - .5 + .5) + (0 - .25 + 0) + (4 - 1 + .5)
    CHECK(p.error(1) == Approx((1 - 0.25 + 3.5) / 3));
    CHECK(p.mean_derivative(1) == 0.25f);
    CHECK(binary_maps::gather(p) == std::array<float, 3>{p.error(0), p.error(1), p.error(2)});
}

TEST_CASE("binary maps: the smallest error decides; FIRST must filter more than SECOND; ties are robust") {
    const auto decide = [](std::array<float, 3> error, float first_derivative) {
        paper::rdfc_candidates_pixel p{};
        p.derivative[0] = {first_derivative, first_derivative, first_derivative};
        p.derivative[1] = {0.5f, 0.5f, 0.5f};
        return binary_maps::decide(error, p);
    };
    const shares first{1, 0, 0}, second{0, 1, 0}, third{0, 0, 1};
    CHECK(decide({1, 2, 3}, 0.4f) == first);
    CHECK(decide({1, 2, 3}, 0.6f) == second);  // it is the smallest, but keeps more noise than SECOND
    CHECK(decide({1, 2, 3}, 0.5f) == second);
    CHECK(decide({1, 3, 2}, 0.6f) == third);
    CHECK(decide({3, 1, 2}, 0.4f) == second);
    CHECK(decide({3, 2, 1}, 0.4f) == third);
    CHECK(decide({-3, -2, -1}, 0.4f) == first);  // errors may be negative
    CHECK(decide({1, 1, 1}, 0.4f) == third);
    CHECK(decide({1, 1, 2}, 0.4f) == second);
    CHECK(decide({2, 1, 1}, 0.4f) == third);
    CHECK(decide({NAN, NAN, NAN}, 0.4f) == third);
    CHECK(binary_maps::error({3, 5, 7}, {0.5f, 0.25f, 0.25f}) == 4.5f);
}

TEST_CASE("a blend's estimate is Stein's estimate of the blend, mean over channels") {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const paper::rdfc_candidates_pixel p = any_pixel(seed);
        const statistics s = convex_blend::gather(p);
        for (const shares& share : {shares{1, 0, 0}, shares{0, 1, 0}, shares{0, 0, 1}, shares{0.2f, 0.5f, 0.3f}}) {
            double expected = 0;
            for (int c = 0; c < 3; ++c) {
                double f = 0, d = 0;
                for (int k = 0; k < 3; ++k) f += share[k] * p.filtered[k][c], d += share[k] * p.derivative[k][c];
                expected += ((f - p.input[c]) * (f - p.input[c]) - p.variance[c] + 2 * p.variance[c] * d) / 3;
            }
            CHECK(convex_blend::error(s, share) == Approx(expected).margin(2e-6));
        }
        for (int k = 0; k < 3; ++k) {
            shares corner{};
            corner[static_cast<std::size_t>(k)] = 1;
            CHECK(convex_blend::error(s, corner) == Approx(p.error(k)).margin(2e-6));
        }
    }
}

TEST_CASE("a blend, worked by hand: corners") {
    // All on one side of the input: the nearest alone.
    check_shares(of({{{1, 0}, {2, 0}, {3, 0}}}), {1, 0, 0});
    check_shares(of({{{2, 0}, {1, 0}, {3, 0}}}), {0, 1, 0});
    check_shares(of({{{2, 0}, {3, 0}, {1, 0}}}), {0, 0, 1});
    // Equal candidates: the one that keeps the least noise, and with nothing to choose the most robust.
    check_shares(of({{{1, 0}, {1, 0}, {1, 0}}}, {0.1, 0.2, 0.3}), {1, 0, 0});
    check_shares(of({{{1, 0}, {1, 0}, {1, 0}}}, {0.2, 0.1, 0.2}), {0, 1, 0});
    check_shares(of({{{1, 0}, {1, 0}, {1, 0}}}), {0, 0, 1});
    check_shares(statistics{}, {0, 0, 1});
}

TEST_CASE("a blend, worked by hand: edges") {
    // On opposite sides of the input, 1 and 3 away: three quarters of the nearer.
    check_shares(of({{{1, 0}, {-3, 0}, {9, 9}}}), {0.75f, 0.25f, 0});
    check_shares(of({{{1, 0}, {9, 9}, {-3, 0}}}), {0.75f, 0, 0.25f});
    check_shares(of({{{9, 9}, {1, 0}, {-3, 0}}}), {0, 0.75f, 0.25f});
    // (2t - 1)^2 + 2 t v has its minimum at t = 1/2 - v / 4.
    check_shares(of({{{1, 0}, {-1, 0}, {9, 9}}}, {0.8, 0, 50}), {0.3f, 0.7f, 0});
    // Too much noise in the one for any of it.
    check_shares(of({{{1, 0}, {-1, 0}, {9, 9}}}, {2.5, 0, 50}), {0, 1, 0});
}

TEST_CASE("a blend, worked by hand: inside") {
    // The input is the centre of gravity of (2, -1), (-1, 2), (-1, -1).
    check_shares(of({{{2, -1}, {-1, 2}, {-1, -1}}}), {1.0f / 3, 1.0f / 3, 1.0f / 3});
    // (0, 0) = 1/2 (1, 0) + 1/4 (-1, 1) + 1/4 (-1, -1).
    check_shares(of({{{1, 0}, {-1, 1}, {-1, -1}}}), {0.5f, 0.25f, 0.25f});
    // Unit vectors 120 degrees apart, g = 1 and -1/2: along x, y the gradient of 1.5 (x^2 + xy + y^2 - x - y) + .5 + x
    // v vanishes at x = 1/3 - 4 v / 9, y = 1/3 + 2 v / 9, with v halved for the factor 2 of the estimate.
    const double h = std::sqrt(0.75);
    check_shares(of({{{1, 0}, {-0.5, h}, {-0.5, -h}}}, {0.15, 0, 0}),
                 {1.0f / 3 - 4 * 0.15f / 9, 1.0f / 3 + 2 * 0.15f / 9, 1.0f / 3 + 2 * 0.15f / 9});
}

TEST_CASE("a blend's shares are a point of the simplex, never worse than a corner, nor than any point of a grid") {
    constexpr int steps = 20;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        const auto random = [&](int i) { return 2 * uniform(seed, i, 1) - 1; };
        const double size = std::pow(10, 3 * random(20));
        const statistics s =
            of({{{size * random(0), size * random(1)},
                 {size * random(2), size * random(3)},
                 {size * random(4), size * random(5)}}},
               {size * size * random(6) * 0.5, size * size * random(7) * 0.5, size * size * random(8) * 0.5},
               size * size * uniform(seed, 9, 1));
        const shares found = convex_blend::decide(s, {});
        CAPTURE(seed, found[0], found[1], found[2]);
        const float least = convex_blend::error(s, found);
        CHECK(std::min({found[0], found[1], found[2]}) >= 0);
        CHECK(found[0] + found[1] + found[2] == Approx(1).epsilon(4 * 0x1p-23));
        for (const shares& corner : {shares{1, 0, 0}, shares{0, 1, 0}, shares{0, 0, 1}})
            CHECK(least <= convex_blend::error(s, corner));
        // Sums of a dozen terms of up to 2 size^2 in floats.
        float least_of_grid = INFINITY;
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const float x = static_cast<float>(i) / steps, y = static_cast<float>(j) / steps;
                least_of_grid = std::min(least_of_grid, convex_blend::error(s, {x, y, 1 - x - y}));
            }
        CHECK(least <= least_of_grid + 24 * 2 * size * size * 0x1p-24);
    }
}

TEST_CASE("a blend of what is no number, or infinite, is the most robust candidate, or a point of the simplex") {
    statistics s = of({{{1, 0}, {-1, 0}, {0, 1}}});
    for (const float bad : {NAN, INFINITY, -INFINITY})
        for (std::size_t i = 0; i < s.size(); ++i) {
            statistics spoilt = s;
            spoilt[i] = bad;
            const shares found = convex_blend::decide(spoilt, {});
            CAPTURE(bad, i, found[0], found[1], found[2]);
            CHECK(std::min({found[0], found[1], found[2]}) >= 0);
            CHECK(found[0] + found[1] + found[2] == Approx(1).epsilon(1e-6));
        }
    s.fill(NAN);
    CHECK(convex_blend::decide(s, {}) == shares{0, 0, 1});
}
