// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/a_trous_2010.hpp>
#include "paper/laws.hpp"
#include "support/counting_new.hpp"

using namespace winnow;
using namespace winnow::test;
using a_trous = paper::a_trous_of<planes<normal_t, depth_t>>;

namespace {

constexpr extent size{35, 23};
constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::simd};
constexpr float wide = 1e6f;

any_filter erase_it(paper::a_trous_numbers n) { return erased(a_trous{n}); }
paper::a_trous_numbers without_edges(int levels) {
    return {.levels = levels, .sigma_color = wide, .sigma_normal = wide, .sigma_position = wide, .sigma_other = wide};
}
const any_filter f = erase_it({.levels = 2, .sigma_color = 1, .sigma_normal = 0.5f, .sigma_other = 0.5f});

/// One pass of 1, 4, 6, 4, 1 along an axis, `step` pixels apart; taps beyond the image are not in the sum.
image<> pass(const image<>& u, int step, bool along_x) {
    const double taps[] = {1, 4, 6, 4, 1};
    image<> result(u.size());
    for (int y = 0; y < u.size().height; ++y)
        for (int x = 0; x < u.size().width; ++x) {
            double sum = 0, total = 0;
            for (int t = -2; t <= 2; ++t) {
                const int i = x + (along_x ? t * step : 0), j = y + (along_x ? 0 : t * step);
                if (i < 0 || j < 0 || i >= u.size().width || j >= u.size().height) continue;
                sum += taps[t + 2] * double{u.at(i, j)}, total += taps[t + 2];
            }
            result.at(x, y) = static_cast<float>(sum / total);
        }
    return result;
}

}  // namespace

TEST_CASE("A-Trous: a constant is a fixed point") { check_constant(f); }
TEST_CASE("A-Trous: results stay within the values of the window") { check_convex(f, 6); }
TEST_CASE("A-Trous: flips, transposition and turns commute") { check_equivariant(f); }
TEST_CASE("A-Trous: hazards") { check_hazards(f); }
TEST_CASE("A-Trous: the unit of radiance does not matter, where sigma is in that unit") {
    check_scaling([](double a) {
        return erase_it({.levels = 2, .sigma_color = static_cast<float>(a), .sigma_normal = 0.5f, .sigma_other = 0.5f});
    });
}
TEST_CASE("A-Trous: neither the identity nor the plain mean") {
    check_useful(erase_it({.levels = 2, .sigma_color = 0.7f, .sigma_normal = 1, .sigma_other = 1}), 6);
}

TEST_CASE("A-Trous: at sigma 0 the input, bit for bit") {
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds)
        CHECK(other_bits(erase_it({.levels = 3, .sigma_color = 0}).images(in.layers(), size, {kind})[0], in.color) ==
              "");
}

TEST_CASE("A-Trous: without edges it is the cascade of splines, along one axis and the other") {
    const buffers in = make_buffers(size);
    for (const int levels : {1, 2, 4, 5}) {
        image<> expected(size, 3);
        for (int c = 0; c < 3; ++c) {
            image<> u(size);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) u.at(x, y) = in.color.at(x, y, c);
            for (int i = 0; i < levels; ++i) u = pass(pass(u, 1 << i, true), 1 << i, false);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) expected.at(x, y, c) = u.at(x, y);
        }
        for (const executor_kind kind : kinds) {
            CAPTURE(levels, static_cast<int>(kind));
            const image<> found = erase_it(without_edges(levels)).images(in.layers(), size, {kind})[0];
            CHECK(beyond(4e-6 * largest_magnitude(in.color), found, expected) == "");
        }
    }
}

TEST_CASE("A-Trous: five levels spread an impulse by a variance of (4^5 - 1) / 3 pixels, symmetrically") {
    const extent large{257, 257};  // no border in reach of any pixel that the impulse reaches
    const int centre = 128;
    buffers in = make_buffers(large);
    in.color = fill(large, 3, [&](int x, int y, int) { return x == centre && y == centre; });
    const image<> found = erase_it(without_edges(5)).images(in.layers(), large, {executor_kind::simd})[0];
    double sum = 0, variance = 0;
    int lopsided = 0;
    for (int y = 0; y < large.height; ++y)
        for (int x = 0; x < large.width; ++x) {
            const double w = found.at(x, y);
            sum += w, variance += w * (x - centre) * (x - centre);
            for (const float other : {found.at(2 * centre - x, y), found.at(x, 2 * centre - y), found.at(y, x)})
                lopsided += !(std::abs(w - other) <= 1e-6 * w + 1e-12);
        }
    CHECK(lopsided == 0);
    CHECK(sum == Approx(1).epsilon(1e-5));
    CHECK(variance / sum == Approx(341).epsilon(1e-4));
    CHECK(found.at(centre - 63, centre) == 0);  // 2 (1 + 2 + 4 + 8 + 16) = 62
    CHECK(found.at(centre - 62, centre) > 0);
}

TEST_CASE("A-Trous: an edge of the normals is not blurred across, however many levels") {
    buffers in = make_buffers(size);
    const auto left = [](int x) { return x < 17; };
    in.normal = fill(size, 3, [&](int x, int, int c) { return c == 0 ? (left(x) ? 1 : -1) : 0; });
    in.depth = image<>(size, 1);
    const image<> side = fill(size, 1, [&](int x, int, int) { return left(x); });
    for (const executor_kind kind : kinds) {
        paper::a_trous_numbers n = without_edges(3);
        n.sigma_normal = 0.1f;
        image<> mean(size, 3), shares(size, 1);
        erase_it(n)(in.layers(), output{mean}.layer(side.view(), shares.view()), {kind});
        CHECK(beyond(1e-6, shares, side) == "");
    }
}

TEST_CASE("A-Trous: halves and layers go along, and the error is what the halves show") {
    const buffers in = make_buffers(size);
    for (const bool demodulate : {false, true}) {
        const any_filter g =
            erase_it({.levels = 3, .sigma_color = 1, .sigma_normal = 1, .sigma_other = 1, .demodulate = demodulate});
        image<> mean(size, 3), a(size, 3), b(size, 3), error(size, 3), layer(size, 3), alone(size, 3);
        output out{mean};
        g(in.layers(), out.halves(a.view(), b.view()).error(error.view()).layer(in.half_a.view(), layer.view()),
          {executor_kind::simd});
        const double scale = largest_magnitude(in.color);
        CHECK(beyond(4e-6 * scale,
                     fill(size, 3, [&](int x, int y, int c) { return (a.at(x, y, c) + b.at(x, y, c)) / 2; }),
                     mean) == "");
        CHECK(other_bits(layer, a) == "");
        const image<> expected = fill(size, 3, [&](int x, int y, int c) {
            const double d = (a.at(x, y, c) - b.at(x, y, c)) / 2;
            return d * d;
        });
        CHECK(beyond(1e-6 * scale, error, expected) == "");
        g(in.layers(), output{alone}, {executor_kind::simd});
        CHECK(other_bits(alone, mean) == "");
    }
}

TEST_CASE("A-Trous: demodulated, texture under even light comes out as it was") {
    buffers in = make_buffers(size);
    in.albedo = fill(size, 3, [](int x, int y, int c) { return 0.1 + 0.8 * uniform(31, x, y, c); });
    in.color = fill(size, 3, [&](int x, int y, int c) { return 3.0 * in.albedo.at(x, y, c); });
    for (const executor_kind kind : kinds)
        CHECK(beyond(1e-5,
                     erase_it({.levels = 5, .sigma_color = 1, .demodulate = true}).images(in.layers(), size, {kind})[0],
                     in.color) == "");
}

TEST_CASE("A-Trous: the bits depend neither on tiles nor on threads, nor on what lies beyond the halo") {
    const extent large{150, 40};
    const buffers in = make_buffers(large);
    const any_filter g = erase_it({.levels = 4, .sigma_color = 1, .sigma_normal = 1, .sigma_other = 1});
    const image<> expected = g.images(in.layers(), large, {executor_kind::simd})[0];
    for (const extent tile : {extent{16, 5}, extent{64, 64}, extent{1000, 3}})
        CHECK(other_bits(g.images(in.layers(), large, {executor_kind::openmp, 2, tile})[0], expected) == "");
    REQUIRE(g.halo == 2 * 15 + 4);
    const rectangle crop{0, 0, 60 + g.halo, 40};
    const image<> part = g.images(in.layers(crop), crop.size(), {executor_kind::simd})[0];
    int different = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x) different += part.at(x, y) != expected.at(x, y);
    CHECK(different == 0);
}

TEST_CASE("A-Trous: what does not fit is refused before any work") {
    const buffers in = make_buffers(size);
    image<> mean(size, 3), plane(size, 1);
    CHECK_THROWS_WITH(a_trous{{.levels = 0}}(in.layers(), output{mean}), Catch::Contains("a_trous: levels is 0"));
    CHECK_THROWS_WITH(a_trous{}(in.layers(), output{mean}.support(plane.view())), Catch::Contains("no derivative"));
    named_layers some;
    some.bind("color", in.color.view()), some.bind("normal", in.normal.view()), some.bind("depth", in.depth.view());
    CHECK_THROWS_WITH(a_trous{{.demodulate = true}}(some, output{mean}), Catch::Contains("the filter needs albedo"));
    image<> error(size, 3);
    CHECK_THROWS_WITH(a_trous{}(some, output{mean}.error(error.view())), Catch::Contains("color.halfA"));
}

TEST_CASE("A-Trous: a second run with the same workspace allocates nothing") {
    const buffers in = make_buffers(size);
    const named_layers frame = in.layers();
    image<> mean(size, 3), a(size, 3), b(size, 3);
    output out{mean};
    out.halves(a.view(), b.view());
    workspace memory;
    const a_trous filter{{.demodulate = true}};
    filter(frame, out, executor::openmp{.threads = 2}, memory);
    const long long before = allocations_so_far().count;
    filter(frame, out, executor::openmp{.threads = 2}, memory);
    CHECK(allocations_so_far().count - before == 0);
}
