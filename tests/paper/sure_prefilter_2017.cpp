// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <limits>
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <winnow/executor/pool.hpp>
#include <winnow/executor/simd.hpp>
#include <winnow/paper/sure_prefilter_2017.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

using prefilter = paper::sure_prefilter;
using anisotropic =
    paper::sure_prefilter_of<planes<albedo_t, normal_t, depth_t>, position_t, estimator::noise::anisotropic>;

/// A frame to clean: a floor seen from above, whose samples spread in x, as those of a moving thing do, or not at all.
struct noisy_features {
    image<> albedo_mean, albedo_a, albedo_b, normals, depths, positions, positions_a, positions_b, spread, count;

    explicit noisy_features(extent size, double motion = 0.3, int samples = 8)
        : normals(fill(size, 3, [](int x, int y, int c) { return 0.5 + 0.1 * c + 0.05 * uniform(4, x, y, c); })),
          depths(fill(size, 1, [](int x, int, int) { return 0.4 + 0.002 * x; })) {
        const double deviation[3] = {motion, 0.03, 0.001};
        const auto half = [&](std::uint64_t stream) {
            return fill(size, 3, [&, stream](int x, int y, int c) {
                const double truth = c == 0 ? 0.1 * x : c == 1 ? 0.1 * y : 2;
                return truth + deviation[c] * std::sqrt(2.0 / samples) * normal_deviate(stream, x, y, c);
            });
        };
        positions_a = half(1), positions_b = half(2);
        positions =
            fill(size, 3, [&](int x, int y, int c) { return (positions_a.at(x, y, c) + positions_b.at(x, y, c)) / 2; });
        spread = fill(size, 6, [&](int, int, int c) {
            return c == 0 ? deviation[0] * deviation[0] : c == 3 ? deviation[1] * deviation[1] : c == 5 ? 1e-6 : 0;
        });
        const auto texture = [&](const image<>& p) {
            return fill(size, 3, [&](int x, int y, int c) {
                return 0.5 + 0.3 * std::sin(2.0 * p.at(x, y, 0)) + 0.05 * c + 0.01 * y;
            });
        };
        albedo_a = texture(positions_a), albedo_b = texture(positions_b);
        albedo_mean =
            fill(size, 3, [&](int x, int y, int c) { return (albedo_a.at(x, y, c) + albedo_b.at(x, y, c)) / 2; });
        count = fill(size, 1, [&](int, int, int) { return samples; });
    }

    template <class Self, class F>
    static void each(Self& self, const F& f) {
        f("albedo", self.albedo_mean), f("albedo.halfA", self.albedo_a), f("albedo.halfB", self.albedo_b);
        f("normal", self.normals), f("depth", self.depths), f("position", self.positions);
        f("position.halfA", self.positions_a), f("position.halfB", self.positions_b);
        f("position.covariance", self.spread);
    }
    named_layers layers() const {
        named_layers all;
        each(*this, [&](const char* name, const image<>& i) { all.bind(name, i.view()); });
        return all;
    }
    extent size() const { return positions.size(); }
};

struct cleaned_images {
    std::vector<image<>> mean, variance, half_a, half_b;
    image<> bandwidths;
};

image<> copied(const source& s) {
    return s ? fill(s.size, s.channels, [&](int x, int y, int c) { return s.channel(c).at(x, y); }) : image<>();
}

template <class Prefilter = prefilter, class Executor = executor::simd>
cleaned_images clean(const named_layers& in, const Prefilter& f = {}, const Executor& executor = {}) {
    workspace memory;
    cleaned_images r;
    r.bandwidths = image<>(in.find(position).size);
    for (const cleaned_feature& c : f(in, executor, memory, r.bandwidths.view())) {
        r.mean.push_back(copied(c.mean)), r.variance.push_back(copied(c.variance));
        r.half_a.push_back(copied(c.half_a)), r.half_b.push_back(copied(c.half_b));
    }
    return r;
}

double mean_square_difference(const image<>& a, const image<>& b) {
    double sum = 0;
    for (int c = 0; c < a.channels(); ++c)
        for (int y = 0; y < a.size().height; ++y)
            for (int x = 0; x < a.size().width; ++x) {
                const double d = double{a.at(x, y, c)} - double{b.at(x, y, c)};
                sum += d * d;
            }
    return sum / (static_cast<double>(a.size().pixels()) * a.channels());
}

}  // namespace

TEST_CASE("samples that do not spread leave every feature as it is, bit for bit") {
    noisy_features in({31, 22}, 0);
    const auto check = [&](const char* what) {
        CAPTURE(what);
        for (const cleaned_images& r : {clean(in.layers()), clean(in.layers(), anisotropic{}),
                                        clean(in.layers(), prefilter{}, executor::serial<double>{})}) {
            CHECK(beyond(0, r.mean[0], in.albedo_mean) == "");
            CHECK(beyond(0, r.mean[1], in.normals) == "");
            CHECK(beyond(0, r.mean[2], in.depths) == "");
            CHECK(largest_magnitude(r.bandwidths) == 0);
        }
    };
    in.spread = image<>(in.size(), 6);
    check("positions of a plane");
    in.positions = fill(in.size(), 3, [](int, int, int c) { return c == 2 ? 1e4 : 0; });
    check("one position");
    in.positions = fill(in.size(), 3, [](int x, int y, int c) { return c == 0 ? 1e6 + x : c == 1 ? y : 0; });
    check("positions far away");
}

TEST_CASE("a window with one position is averaged as a whole, whatever its features are") {
    const extent size{15, 13};
    const image<> values = fill(size, 3, structure), positions = fill(size, 3, [](int, int, int c) { return c; }),
                  precisions = fill(size, 6, [](int, int, int c) { return 100 + c; }),
                  bandwidths = fill(size, 1, [](int, int, int) { return 0.4; });
    image<> filtered(size, 3);
    prefilter{}.along_positions()(
        filtering(position, frame{position = positions.view(), precision(position) = precisions.view(),
                                  bandwidth = bandwidths.view()}),
        output{}.layer(values.view(), filtered.view()));
    double sum = 0;
    for (int y = 3; y < 10; ++y)
        for (int x = 4; x < 11; ++x) sum += values.at(x, y, 1);
    CHECK(filtered.at(7, 6, 1) == Approx(sum / 49));
}

TEST_CASE("noise that goes with positions goes, and the variance says what is left") {
    const extent size{64, 48};
    noisy_features in(size);
    const image<> truth = fill(size, 3, [](int x, int y, int c) {
        // The mean of sin(2 p) over the means of four samples of deviation .3.
        return 0.5 + 0.3 * std::exp(-2 * 0.09 / 4) * std::sin(0.2 * x) + 0.05 * c + 0.01 * y;
    });
    const double before = mean_square_difference(in.albedo_mean, truth);
    // An estimate that takes noise along x for noise along all axes finds a worse bandwidth.
    double least = before;
    for (const bool all_directions : {false, true}) {
        const cleaned_images r = all_directions ? clean(in.layers(), anisotropic{}) : clean(in.layers());
        const double after = mean_square_difference(r.mean[0], truth);
        CAPTURE(before, after, all_directions);
        CHECK(after < least);
        least = after;
        CHECK(mean_square_difference(r.half_a[0], r.half_b[0]) < mean_square_difference(in.albedo_a, in.albedo_b));
        // (A - B)^2 / 4 on average, as the blur keeps means but for borders
        double variance = 0;
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) variance += r.variance[0].at(x, y, c);
        CHECK(variance / (3.0 * static_cast<double>(size.pixels())) ==
              Approx(mean_square_difference(r.half_a[0], r.half_b[0]) / 4).epsilon(0.02));
    }
}

TEST_CASE("in focus it switches itself off: the next pixel is two footprints away") {
    // Per axis the variance of a box of 0.1: 0.01 / 12, so that d = 2 * 12 = 24 and at h = 2 the weight is .05.
    const extent size{24, 20};
    noisy_features in(size);
    in.positions = fill(size, 3, [](int x, int y, int c) { return c == 0 ? 0.1 * x : c == 1 ? 0.1 * y : 2; });
    in.spread = fill(size, 6, [](int, int, int c) { return c == 0 || c == 3 ? 0.01 / 12 : 0; });
    const image<> at_most = fill(size, 1, [](int, int, int) { return 2; });
    image<> precisions(size, 6), filtered(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const auto a = regularized_precision({0.01f / 12, 0, 0, 0.01f / 12, 0, 0}, 2, 1e-4);
            for (int c = 0; c < 6; ++c) precisions.at(x, y, c) = a[static_cast<std::size_t>(c)];
        }
    const image<> lit = fill(size, 1, [](int x, int y, int) { return x == 11 && y == 10 ? 1 : 0; });
    prefilter{}.along_positions()(
        filtering(position, frame{position = in.positions.view(), precision(position) = precisions.view(),
                                  bandwidth = at_most.view()}),
        output{}.layer(lit.view(), filtered.view()));
    CHECK(filtered.at(10, 10) / filtered.at(11, 10) == Approx(std::exp(-24 / 8.0)).epsilon(1e-3));
}

TEST_CASE("units and axes of the world change nothing") {
    noisy_features in({40, 30}), turned = in;
    const cleaned_images expected = clean(in.layers());
    // Twice as large, x and z exchanged, and moved by less than what floats lose.
    for (const auto image_of : {&noisy_features::positions, &noisy_features::positions_a, &noisy_features::positions_b})
        turned.*image_of =
            fill(in.size(), 3, [&](int x, int y, int c) { return 2 * (in.*image_of).at(x, y, 2 - c) + 0.5 * c; });
    const int exchanged[] = {5, 4, 2, 3, 1, 0};
    turned.spread = fill(in.size(), 6, [&](int x, int y, int c) { return 4 * in.spread.at(x, y, exchanged[c]); });
    const cleaned_images found = clean(turned.layers());
    CHECK(beyond(2e-3, found.bandwidths, expected.bandwidths) == "");
    for (std::size_t i = 0; i < 3; ++i) CHECK(beyond(1e-3, found.mean[i], expected.mean[i]) == "");
}

TEST_CASE("serial in double is what the others compute, whatever threads and tiles") {
    const noisy_features in({70, 41});
    const cleaned_images expected = clean(in.layers(), prefilter{}, executor::serial<double>{});
    const cleaned_images once = clean(in.layers());
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(beyond(1e-5, once.mean[i], expected.mean[i]) == "");
        CHECK(beyond(1e-5, clean(in.layers(), prefilter{}, executor::serial<>{}).mean[i], expected.mean[i]) == "");
    }
    for (const int threads : {1, 2, 5}) {
        executor::fresh_threads tasks{threads};
        const cleaned_images again =
            clean(in.layers(), prefilter{}, executor::pool{tasks, executor::simd{.tile = {16 * threads, 8}}});
        CHECK(beyond(0, again.bandwidths, once.bandwidths) == "");
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(beyond(0, again.mean[i], once.mean[i]) == "");
            CHECK(beyond(0, again.variance[i], once.variance[i]) == "");
        }
    }
}

TEST_CASE("a crop with a halo around it is cleaned as the whole is") {
    const noisy_features in({90, 80});
    const prefilter f;
    const int around = halo(f);
    const rectangle inner{around, around, 90 - around, 80 - around}, crop{1, 2, 89, 79};
    REQUIRE(inner.size().width > 4);
    REQUIRE(inner.size().height > 4);
    noisy_features part = in;
    noisy_features::each(part, [&](const char*, image<>& i) {
        i = copied(source(image_view<const float>(image<>(i).view().crop(crop))));
    });
    const cleaned_images whole = clean(in.layers()), cut = clean(part.layers());
    int different = 0;
    for (int y = inner.y0 + 2; y < inner.y1 - 2; ++y)
        for (int x = inner.x0 + 2; x < inner.x1 - 2; ++x) {
            different += whole.mean[0].at(x, y, 1) != cut.mean[0].at(x - crop.x0, y - crop.y0, 1);
            different += whole.variance[0].at(x, y, 1) != cut.variance[0].at(x - crop.x0, y - crop.y0, 1);
            different += whole.bandwidths.at(x, y) != cut.bandwidths.at(x - crop.x0, y - crop.y0);
        }
    CHECK(different == 0);
}

TEST_CASE("flips and transposition commute with it") {
    const noisy_features in({38, 27});
    const cleaned_images before = clean(in.layers());
    const auto check = [&](extent to, const auto& from) {
        noisy_features moved = in;
        noisy_features::each(moved, [&](const char*, image<>& i) {
            const image<> old = i;
            i = fill(to, i.channels(), [&](int x, int y, int c) {
                const auto [fx, fy] = from(x, y);
                return old.at(fx, fy, c);
            });
        });
        const cleaned_images after = clean(moved.layers());
        const image<> expected = fill(to, 3, [&](int x, int y, int c) {
            const auto [fx, fy] = from(x, y);
            return before.mean[0].at(fx, fy, c);
        });
        CHECK(beyond(1e-5, after.mean[0], expected) == "");
    };
    check({38, 27}, [](int x, int y) { return std::pair{37 - x, y}; });
    check({38, 27}, [](int x, int y) { return std::pair{x, 26 - y}; });
    check({27, 38}, [](int x, int y) { return std::pair{y, x}; });
}

TEST_CASE("bad and extreme positions touch nothing beyond their surroundings, and give numbers") {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const noisy_features good({64, 50});
    const cleaned_images expected = clean(good.layers());
    for (const float bad : {nan, inf, -inf, 1e30f}) {
        noisy_features in = good;
        for (int c = 0; c < 3; ++c) in.positions.at(32, 25, c) = bad;
        in.spread.at(20, 20, 0) = bad;
        in.spread.at(45, 30, 5) = bad;
        in.albedo_mean.at(10, 40, 1) = bad == 1e30f ? 1.0f : bad;
        for (const cleaned_images& r : {clean(in.layers()), clean(in.layers(), anisotropic{})})
            for (std::size_t i = 0; i < 3; ++i) {
                int numbers = 0, values = 0;
                for (int c = 0; c < r.mean[i].channels(); ++c)
                    for (int y = 0; y < 50; ++y)
                        for (int x = 0; x < 64; ++x, ++values) numbers += is_finite(r.mean[i].at(x, y, c));
                CHECK(numbers == values);
            }
        CHECK(clean(in.layers()).mean[0].at(2, 2, 0) == expected.mean[0].at(2, 2, 0));
        CHECK(clean(in.layers()).mean[0].at(61, 3, 0) == expected.mean[0].at(61, 3, 0));
    }
}

TEST_CASE("sky beside geometry, covariances of every rank, one sample or two: features stay in their range") {
    const extent size{48, 40};
    noisy_features in(size);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c) in.positions.at(x, y, c) = 1e4f + (c == 2 ? 0.0f : static_cast<float>(x));
            for (int c = 0; c < 6; ++c) in.spread.at(x, y, c) = 0;
            // The last row of the sky is half of it floor.
            if (y == 19)
                for (const int c : {0, 3, 5}) in.spread.at(x, y, c) = 2.5e7f;
        }
    for (int x = 0; x < size.width; ++x)
        for (int y = 20; y < 40; ++y) {
            if (x % 4 == 0)
                for (int c = 0; c < 6; ++c) in.spread.at(x, y, c) = 0;
            if (x % 4 == 1) in.spread.at(x, y, 0) = 0;
            if (x % 4 == 2) in.spread.at(x, y, 3) = in.spread.at(x, y, 0) * 1e-12f;
        }
    for (const float samples : {1.0f, 2.0f, 8.0f}) {
        prefilter f;
        f.numbers.samples = samples;
        const cleaned_images r = clean(in.layers(), f);
        float low = 1e30f, high = -1e30f;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                low = std::min(low, in.albedo_mean.at(x, y)), high = std::max(high, in.albedo_mean.at(x, y));
        int outside = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                outside += !(r.mean[0].at(x, y) >= low - 1e-6f && r.mean[0].at(x, y) <= high + 1e-6f);
        CHECK(outside == 0);
        // Clear sky, beyond the reach of its edge, is left alone.
        CHECK(r.mean[0].at(5, 3) == in.albedo_mean.at(5, 3));
    }
}

TEST_CASE("a million units from the origin it is as near it, if positions are told relative to the camera") {
    // What floats there can tell apart is a sixteenth of a unit: below that there is neither footprint nor precision.
    noisy_features in({40, 30});
    noisy_features far = in;
    for (const auto image_of : {&noisy_features::positions, &noisy_features::positions_a, &noisy_features::positions_b})
        far.*image_of =
            fill(in.size(), 3, [&](int x, int y, int c) { return 1e6 + 1e-3 * (in.*image_of).at(x, y, c); });
    far.spread = fill(in.size(), 6, [&](int x, int y, int c) { return 1e-6 * in.spread.at(x, y, c); });
    noisy_features relative = far;
    for (const auto image_of : {&noisy_features::positions, &noisy_features::positions_a, &noisy_features::positions_b})
        relative.*image_of = fill(in.size(), 3, [&](int x, int y, int c) { return 1e-3 * (in.*image_of).at(x, y, c); });
    const cleaned_images near = clean(in.layers());
    CHECK(beyond(1e-3, clean(relative.layers()).mean[0], near.mean[0]) == "");
    // Absolute ones say nothing, and so nothing is done to the features but averaging what lies at one place.
    for (const float value : {clean(far.layers()).mean[0].at(20, 15, 0)}) CHECK(is_finite(value));
}

TEST_CASE("the number of samples may differ from pixel to pixel") {
    const noisy_features in({30, 24});
    named_layers layers = in.layers();
    layers.bind("sample_count", in.count.view());
    prefilter f;
    const cleaned_images expected = clean(layers, f);
    f.numbers.samples = 100;  // the frame's goes before it
    CHECK(beyond(0, clean(layers, f).mean[0], expected.mean[0]) == "");
    CHECK(beyond(1e-7, clean(in.layers(), f).bandwidths, expected.bandwidths) != "");
}

TEST_CASE("what is not there, or does not fit, is said before any work") {
    const noisy_features in({12, 10});
    const auto without = [&](const char* name) {
        named_layers layers = in.layers();
        layers.bind(name, source{});
        return layers;
    };
    CHECK_THROWS_WITH(clean(without("position.covariance")), Catch::Contains("needs position.covariance"));
    CHECK_THROWS_WITH(clean(without("normal")), Catch::Contains("needs normal"));
    named_layers layers = in.layers();
    const image<> small({11, 10}, 6), three({12, 10}, 3);
    layers.bind("position.covariance", small.view());
    CHECK_THROWS_WITH(clean(layers), Catch::Contains("position.covariance is 11x10, position is 12x10"));
    layers.bind("position.covariance", three.view());
    CHECK_THROWS_WITH(clean(layers), Catch::Contains("position.covariance has 3 channels, it needs 6"));
    prefilter f;
    f.numbers.samples = 0;
    CHECK_THROWS_WITH(clean(in.layers(), f), Catch::Contains("samples is 0"));
    // Without halves nothing is known of what noise is left.
    const cleaned_images r = clean(without("albedo.halfA"));
    CHECK(r.variance[0].channels() == 0);
    CHECK(r.mean[0].channels() == 3);
}

TEST_CASE("a second run allocates nothing, and a plan knows what the first takes") {
    const noisy_features in({40, 30});
    const prefilter f;
    const executor::simd executor;
    workspace memory;
    const named_layers layers = in.layers();
    f(layers, executor, memory);
    const run_plan p = plan(f, in.size(), executor);
    CHECK(memory.images.size() + memory.clean.size() == p.image_bytes);
    CHECK(memory.tiles.size() == p.scratch_bytes);
}

TEST_CASE("with many samples restraint keeps it from being worse than the features were") {
    // A texture as fine as the window: positions may be averaged, what they carry may not.
    const extent size{64, 48};
    const auto texture = [](double x) { return 0.5 + 0.3 * std::sin(1.2 * x); };
    noisy_features in(size, 0.3, 512);
    const auto mean_of = [&](const image<>& p, const image<>& q) {
        return fill(size, 3, [&](int x, int y, int c) { return (p.at(x, y, c) + q.at(x, y, c)) / 2; });
    };
    const auto half = [&](std::uint64_t stream) {
        return fill(size, 3,
                    [&, stream](int x, int y, int c) { return texture(x) + 0.02 * normal_deviate(stream, x, y, c); });
    };
    in.albedo_a = half(8), in.albedo_b = half(9);
    in.albedo_mean = mean_of(in.albedo_a, in.albedo_b);
    const image<> truth = fill(size, 3, [&](int x, int, int) { return texture(x); });
    prefilter f;
    f.numbers.samples = 512;
    const double before = mean_square_difference(in.albedo_mean, truth);
    const double published = mean_square_difference(clean(in.layers(), f).mean[0], truth);
    f.numbers.restraint = 3;
    const double restrained = mean_square_difference(clean(in.layers(), f).mean[0], truth);
    CAPTURE(before, published, restrained);
    CHECK(published > 10 * before);
    CHECK(restrained < before);
}
