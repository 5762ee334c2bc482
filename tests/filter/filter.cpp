// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <type_traits>
#include <winnow/filter/filter.hpp>
#include "support/catch.hpp"
#include "support/filters.hpp"
#include "winnow/distance/squared_difference.hpp"
#include "winnow/estimator/residual_variance.hpp"
#include "winnow/weight/gaussian.hpp"
#include "winnow/window/disk.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr extent size{37, 22};
constexpr auto blur = filter{gaussian(l2(albedo), 0.2f), window::square{.radius = 2}};
constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::serial, executor_kind::simd};

/// n products and their sum, divided by the sum of n weights: each side rounds n times, and the division once.
double sum_bound(int radius) { return 2 * ((2 * radius + 1) * (2 * radius + 1) + 2) * 0x1p-24; }

}  // namespace

static_assert(std::is_trivially_copyable_v<std::remove_const_t<decltype(blur)>>);
static_assert(blur == filter{gaussian(l2(albedo), 0.2f), window::square{.radius = 2}});
static_assert(!(blur == filter{gaussian(l2(albedo), 0.3f), window::square{.radius = 2}}));
static_assert(!(blur == blur.with(border::mirror)));
static_assert(std::is_same_v<decltype(filter{gaussian(l2(albedo), 1)}.window), window::square>);

// `with` changes one thing.
static_assert(blur.with(window::disk{.radius = 3}).window.radius == 3);
static_assert(blur.with(window::disk{.radius = 3}).weight == blur.weight);
static_assert(blur.with(border::clamp).with(estimator::residual_variance{}).border == border::clamp);
static_assert(blur.with(window::square{.radius = 2}) == blur);

TEST_CASE("the executor is an argument: without one the filter is the definition, in float") {
    const buffers in = make_buffers(size);
    image<> found(size, 3), expected(size, 3);
    blur(in.layers(), found);
    blur(in.layers(), expected, executor::serial<float>{});
    CHECK(other_bits(found, expected) == "");
    CHECK(other_bits(found, in.color) != "");
}

TEST_CASE("a frame known to the compiler and one known at run time are the same") {
    const buffers in = make_buffers(size);
    image<> found(size, 3), expected(size, 3);
    blur(frame{color = in.color.view(), albedo = in.albedo.view()}, found);
    blur(in.layers(), expected);
    CHECK(other_bits(found, expected) == "");
}

TEST_CASE("an output without a mean asks only for the rest") {
    const buffers in = make_buffers(size);
    image<> found(size, 1), expected(size, 1), mean(size, 3);
    blur(in.layers(), output{}.layer(in.depth.view(), found.view()));
    blur(in.layers(), output{mean}.layer(in.depth.view(), expected.view()));
    CHECK(other_bits(found, expected) == "");
}

TEST_CASE("the sum of filtered layers is the filtered sum") {
    const buffers in = make_buffers(size), lights = make_buffers(size, 2);
    // Two light groups, one with negative values, that add up to the colour.
    const image<> direct = lights.half_a;
    const image<> indirect =
        fill(size, 3, [&](int x, int y, int c) { return in.color.at(x, y, c) - direct.at(x, y, c); });
    const double scale = largest_magnitude(in.color) + largest_magnitude(direct) + largest_magnitude(indirect);
    for (const any_filter& f : {joint_bilateral(), nlm(), rdfc_candidate(), product_with_cutoff()})
        for (const executor_kind kind : kinds) {
            image<> mean(size, 3), first(size, 3), second(size, 3);
            f(in.layers(), output{mean}.layer(direct.view(), first.view()).layer(indirect.view(), second.view()),
              {kind});
            const image<> sum = fill(
                size, 3, [&](int x, int y, int c) { return double{first.at(x, y, c)} + double{second.at(x, y, c)}; });
            CAPTURE(f.name, static_cast<int>(kind));
            CHECK(beyond(sum_bound(3) * scale, sum, mean) == "");
            CHECK(other_bits(first, direct) != "");
        }
}

TEST_CASE("a further layer that is the colour comes out as the colour does, bit for bit") {
    const buffers in = make_buffers(size);
    for (const any_filter& f : {joint_bilateral(), nlm(), rdfc_candidate()})
        for (const executor_kind kind : kinds) {
            image<> mean(size, 3), layer(size, 3);
            f(in.layers(), output{mean}.layer(in.color.view(), layer.view()), {kind});
            CHECK(other_bits(mean, layer) == "");
        }
}

TEST_CASE("the mean of the filtered halves is the filtered mean") {
    const buffers in = make_buffers(size);
    for (const any_filter& f : {joint_bilateral(), nlm(), rdfc_candidate()})
        for (const executor_kind kind : kinds) {
            image<> mean(size, 3), a(size, 3), b(size, 3);
            f(in.layers(), output{mean}.halves(a.view(), b.view()), {kind});
            const image<> of_both =
                fill(size, 3, [&](int x, int y, int c) { return (double{a.at(x, y, c)} + double{b.at(x, y, c)}) / 2; });
            CAPTURE(f.name, static_cast<int>(kind));
            CHECK(beyond(sum_bound(3) * largest_magnitude(in.half_a), of_both, mean) == "");
            CHECK(beyond(1e-3, a, b) != "");
            // The weights are those of the whole: asking for halves changes nothing else.
            CHECK(other_bits(mean, f.images(in.layers(), size, {kind})[0]) == "");
        }
}

namespace {
float squared(float x) { return x * x; }
}  // namespace

TEST_CASE("the residual variance is that of half the difference of the filtered halves, bit for bit") {
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds) {
        image<> mean(size, 3), a(size, 3), b(size, 3), error(size, 3), error_alone(size, 3);
        nlm_with_error()(in.layers(), output{mean}.halves(a.view(), b.view()).error(error.view()), {kind});
        const image<> expected =
            fill(size, 3, [&](int x, int y, int c) { return squared((a.at(x, y, c) - b.at(x, y, c)) / 2); });
        CHECK(other_bits(error, expected) == "");
        nlm_with_error()(in.layers(), output{}.error(error_alone.view()), {kind});
        CHECK(other_bits(error_alone, expected) == "");
    }
}

namespace {
/// A weight against the law: even the centre has none.
struct nobody {
    using role = winnow::role::weight;
    using reads = planes<>;
    template <class Real, class Planes>
    Real operator()(const pixel_pair<Real, Planes>&) const {
        return Real(0);
    }
};
}  // namespace

TEST_CASE("where no neighbour counts, not even the pixel itself, it keeps its value") {
    const buffers in = make_buffers(size);
    image<> found(size, 3);
    filter{nobody{}, window::square{.radius = 1}}(in.layers(), found);
    CHECK(other_bits(found, in.color) == "");
}

TEST_CASE("the halo is the window, the patches, the gradient and one pixel for mending") {
    CHECK(halo(blur) == 3);
    CHECK(nlm({.radius = 5, .patch_radius = 3}).halo == 5 + 3 + 1);
    CHECK(patch_of_patch({.radius = 5, .patch_radius = 3}).halo == 5 + 3 + 2 + 1);
    CHECK(rdfc_candidate({.radius = 5, .patch_radius = 3}).halo == 5 + 3 + 1 + 1);
    CHECK(test::disk({.radius = 4}).halo == 5);
}
