// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <limits>
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <winnow/frame/unit_range.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

const float nan_value = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

/// One row of pixels of one channel.
image<> row(const std::vector<float>& values) {
    image<> made({static_cast<int>(values.size()), 1});
    for (int x = 0; x < made.size().width; ++x) made.at(x, 0) = values[static_cast<std::size_t>(x)];
    return made;
}
/// The same number in all three channels but for what is put there later.
image<> constant(extent size, float value) {
    return fill(size, 3, [&](int, int, int) { return value; });
}

}  // namespace

TEST_CASE("a positive number is rounded up to three bits, others to 1") {
    for (const float exact : {1.0f, 2.0f, 0.5f, 5.0f, 6.0f, 7.0f, 0.875f, 1024.0f})
        CHECK(detail::rounded_up(exact) == exact);
    CHECK(detail::rounded_up(4.1f) == 5);
    CHECK(detail::rounded_up(7.01f) == 8);
    CHECK(detail::rounded_up(0.51f) == 0.625f);
    CHECK(detail::rounded_up(1.0001f) == 1.25f);
    for (int i = 1; i < 200; ++i) {
        const float x = 0.013f * static_cast<float>(i * i), up = detail::rounded_up(x);
        CHECK(up >= x);
        CHECK(up <= 1.25f * x);
    }
    for (const float none : {0.0f, -3.0f, nan_value}) CHECK(detail::rounded_up(none) == 1);
}

TEST_CASE("normals: from -1..1 to 0..1") {
    const image<> n = fill({3, 1}, 3, [](int x, int, int) { return x - 1; });
    for (const value_map& m : unit_range(normal, n.view())) {
        CHECK(m(-1) == 0);
        CHECK(m(0) == 0.5f);
        CHECK(m(1) == 1);
        CHECK(m.variance(0.3f, 4) == 1);
    }
}

TEST_CASE("albedo: its logarithm, over the largest of all channels") {
    image<> a = constant({4, 2}, 0.25f);
    a.at(1, 1, 2) = 1;  // log2(1 + 1) = 1: three bits already
    for (const value_map& m : unit_range(albedo, a.view())) {
        CHECK(m(0) == 0);
        CHECK(m(1) == 1);
        CHECK(m(3) == 2);
        CHECK(m(-0.5f) == 0);
    }
    a.at(0, 0, 1) = 127;  // a lamp: log2(128) = 7
    for (const value_map& m : unit_range(albedo, a.view())) {
        CHECK(m(127) == Approx(1).epsilon(1e-6));
        CHECK(m(1) == Approx(1.0 / 7).epsilon(1e-6));
    }
    a.at(0, 0, 1) = nan_value, a.at(2, 0, 0) = infinity;
    CHECK(unit_range(albedo, a.view())[0](1) == 1);  // bad pixels do not count
    CHECK(std::isnan(unit_range(albedo, a.view())[0](nan_value)));
}

TEST_CASE("depth: over its largest finite value; the sky is at 0") {
    const image<> d = row({1, 3, 5, infinity, 1e30f, nan_value, -1e10f});
    const value_map m = unit_range(depth, d.view())[0];
    CHECK(m(5) == 1);
    CHECK(m(1) == Approx(0.2).epsilon(1e-6));
    for (const float sky : {infinity, 1e30f, nan_value, -1e10f}) {
        CHECK(m(sky) == 0);
        for (const float variance : {0.5f, infinity, nan_value}) CHECK(m.variance(sky, variance) == 0);
    }
    CHECK(m.variance(3, 50) == 2);
}

TEST_CASE("positions: over the largest side of the box that holds them, from its corner") {
    image<> p({3, 1}, 3);
    const float values[3][3] = {{-2, 0, 2}, {10, 11, 10}, {5, 5, 5}};
    for (int c = 0; c < 3; ++c)
        for (int x = 0; x < 3; ++x) p.at(x, 0, c) = values[c][x];
    const auto maps = unit_range(position, p.view());
    CHECK(maps[0](-2) == 0);
    CHECK(maps[0](2) == 1);
    CHECK(maps[1](10) == 0);
    CHECK(maps[1](11) == 0.25f);  // one unit for all axes
    CHECK(maps[2](5) == 0);
}

TEST_CASE("caustics: over their 99th percentile; what is in unit range stays as it is") {
    std::vector<float> values(1000, 0.5f);
    for (int i = 0; i < 5; ++i) values[static_cast<std::size_t>(i)] = 1e6f;  // fewer than one in a hundred
    CHECK(unit_range(caustic, row(values).view())[0](0.5f) == 1);
    for (int i = 0; i < 20; ++i) values[static_cast<std::size_t>(i)] = 64;
    CHECK(unit_range(caustic, row(values).view())[0](64) == 1);
    const value_map same = unit_range(visibility, row({0.1f, 0.4f}).view())[0];
    CHECK(same(0.4f) == 0.4f);
    CHECK(same.variance(0.4f, 0.3f) == 0.3f);
}

TEST_CASE("a feature that is 0 everywhere, or no number anywhere, maps to 0") {
    for (const float value : {0.0f, nan_value}) {
        const image<> flat = constant({3, 2}, value);
        CHECK(unit_range(albedo, flat.view())[0](0) == 0);
        CHECK(unit_range(depth, row({value, value}).view())[0](0) == 0);
        CHECK(unit_range(caustic, row({value}).view())[0](0) == 0);
        for (const value_map& m : unit_range(position, flat.view())) CHECK(m(0) == 0);
    }
}

TEST_CASE("a single bad pixel rarely changes the map") {
    image<> a = fill({20, 20}, 3, [](int x, int y, int c) { return 0.8 * uniform(1, x, y, c); });
    const auto before = unit_range(albedo, a.view());
    a.at(3, 4, 1) *= 1.02f;
    const auto after = unit_range(albedo, a.view());
    CHECK(before[0].factor == after[0].factor);
}

TEST_CASE("variances are mapped with the square of the slope, to first order") {
    // Against the map itself: a value that is h above or below has the variance h^2.
    const float h = 1e-3f;
    image<> a = fill({5, 5}, 3, [](int x, int y, int c) { return 2 * uniform(2, x, y, c); });
    for (const value_map& m : {unit_range(albedo, a.view())[0], unit_range(normal, a.view())[1],
                               unit_range(depth, row({0.5f, 3}).view())[0]})
        for (const float x : {0.1f, 0.7f, 2.0f}) {
            const double half = (double{m(x + h)} - double{m(x - h)}) / 2;
            CHECK(m.variance(x, h * h) == Approx(half * half).epsilon(2e-3));
        }
    // Where the logarithm's argument is cut, its slope is that at 0.
    const value_map m = unit_range(albedo, a.view())[0];
    CHECK(m.variance(-3, 1) == m.variance(0, 1));
}

TEST_CASE("images are mapped channel by channel, in place as well") {
    const extent size{4, 3};
    const image<> p = fill(size, 3, [](int x, int y, int c) { return (c + 1) * uniform(3, x, y, c) - c; });
    const image<> variances = fill(size, 3, [](int x, int y, int c) { return uniform(4, x, y, c); });
    const auto maps = unit_range(position, p.view());
    image<> mapped(size, 3), mapped_variances(size, 3), in_place = p, variances_in_place = variances;
    map_values(maps, p.view(), mapped.view());
    map_variances(maps, p.view(), variances.view(), mapped_variances.view());
    float lowest = 1, highest = 0;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const value_map& m = maps[static_cast<std::size_t>(c)];
                CHECK(mapped.at(x, y, c) == m(p.at(x, y, c)));
                CHECK(mapped_variances.at(x, y, c) == m.variance(p.at(x, y, c), variances.at(x, y, c)));
                lowest = std::min(lowest, mapped.at(x, y, c)), highest = std::max(highest, mapped.at(x, y, c));
            }
    CHECK(lowest == 0);
    CHECK(highest > 0.8f);  // three bits lose at most a fifth
    CHECK(highest <= 1);
    map_variances(maps, in_place.view(), variances_in_place.view(), variances_in_place.view());
    map_values(maps, in_place.view(), in_place.view());
    CHECK(other_bits(in_place, mapped) == "");
    CHECK(other_bits(variances_in_place, mapped_variances) == "");
}
