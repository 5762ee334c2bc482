// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/filter/do_no_harm.hpp>

#include <support/catch.hpp>
#include <support/patterns.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

struct triple {
    image<> mean, a, b;
    with_halves views() const { return {mean.view(), a.view(), b.view()}; }
};

/// A texture of period 4 in the right half, nothing in the left; `noise` is the deviation of the mean.
double texture(int x, int y, int c, int width) {
    return 1 + 0.1 * c + (x >= width / 2 && (x / 2 + y / 2) % 2 ? 0.5 : 0.0);
}
triple noisy(extent size, double noise) {
    const auto half = [&](std::uint64_t stream) {
        return fill(size, 3, [&, stream](int x, int y, int c) {
            return texture(x, y, c, size.width) + std::sqrt(2.0) * noise * normal_deviate(stream, x, y, c);
        });
    };
    triple t{{}, half(1), half(2)};
    t.mean = fill(size, 3, [&](int x, int y, int c) { return (t.a.at(x, y, c) + t.b.at(x, y, c)) / 2; });
    return t;
}

/// The mean of 5x5: right where nothing is, harm to the texture.
triple boxed(const triple& in) {
    triple t = in;
    for (auto pair : {std::pair{&in.mean, &t.mean}, {&in.a, &t.a}, {&in.b, &t.b}})
        for (int c = 0; c < 3; ++c) {
            const source from = source(pair.first->view()).channel(c);
            std::vector<float> rows;
            detail::box_mean([&](int x, int y) { return from.at(x, y); }, target(pair.second->view()).channel(c), 2,
                             rows);
        }
    return t;
}

image<> lambda_of(const triple& in, const triple& filtered, const do_no_harm_numbers& n = {}) {
    image<> lambda(in.mean.size());
    do_no_harm(in.views(), filtered.views(), lambda.view(), n);
    return lambda;
}

double mean_over(const image<>& i, int x0, int x1) {
    double sum = 0;
    for (int y = 0; y < i.size().height; ++y)
        for (int x = x0; x < x1; ++x) sum += i.at(x, y);
    return sum / i.size().height / (x1 - x0);
}

double error(const image<>& i) {
    double sum = 0;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < i.size().height; ++y)
            for (int x = 0; x < i.size().width; ++x) {
                const double d = i.at(x, y, c) - texture(x, y, c, i.size().width);
                sum += d * d / 3 / static_cast<double>(i.size().pixels());
            }
    return sum;
}

}  // namespace

TEST_CASE("a case worked by hand") {
    // One channel; everywhere a - b = 2, f_a - f_b = 1 and f - u = 1.2: Var = 1, Cov = 1/2, harm = 1.44 - 2 (1 - 1/2).
    const auto level = [](double v) { return fill({7, 7}, 1, [=](int, int, int) { return v; }); };
    const auto expected = [](double pixels, double sigmas) {
        const double error = std::sqrt((4 * 1.44 + 6) / pixels);
        return 1 - std::clamp(0.44 / error - sigmas, 0.0, 1.0) * (1 - 0.5 / 1.44);
    };
    triple in{level(5), level(6), level(4)}, filtered{level(6.2), level(6.7), level(5.7)};
    const do_no_harm_numbers numbers{.radius = 2, .wide = 3, .sigmas = 0.25};
    for (bool whole : {true, false}) {
        const image<> lambda = lambda_of(in, filtered, numbers);
        CHECK(lambda.at(3, 3) == Approx(expected(49, 0.25)));
        CHECK(lambda.at(0, 6) == Approx(expected(16, 0.25)));
        CHECK(lambda.at(0, 3) == Approx(expected(28, 0.25)));
        // Without one pixel the means are the same.
        if (whole) in.mean.at(2, 3) = std::numeric_limits<float>::quiet_NaN();
    }
    CHECK(lambda_of(in, filtered, {.radius = 3, .wide = 2, .sigmas = 0.25}).at(3, 3) == Approx(expected(49, 0.25)));
    CHECK(lambda_of(in, filtered, {.radius = 2, .wide = 2, .sigmas = 0.25}).at(3, 3) == Approx(expected(25, 0.25)));
    CHECK(expected(49, 0.25) < 0.6);
    CHECK(expected(25, 0.25) > 0.7);
}

TEST_CASE("what a filter did well is kept, what it destroyed is brought back") {
    for (double noise : {0.01, 0.05, 0.1}) {
        const triple in = noisy({120, 60}, noise), filtered = boxed(in);
        const image<> lambda = lambda_of(in, filtered);
        CHECK(mean_over(lambda, 0, 45) > 0.998);
        CHECK(mean_over(lambda, 75, 120) < (noise < 0.09 ? 0.15 : 0.6));
        image<> blended(in.mean.size(), 3);
        blend(in.mean.view(), filtered.mean.view(), lambda.view(), blended.view());
        CHECK(error(blended) < error(in.mean));
        CHECK(error(blended) < 0.7 * error(filtered.mean));
    }
}

TEST_CASE("where noise is as strong as the texture nothing is certain, and the filter stays") {
    const triple in = noisy({120, 60}, 0.5);
    CHECK(mean_over(lambda_of(in, boxed(in)), 0, 120) > 0.99);
}

TEST_CASE("the square that a firefly became is taken back, around a firefly nothing is done") {
    // The filtered image is the truth, but for a bright square of 21x21.
    triple in = noisy({60, 60}, 0.02);
    triple filtered = in;
    for (auto* i : {&filtered.mean, &filtered.a, &filtered.b})
        *i = fill({60, 60}, 3, [](int x, int y, int c) {
            return texture(x, y, c, 60) + (std::abs(x - 30) <= 10 && std::abs(y - 30) <= 10 ? 1 : 0);
        });
    const auto in_square = [&](const image<>& i) { return mean_over(image<>(i), 20, 41); };
    CHECK(in_square(lambda_of(in, filtered, {.wide = 3})) < 0.7);  // 25 of 60 rows
    CHECK(lambda_of(in, filtered).at(30, 30) < 0.01f);
    CHECK(lambda_of(in, filtered, {.wide = 3}).at(5, 5) == 1);
    for (int c = 0; c < 3; ++c) in.a.at(30, 30, c) += 200, in.mean.at(30, 30, c) += 100;
    CHECK(lambda_of(in, filtered).at(30, 30) == 1);
    CHECK(lambda_of(in, filtered).at(33, 27) == 1);
    CHECK(lambda_of(in, filtered, {.wide = 3}).at(24, 30) < 0.01f);
}

TEST_CASE("without noise every change is harm, and no change is none") {
    const triple in = noisy({24, 20}, 0);
    CHECK(mean_over(lambda_of(in, in), 0, 24) == 1);
    const image<> lambda = lambda_of(in, boxed(in), {.radius = 1, .wide = 1});
    CHECK(mean_over(lambda, 16, 24) == 0);
    CHECK(mean_over(lambda, 0, 8) == Approx(1).margin(0.05));  // but for rounding
}

TEST_CASE("lambda does not depend on the unit, on the order of the halves or on orientation") {
    const triple in = noisy({50, 41}, 0.1), filtered = boxed(in);
    const image<> lambda = lambda_of(in, filtered);
    REQUIRE(mean_over(lambda, 30, 50) < 0.9);
    const auto changed = [&](const triple& t, extent size, const auto& value) {
        const auto one = [&](const image<>& i) {
            return fill(size, 3, [&](int x, int y, int c) { return value(i, x, y, c); });
        };
        return triple{one(t.mean), one(t.b), one(t.a)};  // the halves swapped
    };
    for (float scale : {1e-3f, 1e3f}) {
        const auto scaled = [&](const image<>& i, int x, int y, int c) { return scale * i.at(x, y, c); };
        const image<> other = lambda_of(changed(in, {50, 41}, scaled), changed(filtered, {50, 41}, scaled));
        CHECK(beyond(1e-3, other.view(), lambda.view()) == "");
    }
    const auto turned = [&](const image<>& i, int x, int y, int c) { return i.at(49 - y, x, c); };
    const image<> other = lambda_of(changed(in, {41, 50}, turned), changed(filtered, {41, 50}, turned));
    const image<> back = fill({50, 41}, 1, [&](int x, int y, int) { return other.at(y, 49 - x); });
    CHECK(beyond(1e-3, back.view(), lambda.view()) == "");
}

TEST_CASE("layers that add up still do after the blend") {
    const triple in = noisy({40, 30}, 0.05), filtered = boxed(in);
    const image<> lambda = lambda_of(in, filtered);
    const auto part = [&](const image<>& i, double share) {
        return fill({40, 30}, 3, [&](int x, int y, int c) { return share * i.at(x, y, c); });
    };
    image<> whole({40, 30}, 3), first(whole), second(whole);
    blend(in.mean.view(), filtered.mean.view(), lambda.view(), whole.view());
    blend(part(in.mean, 0.3).view(), part(filtered.mean, 0.3).view(), lambda.view(), first.view());
    blend(part(in.mean, 0.7).view(), part(filtered.mean, 0.7).view(), lambda.view(), second.view());
    const image<> sum = fill({40, 30}, 3, [&](int x, int y, int c) { return first.at(x, y, c) + second.at(x, y, c); });
    CHECK(beyond(1e-5, sum.view(), whole.view()) == "");
    CHECK(beyond(0.1, whole.view(), filtered.mean.view()) != "");
    image<> own = filtered.mean;
    blend(in.mean.view(), own.view(), lambda.view(), own.view());
    CHECK(other_bits(own.view(), whole.view()) == "");
}

TEST_CASE("nothing that comes out is no number, at any size") {
    for (extent size : {extent{1, 1}, extent{1, 9}, extent{30, 1}, extent{30, 20}}) {
        triple in = noisy(size, 0.1), filtered = boxed(in);
        const int x = size.width / 2, y = size.height / 2;
        in.mean.at(x, y, 1) = std::numeric_limits<float>::quiet_NaN();
        in.a.at(0, 0, 0) = filtered.b.at(0, size.height - 1) = std::numeric_limits<float>::infinity();
        filtered.mean.at(size.width - 1, 0, 2) = std::numeric_limits<float>::quiet_NaN();
        const image<> lambda = lambda_of(in, filtered);
        CHECK(all_finite(lambda.view()));
        for (int j = 0; j < size.height; ++j)
            for (int i = 0; i < size.width; ++i) CHECK((lambda.at(i, j) >= 0 && lambda.at(i, j) <= 1));
        image<> blended(size, 3);
        blend(in.mean.view(), filtered.mean.view(), lambda.view(), blended.view());
        CHECK(all_finite(blended.view()));
        if (size.pixels() > 1) CHECK(blended.at(size.width - 1, 0, 2) == in.mean.at(size.width - 1, 0, 2));
        else CHECK(lambda.at(0, 0) == 1);
    }
}

TEST_CASE("layers that do not fit are refused by name") {
    const triple in = noisy({3, 2}, 0.1), other = noisy({2, 2}, 0.1);
    image<> lambda({3, 2}), wrong({3, 3});
    CHECK_THROWS_WITH(do_no_harm({in.mean.view(), other.a.view(), in.b.view()}, in.views(), lambda.view()),
                      "the input's first half is 2x2, not 3x2");
    CHECK_THROWS_WITH(do_no_harm(in.views(), other.views(), lambda.view()), "the filtered mean is 2x2, not 3x2");
    CHECK_THROWS_WITH(do_no_harm(in.views(), in.views(), wrong.view()), "lambda is 3x3, not 3x2");
    CHECK_THROWS_AS(do_no_harm(in.views(), in.views(), lambda.view(), {.sigmas = -1}), invalid_input);
    CHECK_THROWS_WITH(blend(in.mean.view(), in.mean.view(), wrong.view(), image<>({3, 2}, 3).view()),
                      "lambda is 3x3, not 3x2");
    CHECK_THROWS_WITH(blend(in.mean.view(), other.mean.view(), lambda.view(), image<>({3, 2}, 3).view()),
                      "the filtered layer is 2x2, not 3x2");
}
