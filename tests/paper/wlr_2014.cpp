// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/wlr_2014.hpp>
#include "paper/laws.hpp"
#include "support/counting_new.hpp"

using namespace winnow;
using namespace winnow::test;

static_assert(std::is_same_v<paper::wlr, paper::wlr_of<planes<albedo_t, normal_t, depth_t>>>);
static_assert(paper::wlr_regressors<paper::wlr::features>::count == 9);

namespace {

any_filter wlr(paper::wlr_numbers n) { return erased(paper::make_wlr(n)); }
const any_filter f = wlr({.radius = 3}), whole = wlr({});

constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::simd};

/// Features without noise, of which none is a linear function of the others.
buffers exact_features(extent size) {
    buffers in = make_buffers(size);
    const auto wavy = [&](int channels, double period) {
        return fill(size, channels, [=](int x, int y, int c) {
            return 0.5 + 0.3 * std::sin((x * (c + 1) + 2.3 * y) / period) + 0.2 * std::cos((3.1 * x - y * (c + 2)) / 7);
        });
    };
    in.albedo = wavy(3, 3), in.normal = wavy(3, 4.1), in.depth = wavy(1, 5.7);
    in.albedo_variance = in.normal_variance = image<>(size, 3), in.depth_variance = image<>(size, 1);
    return in;
}

/// A colour that is linear in the features and the position.
image<> linear_color(const buffers& in) {
    return fill(in.size(), 3, [&](int x, int y, int c) {
        return 2 + 0.01 * x - 0.02 * y + 0.5 * in.albedo.at(x, y, c) - 0.3 * in.normal.at(x, y, 2 - c) +
               0.4 * in.depth.at(x, y) * (c + 1);
    });
}

image<> constant(extent size, int channels, double value) {
    return fill(size, channels, [=](int, int, int) { return value; });
}

paper::wlr_trial_results planted(double a_0, double a_1, int d, double b_0, double b_1) {
    paper::wlr_trial_results trials{};
    for (std::size_t t = 0; t < paper::wlr_trials; ++t) {
        const double h = paper::wlr_shares[t];
        trials.variance[t] = static_cast<float>(a_0 + a_1 / std::pow(h, d));
        for (std::size_t c = 0; c < 3; ++c) trials.filtered[t][c] = static_cast<float>(b_0 + b_1 * h * h);
    }
    return trials;
}

/// Moments of a 7x7 window of regressors dx, dy and two more.
template <class More>
paper::wlr_moments<double, 4> window_of(const More& more, double noise_of_last) {
    paper::wlr_moments<double, 4> m;
    for (int dy = -3; dy <= 3; ++dy)
        for (int dx = -3; dx <= 3; ++dx) {
            double z[4] = {double(dx), double(dy)};
            more(dx, dy, z);
            m.add<1>(z);
            m.noise[3] += noise_of_last;
        }
    m.pixels = 49;
    return m;
}

}  // namespace

TEST_CASE("WLR: a constant is a fixed point") { check_constant(f); }
TEST_CASE("WLR: the unit of radiance does not matter") {
    check_scaling([](double a) { return wlr({.radius = 3, .unit = static_cast<float>(a)}); });
}
// A system of a condition of 1e3 or so is solved in float.
TEST_CASE("WLR: flips, transposition and turns commute") { check_equivariant(f, 1e-4); }
TEST_CASE("WLR: neither the identity nor the plain mean") { check_useful(f, 3); }
TEST_CASE("WLR: hazards") { check_hazards(f); }

TEST_CASE("WLR: what is linear in the features is reproduced, though it is taken for noisy") {
    const extent size{45, 33};
    buffers in = exact_features(size);
    in.color = linear_color(in);
    in.color_variance = constant(size, 3, 1);
    for (const executor_kind kind : kinds)
        CHECK(beyond(2e-3, whole.images(in.layers(), size, {kind})[0], in.color) == "");
    // A checkerboard is not linear in any feature.
    in.color = fill(size, 3, [&](int x, int y, int) { return (x + y) % 2; });
    for (const executor_kind kind : kinds) {
        const image<> grey = constant(size, 3, 0.5);
        CHECK(mean_square(whole.images(in.layers(), size, {kind})[0], grey) < 0.05 * mean_square(in.color, grey));
    }
}

TEST_CASE(
    "WLR: noise about what is linear in the features is taken away, and the estimated error says how much is left") {
    const extent size{64, 48};
    buffers in = exact_features(size);
    const image<> truth = linear_color(in);
    in.color = fill(size, 3, [&](int x, int y, int c) { return truth.at(x, y, c) + 0.3 * normal_deviate(3, x, y, c); });
    in.color_variance = constant(size, 3, 0.09);
    for (const executor_kind kind : kinds) {
        image<> mean(size, 3), error(size, 3);
        whole(in.layers(), output{mean}.error(error.view()), {kind});
        const double left = mean_square(mean, truth);
        CHECK(left < 0.25 * 0.09);
        double estimated = 0;
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) estimated += error.at(x, y, c);
        estimated /= 3.0 * 64 * 48;
        CAPTURE(left, estimated);
        CHECK(estimated > 0.5 * left);
        CHECK(estimated < 2 * left);
    }
}

TEST_CASE("WLR: the unit and the origin of a feature do not matter") {
    const extent size{41, 29};
    const buffers in = make_buffers(size);
    buffers other = in;
    other.albedo = fill(size, 3, [&](int x, int y, int c) { return 2 * in.albedo.at(x, y, c) - 4; });
    other.albedo_variance = fill(size, 3, [&](int x, int y, int c) { return 4 * in.albedo_variance.at(x, y, c); });
    other.depth = fill(size, 1, [&](int x, int y, int) { return 1024 * in.depth.at(x, y); });
    other.depth_variance = fill(size, 1, [&](int x, int y, int) { return 0x1p20 * in.depth_variance.at(x, y); });
    for (const executor_kind kind : kinds)
        CHECK(beyond(1e-3, f.images(other.layers(), size, {kind})[0], f.images(in.layers(), size, {kind})[0]) == "");
}

TEST_CASE("WLR: the bandwidth of the least error, in closed form") {
    const paper::wlr_selection select(1, 9);
    // d = 2, a_1 = 1e-4, b_1 = 0.1 in each channel: (2 1e-4 / (4 0.03))^(1/6).
    const auto two = select(planted(0.5, 1e-4, 2, 0.7, 0.1), 2);
    CHECK(two.bandwidth == Approx(std::pow(2e-4 / 0.12, 1.0 / 6)).epsilon(1e-4));
    for (const float squared : two.squared_bias) CHECK(squared == Approx(0.01).epsilon(1e-4));
    for (const int d : {1, 5, 9}) {
        const auto found = select(planted(0.1, 1e-6, d, 0.3, -0.2), d);
        CHECK(found.bandwidth == Approx(std::pow(d * 1e-6 / (4 * 3 * 0.04), 1.0 / (d + 4))).epsilon(1e-2));
    }
    // In the limits: no bias, no variance, nothing at all.
    CHECK(select(planted(0, 1e-3, 3, 1, 0), 3).bandwidth == 1);
    CHECK(select(planted(0, 0, 3, 1, 0.1), 3).bandwidth == paper::wlr_least_bandwidth);
    CHECK(select(planted(0, 1e-3, 0, 1, 0.1), 0).bandwidth == paper::wlr_least_bandwidth);
    // Where the bias is no larger than its noise, it is none.
    auto noisy = planted(0, 1e-3, 3, 1, 0.1);
    noisy.bias_variance = {0.01f, 0.011f, 0.01f};
    CHECK(select(noisy, 3).bandwidth == 1);
    noisy.bias_variance = {0.005f, 0.01f, 0.005f};
    CHECK(select(noisy, 3).bandwidth > select(planted(0, 1e-3, 3, 1, 0.1), 3).bandwidth);
}

TEST_CASE("WLR: a feature of pure noise is dropped, a strong one kept") {
    for (const std::uint64_t stream : {1, 2, 3}) {
        const auto features = [&](int dx, int dy, double* z) {
            z[2] = uniform(10 + stream, dx + 9, dy + 9) - 0.5;
            z[3] = 0.1 * (normal_deviate(20 + stream, dx + 9, dy + 9) - normal_deviate(20 + stream, 9, 9));
        };
        const paper::wlr_subspace<double, 4> s(window_of(features, 2 * 0.01), 0.01f);
        CHECK(s.rank == 3);
        double strong = 0;
        for (int k = 0; k < 4; ++k) {
            CHECK(s.to[k][3] == 0);
            strong += std::abs(s.to[k][2]);
        }
        CHECK(strong > 1);
        // The same values, known to be exact, are a feature like any other.
        CHECK(paper::wlr_subspace<double, 4>(window_of(features, 0), 0.01f).rank == 4);
    }
}

TEST_CASE("WLR: of two features that differ by their noise alone, one direction is kept") {
    const auto features = [](int dx, int dy, double* z) {
        const double common = uniform(11, dx + 9, dy + 9) - 0.5;
        z[2] = common + 0.05 * normal_deviate(21, dx + 9, dy + 9);
        z[3] = common + 0.05 * normal_deviate(22, dx + 9, dy + 9);
    };
    auto m = window_of(features, 2 * 0.0025);
    m.noise[2] = m.noise[3];
    CHECK(paper::wlr_subspace<double, 4>(m, 0.01f).rank == 3);
}

TEST_CASE("WLR: constant features are dropped, collinear ones count once") {
    const auto rank = [](const auto& features) {
        return paper::wlr_subspace<double, 4>(window_of(features, 0), 0.01f).rank;
    };
    CHECK(rank([](int, int, double*) {}) == 2);
    CHECK(rank([](int dx, int dy, double* z) { z[2] = dx + 2 * dy, z[3] = 5 * dx; }) == 2);
    CHECK(rank([](int dx, int dy, double* z) { z[2] = z[3] = dx * dy; }) == 3);
}

TEST_CASE("WLR: one smoother for all layers") {
    const extent size{37, 26};
    const buffers in = make_buffers(size);
    const image<> ones = constant(size, 1, 1);
    for (const executor_kind kind : kinds) {
        image<> mean(size, 3), a(size, 3), b(size, 3), layer(size, 3), of_ones(size);
        f(in.layers(),
          output{mean}
              .halves(a.view(), b.view())
              .layer(in.color.view(), layer.view())
              .layer(ones.view(), of_ones.view()),
          {kind});
        CHECK(other_bits(layer, mean) == "");
        CHECK(beyond(1e-6, of_ones, ones) == "");
        CHECK(beyond(1e-5, fill(size, 3, [&](int x, int y, int c) { return (a.at(x, y, c) + b.at(x, y, c)) / 2; }),
                     mean) == "");
    }
}

TEST_CASE("WLR: nothing negative comes of what is not") {
    const extent size{48, 32};
    buffers in = exact_features(size);
    // At the border, before the foot of a ramp, a line through the window's pixels lies below 0.
    in.color = fill(size, 3, [](int x, int, int c) { return std::max(0, x - 2) * 0.1 * (c + 1); });
    in.albedo = in.normal = image<>(size, 3), in.depth = image<>(size, 1);
    in.color_variance = constant(size, 3, 1);
    for (const executor_kind kind : kinds) {
        const image<> found = f.images(in.layers(), size, {kind})[0];
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) REQUIRE(found.at(x, y, c) >= 0);
    }
}

TEST_CASE("WLR: without neighbours the input, bit for bit") {
    const extent size{21, 13};
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds) {
        CHECK(other_bits(wlr({.radius = 0}).images(in.layers(), size, {kind})[0], in.color) == "");
        // A kernel that only the pixel itself is in.
        CHECK(beyond(1e-6, wlr({.radius = 3, .flatness = 1e20f}).images(in.layers(), size, {kind})[0], in.color) == "");
    }
}

TEST_CASE("WLR: images smaller than the window") {
    for (const extent size : {extent{1, 1}, extent{7, 1}, extent{5, 4}}) {
        const buffers in = make_buffers(size);
        const image<> expected = whole.images(in.layers(), size)[0];
        CHECK(all_finite(expected));
        CHECK(beyond(1e-3, whole.images(in.layers(), size, {executor_kind::simd})[0], expected) == "");
    }
}

TEST_CASE("WLR: the sky, fireflies and pixels that are no numbers") {
    const extent size{60, 40};
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds) {
        buffers bad = in;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < size.width; ++x) bad.depth.at(x, y) = 1e30f;
        CHECK(all_finite(f.images(bad.layers(), size, {kind})[0]));
        bad.color.at(20, 20, 1) = 1e8f, bad.color_variance.at(20, 20, 1) = 1e16f;
        CHECK(all_finite(f.images(bad.layers(), size, {kind})[0]));

        buffers holes = in;
        const float nan = std::numeric_limits<float>::quiet_NaN();
        holes.color.at(10, 10, 0) = nan, holes.albedo.at(12, 11, 2) = nan, holes.depth_variance.at(11, 9) = nan;
        holes.color_variance.at(9, 12, 1) = std::numeric_limits<float>::infinity();
        image<> clean = f.images(in.layers(), size, {kind})[0], found = f.images(holes.layers(), size, {kind})[0];
        CHECK(all_finite(found));
        CHECK(other_bits(found, clean) != "");
        const rectangle far{12 + f.halo + 1, 0, size.width, size.height};
        const auto part = [&](const image<>& i) { return image_view<const float>(i.view().crop(far)); };
        CHECK(other_bits(part(found), part(clean)) == "");
    }
}

TEST_CASE("WLR: a crop with its halo gives the same bits inside") {
    const extent size{70, 50};
    const buffers in = make_buffers(size);
    const rectangle part{9, 5, 65, 47};
    const rectangle inner{part.x0 + f.halo, part.y0 + f.halo, part.x1 - f.halo, part.y1 - f.halo};
    const image<> all = f.images(in.layers(), size, {executor_kind::simd})[0];
    const image<> some = f.images(in.layers(part), part.size(), {executor_kind::simd})[0];
    const rectangle there{inner.x0 - part.x0, inner.y0 - part.y0, inner.x1 - part.x0, inner.y1 - part.y0};
    CHECK(other_bits(image_view<const float>(some.view().crop(there)),
                     image_view<const float>(all.view().crop(inner))) == "");
}

TEST_CASE("WLR: the same bits for any tiles and threads") {
    const extent size{75, 41};
    const buffers in = make_buffers(size);
    const image<> expected = f.images(in.layers(), size, {executor_kind::simd})[0];
    for (const how h : {how{executor_kind::simd, 1, {16, 8}}, how{executor_kind::simd, 1, {33, 100}},
                        how{executor_kind::openmp, 2, {20, 7}}, how{executor_kind::pool, 3, {80, 5}}}) {
        CAPTURE(to_string(h));
        CHECK(other_bits(f.images(in.layers(), size, h)[0], expected) == "");
    }
    const image<> serial = f.images(in.layers(), size, {executor_kind::serial})[0];
    CHECK(other_bits(f.images(in.layers(), size, {executor_kind::openmp_serial, 2})[0], serial) == "");
}

TEST_CASE("WLR: lanes agree with the definition") {
    const extent size{75, 41};
    for (const std::uint64_t seed : {1, 2}) {
        const buffers in = make_buffers(size, seed);
        const image<> expected = f.images(in.layers(), size)[0];
        for (const executor_kind kind : {executor_kind::serial, executor_kind::simd}) {
            const image<> found = f.images(in.layers(), size, {kind})[0];
            CHECK(beyond(2e-3, found, expected) == "");
            const difference d =
                compare(found.view(), expected.view(), [](double a, double b) { return std::abs(a - b); });
            CHECK(d.mean < 3e-6);
        }
    }
}

TEST_CASE("WLR: a feature without variance is exact") {
    const extent size{33, 22};
    const buffers in = exact_features(size);
    named_layers frame;
    buffers::each(in, [&](const std::string& name, const image<>& i) {
        if (name.find("variance") == std::string::npos || name.starts_with("color")) frame.bind(name, source(i.view()));
    });
    CHECK(other_bits(f.images(frame, size)[0], f.images(in.layers(), size)[0]) == "");
}

TEST_CASE("WLR: what does not fit is refused before any work") {
    const extent size{12, 9};
    const buffers in = make_buffers(size);
    image<> result(size, 3);
    const auto refused = [&](const auto& make, const char* message) {
        CHECK_THROWS_WITH(make(), Catch::Contains(message));
    };
    refused([&] { wlr({.radius = -1})(in.layers(), result); }, "radius is -1");
    refused([&] { wlr({.unit = 0})(in.layers(), result); }, "unit");
    const image<> low({12, 8}, 3);
    named_layers other = in.layers();
    other.bind("normal.variance", source(low.view()));
    refused([&] { f(other, result); }, "normal.variance is 12x8, color is 12x9");
    named_layers without;
    without.bind("color", source(in.color.view()));
    refused([&] { f(without, result); }, "color.variance");
    image<> small({3, 3}, 3);
    refused([&] { f(in.layers(), small); }, "the output is 3x3");
    refused([&] { f(in.layers(), output{result}.derivative(result.view())); }, "derivative");
}

TEST_CASE("WLR: a plan says what a run takes, and a second run allocates nothing") {
    const extent size{50, 40};
    const buffers in = make_buffers(size);
    const named_layers frame = in.layers();
    image<> result(size, 3);
    const output out{result};
    workspace memory;
    const how h{executor_kind::simd};
    f.run(frame, std::span(&out, 1), h, memory);
    CHECK(f.plan(size, h, 3).scratch_bytes == memory.tiles.size());
    const long long before = allocations_so_far().count;
    f.run(frame, std::span(&out, 1), h, memory);
    CHECK(allocations_so_far().count == before);
}
