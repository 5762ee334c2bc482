// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/guided_2010.hpp>
#include "paper/laws.hpp"

using namespace winnow;
using namespace winnow::test;

static_assert(std::is_same_v<paper::guided, paper::guided_of<planes<normal_t, depth_t>>>);
static_assert(std::is_same_v<guided_with_error, decltype(paper::guided_of<planes<albedo_t, normal_t, depth_t>>{}.with(
                                                    estimator::residual_variance{}))>);

namespace {

any_filter guided_by(paper::guided_numbers n) { return erased(paper::guided{n}); }
any_filter by_color(paper::guided_numbers n) { return erased(guided_by_color{n}); }
const std::vector<any_filter> both = {guided_by({.radius = 3, .epsilon = 1e-2f}),
                                      by_color({.radius = 3, .epsilon = 1e-2f})};

constexpr extent size{35, 23};
constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::serial, executor_kind::simd};

template <class Value>
void set(image<>& i, const Value& value) {
    i = fill(i.size(), i.channels(), value);
}

/// The mean over all windows around a pixel of their means.
image<> box_of_box(const image<>& u, int radius) { return box_mean(box_mean(u, radius), radius); }

}  // namespace

TEST_CASE("guided: a constant is a fixed point") {
    for (const any_filter& f : both) check_constant(f);
}
TEST_CASE("guided: flips, transposition and turns commute") {
    for (const any_filter& f : both) check_equivariant(f);
}
TEST_CASE("guided: the unit of radiance does not matter, where a guide in it has its epsilon in it too") {
    check_scaling([](double) { return guided_by({.radius = 3, .epsilon = 1e-2f}); });
    const extent s{37, 22};
    const buffers in = make_buffers(s);
    buffers scaled = in;
    set(scaled.color, [&](int x, int y, int c) { return 64 * in.color.at(x, y, c); });
    for (const executor_kind kind : kinds) {
        image<> found = by_color({.radius = 3, .epsilon = 4096e-2f}).images(scaled.layers(), s, {kind})[0];
        set(found, [before = found](int x, int y, int c) { return before.at(x, y, c) / 64; });
        CHECK(beyond(1e-5, found, by_color({.radius = 3, .epsilon = 1e-2f}).images(in.layers(), s, {kind})[0]) == "");
    }
}
TEST_CASE("guided: hazards") {
    for (const any_filter& f : both) check_hazards(f);
}

TEST_CASE("guided: neither the identity nor the plain mean, on a noisy edge that guides show") {
    const extent s{53, 38};
    buffers in = make_buffers(s);
    set(in.normal, [](int x, int y, int c) { return 0.5 * structure(x, y, c) + 0.005 * normal_deviate(7, x, y, c); });
    set(in.depth, [](int x, int y, int) { return 0.3 * structure(x, y, 1) + 0.005 * normal_deviate(8, x, y); });
    const image<> clean = fill(s, 3, structure), box = box_of_box(in.color, 3);
    for (const executor_kind kind : kinds) {
        const image<> found = guided_by({.radius = 3, .epsilon = 1e-3f}).images(in.layers(), s, {kind})[0];
        CHECK(mean_square(found, clean) < 0.25 * mean_square(in.color, clean));
        CHECK(mean_square(found, clean) < 0.25 * mean_square(box, clean));
    }
}

TEST_CASE("guided: three pixels in a row, worked by hand") {
    // Windows of two, three and two pixels; one guide of slopes 6, 6 and 3 / 4 of what is asked for, with a ridge.
    const extent s{3, 1};
    buffers in = make_buffers(s);
    const float g[] = {0, 1, 4}, u[] = {1, 3, 2};
    set(in.normal, [](int, int, int) { return 0; });
    set(in.depth, [&](int x, int, int) { return g[x]; });
    set(in.color, [&](int x, int, int) { return u[x]; });
    // Window 0: means 1/2 and 2, variance 1/4, covariance 1/2.  Window 1: 5/3 and 2, 26/9 and 1/3.  Window 2: 5/2 and
    // 5/2, 9/4 and -3/4.  With epsilon = 1/4 the slopes are 1, 12/113 and -3/10.
    const double slope[] = {1, 12.0 / 113, -0.3}, at_zero[] = {1.5, 2 - 12.0 / 113 * 5 / 3, 3.25};
    const auto said = [&](int k, int x) { return slope[k] * g[x] + at_zero[k]; };
    const double expected[] = {(said(0, 0) + said(1, 0)) / 2, (said(0, 1) + said(1, 1) + said(2, 1)) / 3,
                               (said(1, 2) + said(2, 2)) / 2};
    for (const executor_kind kind : kinds) {
        const image<> found = guided_by({.radius = 1, .epsilon = 0.25f}).images(in.layers(), s, {kind})[0];
        for (int x = 0; x < 3; ++x)
            for (int c = 0; c < 3; ++c) CHECK(found.at(x, 0, c) == Approx(expected[x]).epsilon(1e-6));
    }
}

TEST_CASE("guided: by itself at a small epsilon the image, the nearer the smaller it is") {
    buffers in = make_buffers(size);
    set(in.color, [before = in.color](int x, int y, int c) { return 100 * before.at(x, y, c); });
    for (const executor_kind kind : kinds) {
        const image<> found = by_color({.radius = 3, .epsilon = 1e-4f}).images(in.layers(), size, {kind})[0];
        CHECK(beyond(5e-4, found, in.color) == "");  // epsilon over the smallest standard deviation in a window
        CHECK(beyond(5e-3, by_color({.radius = 3, .epsilon = 100}).images(in.layers(), size, {kind})[0], in.color) !=
              "");
    }
}

TEST_CASE("guided: at a large epsilon, or by a constant, the box of the box") {
    buffers in = make_buffers(size);
    const image<> expected = box_of_box(in.color, 3);
    for (const executor_kind kind : kinds)
        CHECK(beyond(1e-5, guided_by({.radius = 3, .epsilon = 1e6f}).images(in.layers(), size, {kind})[0], expected) ==
              "");
    for (const double constant : {0.0, 0.5, 1.0}) {
        set(in.normal, [&](int, int, int) { return constant; });
        set(in.depth, [&](int, int, int) { return 1 - constant; });
        for (const executor_kind kind : kinds)
            CHECK(beyond(1e-5, guided_by({.radius = 3, .epsilon = 1e-4f}).images(in.layers(), size, {kind})[0],
                         expected) == "");
    }
}

TEST_CASE("guided: an image that is linear in the guides stays, up to what the ridge takes") {
    buffers in = make_buffers(size);
    set(in.color, [&](int x, int y, int c) {
        return 3 * in.normal.at(x, y, 0) - 2 * in.normal.at(x, y, c) + (c + 1.0) * in.depth.at(x, y) + 5;
    });
    set(in.normal, [before = in.normal](int x, int y, int c) { return 1024 * before.at(x, y, c); });
    set(in.depth, [before = in.depth](int x, int y, int) { return 1024 * before.at(x, y); });
    // Along a direction of variance v a slope a loses a share epsilon / (v + epsilon), and none of 49 pixels is further
    // than 7 sqrt v from the mean: 7 a sqrt(epsilon) / 2 at most.
    const double bound = 7 * std::sqrt(9.0 + 4 + 9) / 1024 * 0.01 / 2;
    for (const executor_kind kind : kinds)
        CHECK(beyond(bound, guided_by({.radius = 3, .epsilon = 1e-4f}).images(in.layers(), size, {kind})[0],
                     in.color) == "");
}

TEST_CASE("guided: guides that say the same thing several times say it once") {
    buffers one = make_buffers(size), four = one;
    set(one.normal, [](int, int, int) { return 0; });
    set(four.normal, [&](int x, int y, int c) { return c == 2 ? 0.5 * one.depth.at(x, y) : one.depth.at(x, y); });
    // Slopes in proportion: a ridge of epsilon on one guide is one of (1 + 1 + 1/4 + 1) epsilon on the four.
    for (const executor_kind kind : kinds)
        CHECK(beyond(2e-4, guided_by({.radius = 3, .epsilon = 3.25e-3f}).images(four.layers(), size, {kind})[0],
                     guided_by({.radius = 3, .epsilon = 1e-3f}).images(one.layers(), size, {kind})[0]) == "");
}

TEST_CASE("guided: more guides than pixels in a window are no hazard") {
    for (const extent s : {extent{1, 1}, extent{2, 1}, extent{1, 3}, extent{5, 5}}) {
        const buffers in = make_buffers(s);
        for (const int radius : {0, 1}) {
            const auto f = erased(guided_with_error{{.radius = radius, .epsilon = 1e-4f}});
            const image<> expected = f.images(in.layers(), s)[0];
            CHECK(all_finite(expected));
            CHECK(beyond(1e-4, f.images(in.layers(), s, {executor_kind::simd})[0], expected) == "");
            if (radius == 0) CHECK(other_bits(expected, in.color) == "");
        }
    }
}

TEST_CASE("guided: guides far from 0 do not cancel") {
    buffers in = make_buffers(size), near = in;
    set(in.depth, [&](int x, int y, int) { return 4096 + near.depth.at(x, y); });  // exact: multiples of 1/256
    const any_filter f = guided_by({.radius = 3, .epsilon = 1e-3f});
    const image<> expected = f.images(near.layers(), size)[0];
    CHECK(beyond(1e-5, f.images(in.layers(), size)[0], expected) == "");
    // Offsets are in float: slopes of at most 10 for a depth of 4096.
    CHECK(beyond(10 * 4096 * 0x1p-23, f.images(in.layers(), size, {executor_kind::simd})[0], expected) == "");
}

TEST_CASE("guided: a pixel of 1e8 changes nothing that it cannot reach") {
    const buffers in = make_buffers(size);
    buffers bright = in;
    bright.color.at(17, 11, 1) = 1e8f;
    for (const executor_kind kind : kinds) {
        const image<> before = both[0].images(in.layers(), size, {kind})[0],
                      after = both[0].images(bright.layers(), size, {kind})[0];
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                for (int c = 0; c < 3; ++c)
                    if (c != 1 || std::abs(x - 17) > 6 || std::abs(y - 11) > 6)
                        CHECK(after.at(x, y, c) == before.at(x, y, c));
    }
}

TEST_CASE("guided: further layers add up to the colour, and halves to its double") {
    const buffers in = make_buffers(size);
    image<> first(size, 3), second(size, 3);
    set(first, [&](int x, int y, int c) { return in.color.at(x, y, c) * uniform(9, x, y, c); });
    set(second, [&](int x, int y, int c) { return in.color.at(x, y, c) - first.at(x, y, c); });
    for (const executor_kind kind : kinds) {
        image<> mean(size, 3), a(size, 3), b(size, 3), one(size, 3), two(size, 3);
        both[0](
            in.layers(),
            output{mean}.halves(a.view(), b.view()).layer(first.view(), one.view()).layer(second.view(), two.view()),
            {kind});
        const auto sum = [&](const image<>& x, const image<>& y, double by) {
            return fill(size, 3, [&](int i, int j, int c) { return by * (x.at(i, j, c) + y.at(i, j, c)); });
        };
        CHECK(beyond(2e-6, sum(one, two, 1), mean) == "");
        CHECK(beyond(2e-6, sum(a, b, 0.5), mean) == "");
    }
}

TEST_CASE("guided: the error is what filtered halves differ by") {
    const buffers in = make_buffers(size);
    const auto f = erased(guided_with_error{{.radius = 3, .epsilon = 1e-2f}});
    for (const executor_kind kind : kinds) {
        image<> mean(size, 3), a(size, 3), b(size, 3), error(size, 3), alone(size, 3);
        f(in.layers(), output{mean}.halves(a.view(), b.view()).error(error.view()), {kind});
        f(in.layers(), output{mean}.error(alone.view()), {kind});
        const image<> expected = fill(size, 3, [&](int x, int y, int c) {
            const float half = (a.at(x, y, c) - b.at(x, y, c)) / 2;
            return half * half;
        });
        CHECK(other_bits(error, expected) == "");
        CHECK(other_bits(alone, expected) == "");
    }
}

TEST_CASE("guided: numbers and outputs that it cannot have are refused by name") {
    const buffers in = make_buffers({8, 8});
    image<> mean({8, 8}, 3), more({8, 8}, 3), one({8, 8});
    const auto message = [&](const any_filter& f, const output& out) -> std::string {
        try {
            f(in.layers(), out);
        } catch (const invalid_input& e) {
            return e.what();
        }
        return "";
    };
    CHECK(message(guided_by({.radius = 2}), output{mean}) == "");
    CHECK(message(guided_by({.radius = -1}), output{mean}) == "window: radius is -1, it must be 0 or more");
    for (const float epsilon : {0.0f, 9e-5f, -1.0f, NAN})
        CHECK_THAT(message(guided_by({.epsilon = epsilon}), output{mean}), Catch::Contains("epsilon"));
    CHECK_THAT(message(guided_by({}), output{mean}.derivative(more.view())), Catch::Contains("derivatives"));
    CHECK_THAT(message(guided_by({}), output{mean}.support(one.view())), Catch::Contains("weights"));
    CHECK_THAT(message(guided_by({}), output{mean}.error(more.view())), Catch::Contains("estimator"));
}
