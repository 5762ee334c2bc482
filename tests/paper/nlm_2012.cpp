// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/nlm_2012.hpp>
#include "paper/laws.hpp"
#include "paper/pure_noise.hpp"

using namespace winnow;
using namespace winnow::test;

// The typedef is the expression.
static_assert(
    std::is_same_v<paper::nlm, decltype(filter{exponential(patch(noise_normalized(color, {.k = 0.45f}), {.radius = 3})),
                                               window::square{.radius = 10}})>);
static_assert(std::is_same_v<paper::nlm_2012, decltype(dual_buffer{paper::make_nlm()})>);
static_assert(std::is_same_v<paper::nlm_2012_released,
                             decltype(dual_buffer{filter{patch_mean(exponential(patch(noise_normalized(color)))),
                                                         window::square{.radius = 10}}})>);
static_assert(paper::make_nlm({.radius = 5, .patch_radius = 2, .k = 1, .epsilon = 1e-8f}) ==
              filter{exponential(patch(noise_normalized(color, {.k = 1, .epsilon = 1e-8f}), {.radius = 2})),
                     window::square{.radius = 5}});
static_assert(paper::make_nlm_2012({.radius = 5}).filter == paper::make_nlm({.radius = 5}));

namespace {

any_filter plain(paper::nlm_2012_numbers n) { return erased(paper::make_nlm(n)); }
any_filter dual(paper::nlm_2012_numbers n) { return erased(paper::make_nlm_2012(n)); }
any_filter released(paper::nlm_2012_numbers n) { return erased(paper::make_nlm_2012_released(n)); }
const std::vector<any_filter> all = {plain({.radius = 3, .patch_radius = 1}), dual({.radius = 3, .patch_radius = 1}),
                                     released({.radius = 3, .patch_radius = 1})};

constexpr extent size{35, 23};
constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::simd};

buffers without_variance(buffers in) {
    for (image<>* i : {&in.color_variance, &in.half_a_variance, &in.half_b_variance}) *i = image<>(in.size(), 3);
    return in;
}

}  // namespace

TEST_CASE("non-local means: a constant is a fixed point") {
    for (const any_filter& f : all) check_constant(f);
}
TEST_CASE("non-local means: no weight exceeds the centre's, even where noise explains more than is seen") {
    for (const any_filter& f : all) check_weights(f, 3);
}
TEST_CASE("non-local means: results stay within the values of the window") {
    for (const any_filter& f : all) check_convex(f, 3);
}
TEST_CASE("non-local means: flips, transposition and turns commute") {
    for (const any_filter& f : all) check_equivariant(f);
}
TEST_CASE("non-local means: the unit of radiance does not matter, where epsilon is in that unit") {
    for (const auto make : {plain, dual, released})
        check_scaling([make](double a) {
            return make({.radius = 3, .patch_radius = 1, .epsilon = static_cast<float>(1e-10 * a * a)});
        });
}
TEST_CASE("non-local means: neither the identity nor the plain mean") {
    for (const any_filter& f : all) check_useful(f, 3);
}
TEST_CASE("non-local means: hazards") {
    for (const any_filter& f : all) check_hazards(f);
}

TEST_CASE("non-local means: without variance and without equal patches, the input, bit for bit") {
    const buffers in = without_variance(make_buffers(size));
    for (const executor_kind kind : kinds) {
        CHECK(other_bits(all[0].images(in.layers(), size, {kind})[0], in.color) == "");
        CHECK(other_bits(all[1].images(in.layers(), size, {kind})[0], in.color) == "");
    }
}

TEST_CASE("non-local means: a large k gives the box mean") {
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds)
        for (const auto make : {plain, dual, released})
            CHECK(beyond(2e-6 * largest_magnitude(in.half_a),
                         make({.radius = 3, .patch_radius = 1, .k = 1e4f}).images(in.layers(), size, {kind})[0],
                         box_mean(in.color, 3)) == "");
}

TEST_CASE("non-local means: without variance only equal patches are averaged") {
    // Columns repeat every 4 pixels: with patches in the image the mean is over equal columns, which changes nothing.
    buffers in = without_variance(make_buffers(size));
    in.color = fill(size, 3, [](int x, int y, int c) { return uniform(3, x % 4, y, c); });
    std::vector<image<>> share(2, image<>(size));
    const image<> lit = fill(size, 1, [](int x, int y, int) { return x == 17 && y == 11; });
    for (const executor_kind kind : kinds) {
        all[0](in.layers(), output{}.layer(lit.view(), share[0].view()), {kind});
        CHECK(share[0].at(17, 11) == 1);  // windows of radius 3 do not reach the next equal column
        plain({.radius = 4, .patch_radius = 1})(in.layers(), output{}.layer(lit.view(), share[1].view()), {kind});
        for (const int x : {13, 17, 21}) CHECK(share[1].at(x, 11) == Approx(1.0 / 3).epsilon(1e-6));
        CHECK(share[1].at(14, 11) < 1e-30f);
    }
}

// Oracle values of independent simulations: mean off-centre weight and residual variance; 1 / 441 = .00227 is the box.
TEST_CASE("non-local means: weights and residual variance on pure noise are as simulated") {
    struct {
        float k;
        int patch_radius;
        double weight, residual;
    } const oracles[] = {
        {0.45f, 1, 0.738, 0.00791}, {0.45f, 3, 0.834, 0.00268}, {1, 1, 0.910, 0.00270}, {1, 3, 0.955, 0.00231}};
    for (const auto& o : oracles) {
        const auto found = pure_noise(plain({.radius = 10, .patch_radius = o.patch_radius, .k = o.k}), 10, 16);
        CAPTURE(o.k, o.patch_radius, found.off_centre_weight.mean, found.off_centre_weight.error, found.residual.mean,
                found.residual.error);
        CHECK(found.off_centre_weight.agrees_with(o.weight));
        CHECK(found.off_centre_weight.error < 0.01);
        CHECK(found.residual.agrees_with(o.residual));
        CHECK(found.residual.error < 0.06 * o.residual);
    }
}

TEST_CASE("non-local means: as k goes to 0, about half of the pairs on pure noise are kept, in full") {
    // k = 0.03 is small enough that hardly any weight lies between 0 and 1.
    for (const auto& [patch_radius, oracle] : {std::pair{1, 0.542}, std::pair{3, 0.517}}) {
        const auto kept =
            pure_noise(plain({.radius = 10, .patch_radius = patch_radius, .k = 0.03f}), 10, 16).off_centre_weight;
        CAPTURE(patch_radius, kept.mean, kept.error);
        CHECK(kept.agrees_with(oracle));
        CHECK(kept.error < 0.01);
    }
}

TEST_CASE(
    "dual-buffer non-local means: no value decides its own weight, so less noise is left than in the plain filter") {
    const paper::nlm_2012_numbers n{.radius = 10, .patch_radius = 1};
    const auto left = pure_noise(dual(n), 10, 6).residual, left_by_plain = pure_noise(plain(n), 10, 6).residual;
    CHECK(left.mean < 0.6 * left_by_plain.mean);
    CHECK(left.mean > 1.0 / 441 - 4 * left.error);  // less than the box leaves is impossible but for chance
}
