// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/rdfc_2013_candidate.hpp>
#include "paper/laws.hpp"
#include "paper/pure_noise.hpp"

using namespace winnow;
using namespace winnow::test;

// The typedef is the expression.
static_assert(
    std::is_same_v<paper::rdfc_candidate,
                   decltype(filter{min(exponential(patch(noise_normalized(color, {.k = 0.45f}), {.radius = 3})),
                                       exponential(max(cross(albedo), cross(normal), cross(depth)))),
                                   window::square{.radius = 10}})>);
static_assert(paper::make_rdfc_candidate() ==
              filter{min(exponential(patch(noise_normalized(color, {.k = 0.45f}), {.radius = 3})),
                         exponential(max(cross(albedo), cross(normal), cross(depth)))),
                     window::square{.radius = 10}});

namespace {

any_filter candidate(paper::rdfc_candidate_numbers n) { return erased(paper::make_rdfc_candidate(n)); }
const any_filter f = candidate({.radius = 3, .patch_radius = 1});

constexpr extent size{35, 23};
constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::simd};
constexpr float off = 1e4f;  // a k at which a distance no longer matters

/// Features that follow the structure of the colour: gentle slopes, one clear edge, little noise.
buffers with_gentle_features(extent s) {
    buffers in = make_buffers(s);
    const auto gentle = [&](int channels, std::uint64_t stream) {
        return fill(s, channels, [stream](int x, int y, int c) {
            return 0.1 * structure(x, y, c) + 0.005 * normal_deviate(stream, x, y, c);
        });
    };
    const auto variance = [&](int channels) { return fill(s, channels, [](int, int, int) { return 2.5e-5; }); };
    in.albedo = gentle(3, 11), in.normal = gentle(3, 12), in.depth = gentle(1, 13);
    in.albedo_variance = in.normal_variance = variance(3), in.depth_variance = variance(1);
    return in;
}

}  // namespace

TEST_CASE("RDFC candidate: a constant is a fixed point") { check_constant(f); }
TEST_CASE("RDFC candidate: no weight exceeds the centre's, even where numerators are negative") { check_weights(f, 3); }
TEST_CASE("RDFC candidate: results stay within the values of the window") { check_convex(f, 3); }
TEST_CASE("RDFC candidate: flips, transposition and turns commute") { check_equivariant(f); }
TEST_CASE("RDFC candidate: the unit of radiance does not matter, where epsilon is in that unit") {
    check_scaling([](double a) {
        return candidate({.radius = 3, .patch_radius = 1, .epsilon = static_cast<float>(1e-10 * a * a)});
    });
}
TEST_CASE("RDFC candidate: hazards") { check_hazards(f); }

TEST_CASE("RDFC candidate: neither the identity nor the plain mean, on a noisy edge that features show") {
    const extent s{53, 38};
    const buffers in = with_gentle_features(s);
    const image<> clean = fill(s, 3, structure), box = box_mean(in.color, 3);
    for (const executor_kind kind : kinds) {
        const image<> found = f.images(in.layers(), s, {kind})[0];
        CHECK(beyond(0.02, found, in.color) != "");
        CHECK(beyond(0.02, found, box) != "");
        CHECK(mean_square(found, clean) < 0.6 * mean_square(in.color, clean));
        CHECK(mean_square(found, clean) < 0.6 * mean_square(box, clean));
    }
}

TEST_CASE("RDFC candidate: with colour and features off, the box mean") {
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds)
        CHECK(beyond(2e-6 * largest_magnitude(in.color),
                     candidate({.radius = 3, .patch_radius = 1, .k_color = off, .k_feature = off})
                         .images(in.layers(), size, {kind})[0],
                     box_mean(in.color, 3)) == "");
}

TEST_CASE("RDFC candidate: with features off, non-local means") {
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds)
        CHECK(beyond(1e-5 * largest_magnitude(in.color),
                     candidate({.radius = 3, .patch_radius = 1, .k_feature = off}).images(in.layers(), size, {kind})[0],
                     erased(paper::make_nlm({.radius = 3, .patch_radius = 1})).images(in.layers(), size, {kind})[0]) ==
              "");
}

TEST_CASE("RDFC candidate: without variance and without equal patches, the input, bit for bit") {
    buffers in = make_buffers(size);
    in.color_variance = image<>(size, 3);
    for (const executor_kind kind : kinds) CHECK(other_bits(f.images(in.layers(), size, {kind})[0], in.color) == "");
}

TEST_CASE("RDFC candidate: the smaller weight decides, and the least similar feature") {
    // Shares of the centre, w(p,p) / C(p): C is smaller than with either weight alone.
    const buffers in = with_gentle_features(size);
    const image<> lit = fill(size, 1, [](int x, int y, int) { return x == 17 && y == 11; });
    const auto share = [&](paper::rdfc_candidate_numbers n) {
        image<> result(size);
        n.radius = 3, n.patch_radius = 1;
        candidate(n)(in.layers(), output{}.layer(lit.view(), result.view()));
        return result.at(17, 11);
    };
    const float both = share({}), of_color = share({.k_feature = off}), of_features = share({.k_color = off});
    CHECK(both > of_color);
    CHECK(both > of_features);
}

TEST_CASE("RDFC candidate: on pure noise and flat features the weights and the residual variance are as simulated") {
    struct {
        int patch_radius;
        double weight, residual;
    } const oracles[] = {{1, 0.738, 0.00791}, {3, 0.834, 0.00268}};
    for (const auto& o : oracles) {
        const auto found = pure_noise(candidate({.radius = 10, .patch_radius = o.patch_radius}), 10, 8);
        CAPTURE(o.patch_radius, found.off_centre_weight.mean, found.off_centre_weight.error, found.residual.mean,
                found.residual.error);
        CHECK(found.off_centre_weight.agrees_with(o.weight));
        CHECK(found.residual.agrees_with(o.residual));
    }
}

TEST_CASE("RDFC candidate: as k goes to 0, about half of the pairs on pure noise are kept, in full") {
    for (const auto& [patch_radius, oracle] : {std::pair{1, 0.542}, std::pair{3, 0.517}}) {
        const auto kept = pure_noise(candidate({.radius = 10, .patch_radius = patch_radius, .k_color = 0.03f}), 10, 8)
                              .off_centre_weight;
        CAPTURE(patch_radius, kept.mean, kept.error);
        CHECK(kept.agrees_with(oracle));
    }
}

TEST_CASE("RDFC candidate: a feature edge is not blurred across, though the colours on both sides are the same") {
    // A step in albedo alone; the colour is noise of one mean.
    const extent s{41, 25};
    buffers in = make_buffers(s);
    in.color = fill(s, 3, [](int x, int y, int c) { return 0.5 + 0.1 * normal_deviate(9, x, y, c); });
    in.color_variance = fill(s, 3, [](int, int, int) { return 0.01; });
    const auto left = [](int x) { return x < 20; };
    in.albedo = fill(s, 3, [&](int x, int, int) { return left(x) ? 0.2 : 0.6; });
    in.normal = image<>(s, 3), in.depth = image<>(s, 1);
    in.albedo_variance = in.normal_variance = image<>(s, 3);
    in.depth_variance = image<>(s, 1);
    const image<> side = fill(s, 1, [&](int x, int, int) { return left(x); });
    for (const executor_kind kind : kinds)
        for (const float k_color : {0.45f, off}) {
            image<> mean(s, 3), shares(s, 1);
            candidate({.radius = 5, .patch_radius = 1, .k_color = k_color})(
                in.layers(), output{mean}.layer(side.view(), shares.view()), {kind});
            CHECK(beyond(1e-30, shares, side) == "");
            // On its own side a pixel is averaged all the same.
            const image<> flat = fill(s, 3, [](int, int, int) { return 0.5; });
            CHECK(mean_square(mean, flat) < 0.2 * mean_square(in.color, flat));
        }
    // Without the feature the two sides mix.
    image<> shares(s, 1);
    candidate({.radius = 5, .patch_radius = 1, .k_feature = off})(in.layers(),
                                                                  output{}.layer(side.view(), shares.view()));
    CHECK(beyond(0.3, shares, side) != "");
}
