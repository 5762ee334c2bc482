// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/variance.hpp>

#include <cmath>
#include <random>
#include <support/catch.hpp>
#include <winnow/image/image.hpp>

using namespace winnow;

namespace {

const float nan_value = std::numeric_limits<float>::quiet_NaN();

image<float> from_halves(const image<float>& a, const image<float>& b, int radius) {
    image<float> v(a.size(), a.channels());
    variance_from_halves(a.view(), b.view(), v.view(), radius);
    return v;
}

}  // namespace

TEST_CASE("the variance from halves is that of their mean") {
    // Unit variance in each half: the mean has 1/2.
    std::mt19937 random(1);
    std::normal_distribution<float> noise;
    image<float> a({200, 100}), b({200, 100});
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 200; ++x) a.at(x, y) = noise(random), b.at(x, y) = noise(random);
    for (int radius : {0, 1, 3}) {
        const image<float> v = from_halves(a, b, radius);
        double sum = 0;
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 200; ++x) sum += v.at(x, y);
        CHECK(std::abs(sum / 20000 - 0.5) < 0.02);  // four standard deviations
    }
}

TEST_CASE("halves are averaged over the part of the box that lies in the image") {
    image<float> a({3, 2}), b({3, 2});
    a.at(0, 0) = 2;   // (A - B)^2 / 4 = 1
    b.at(2, 1) = 12;  // 36
    const image<float> v = from_halves(a, b, 1);
    CHECK(v.at(0, 0) == 1.0f / 4);
    CHECK(std::abs(v.at(1, 0) - 37.0f / 6) < 1e-6f);
    CHECK(v.at(2, 0) == 36.0f / 4);
    CHECK(from_halves(a, b, 0).at(2, 1) == 36.0f);
}

TEST_CASE("unequal halves share by their numbers of samples") {
    CHECK(share_of_halves() == 0.25f);
    CHECK(share_of_halves(3, 1) == 3.0f / 16);
    CHECK(std::abs(share_of_halves(2, 1) - 2.0f / 9) < 1e-7f);
}

TEST_CASE("pixels without samples are left out, and are unknown where nothing else is near") {
    image<float> a({7, 1}, 2), b({7, 1}, 2);
    for (int x = 0; x < 3; ++x) a.at(x, 0, 1) = nan_value;
    b.at(2, 0) = std::numeric_limits<float>::infinity();
    a.at(1, 0) = 2;
    const image<float> v = from_halves(a, b, 1);
    CHECK(v.at(2, 0) == 0.5f);  // pixels 1 and 3
    CHECK(std::isnan(v.at(0, 0, 1)));
    CHECK(std::isnan(v.at(1, 0, 1)));
    CHECK(v.at(2, 0, 1) == 0.0f);
}

TEST_CASE("a smoothed variance leaves out what is no variance") {
    image<float> raw({4, 1}), v({4, 1});
    raw.at(0, 0) = 1;
    raw.at(1, 0) = -5;
    raw.at(2, 0) = 3;
    raw.at(3, 0) = nan_value;
    smooth_variance(raw.view(), v.view());
    CHECK(v.at(0, 0) == 1);
    CHECK(v.at(1, 0) == 2);
    CHECK(v.at(2, 0) == 3);
    CHECK(v.at(3, 0) == 3);
    smooth_variance(raw.view(), v.view(), 0);
    CHECK(std::isnan(v.at(1, 0)));
}

TEST_CASE("several renders give their mean and its variance, far from zero as well") {
    const float values[] = {1e6f + 1, 1e6f + 3, 1e6f + 5, 1e6f + 7};  // variance of one: 20/3
    std::vector<image<float>> renders;
    for (float v : values) {
        renders.emplace_back(extent{2, 1}, 1);
        renders.back().at(0, 0) = v;
        renders.back().at(1, 0) = v;
    }
    renders[0].at(1, 0) = nan_value;
    std::vector<source> sources;
    for (const auto& r : renders) sources.emplace_back(r.view());
    image<float> mean({2, 1}), variance({2, 1});
    mean_and_variance(sources, mean.view(), variance.view());
    CHECK(mean.at(0, 0) == 1e6f + 4);
    CHECK(std::abs(variance.at(0, 0) - 5.0f / 3) < 1e-6f);
    CHECK(mean.at(1, 0) == 1e6f + 5);
    CHECK(std::abs(variance.at(1, 0) - 4.0f / 3) < 1e-6f);

    mean_and_variance(std::span(sources).first(2), mean.view(), variance.view());
    CHECK(mean.at(1, 0) == 1e6f + 3);
    CHECK(std::isnan(variance.at(1, 0)));  // of one sample
    mean_and_variance(std::span(sources).first(1), mean.view(), {});
    CHECK(std::isnan(mean.at(1, 0)));
    CHECK_THROWS_WITH(mean_and_variance({}, mean.view(), {}), "there are no renders to take the mean of");
}

TEST_CASE("layers that do not fit are refused with their sizes") {
    image<float> a({3, 2}), b({2, 2}), c({3, 2}, 3);
    CHECK_THROWS_WITH(variance_from_halves(a.view(), b.view(), a.view()), "the second half is 2x2, not 3x2");
    CHECK_THROWS_WITH(variance_from_halves(a.view(), a.view(), c.view()), "the variance has 3 channels, not 1");
}

TEST_CASE("the variance of stratified samples gets the magnitude of the halves and keeps its shape") {
    // A true variance that varies over the image; what the samples show is four times that, what the halves show is
    // right on average.
    std::mt19937 random(3);
    std::normal_distribution<float> noise;
    const extent size{60, 50};
    image<float> shown(size, 2), a(size, 2), b(size, 2), scaled(size, 2);
    const auto truth = [](int x, int c) { return (x % 2 ? 0.01f : 0.03f) * (c ? 10.0f : 1.0f); };
    for (int c = 0; c < 2; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                shown.at(x, y, c) = 4 * truth(x, c);
                // Each half has twice the variance of the mean.
                a.at(x, y, c) = 5 + std::sqrt(2 * truth(x, c)) * noise(random);
                b.at(x, y, c) = 5 + std::sqrt(2 * truth(x, c)) * noise(random);
            }
    scale_variance_to_halves(shown.view(), a.view(), b.view(), scaled.view());
    for (int c = 0; c < 2; ++c)
        for (int y = 10; y < 40; ++y)
            for (int x = 10; x < 49; ++x) {
                // 441 squares of a normal: a relative deviation of sqrt(2 / 441), a quarter more for the two shares.
                CHECK(std::abs(scaled.at(x, y, c) / truth(x, c) - 1) < 5 * 1.25f * std::sqrt(2.0f / 441));
                // Of a neighbour, one column of 21 is another: five times sqrt(2 * 2 * 21) / 441, and a quarter more.
                const float ratio = scaled.at(x + 1, y, c) / scaled.at(x, y, c);
                CHECK(std::abs(ratio * truth(x, c) / truth(x + 1, c) - 1) < 0.13f);
            }
    // In place, and unknown values stay unknown.
    shown.at(3, 3) = nan_value;
    scale_variance_to_halves(shown.view(), a.view(), b.view(), shown.view());
    CHECK(std::isnan(shown.at(3, 3)));
    CHECK(std::abs(shown.at(30, 30) - scaled.at(30, 30)) < 1e-7f);
    // Without variance at all the halves have nothing to scale.
    image<float> none(size, 2);
    scale_variance_to_halves(none.view(), a.view(), b.view(), none.view());
    CHECK(none.at(30, 30) == 0);
    CHECK_THROWS_AS(scale_variance_to_halves(image<float>({3, 3}, 2).view(), a.view(), b.view(), none.view()),
                    invalid_input);
}

namespace {

/// The average of the finite values around each pixel, as the words have it.
image<float> averaged(const image<float>& from, int radius) {
    image<float> to(from.size());
    for (int y = 0; y < from.size().height; ++y)
        for (int x = 0; x < from.size().width; ++x) {
            double sum = 0;
            int count = 0;
            for (int j = std::max(0, y - radius); j <= std::min(from.size().height - 1, y + radius); ++j)
                for (int i = std::max(0, x - radius); i <= std::min(from.size().width - 1, x + radius); ++i)
                    if (is_finite(from.at(i, j))) sum += double{from.at(i, j)}, ++count;
            to.at(x, y) = count ? static_cast<float>(sum / count) : nan_value;
        }
    return to;
}

void check_box_mean(const image<float>& from, int radius, std::vector<float>& memory) {
    image<float> to(from.size());
    detail::box_mean([&](int x, int y) { return from.at(x, y); }, to.view(), radius, memory);
    const image<float> expected = averaged(from, radius);
    CAPTURE(from.size().width, from.size().height, radius);
    for (int y = 0; y < from.size().height; ++y)
        for (int x = 0; x < from.size().width; ++x) {
            CAPTURE(x, y);
            if (std::isnan(expected.at(x, y))) CHECK(std::isnan(to.at(x, y)));
            else {
                // Sums of non-negative values: one rounding an addition at most.
                const int side = 2 * radius + 1;
                CHECK(std::abs(to.at(x, y) - expected.at(x, y)) <=
                      static_cast<float>(side * side) * 0x1p-24f * expected.at(x, y));
            }
        }
}

image<float> random_image(extent size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0, 1);
    image<float> made(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) made.at(x, y) = value(random);
    return made;
}

}  // namespace

TEST_CASE("the box mean is that of the finite values in the square, for radii up to far beyond the image") {
    std::vector<float> memory;
    for (const extent size : {extent{1, 1}, extent{1, 13}, extent{13, 1}, extent{7, 5}, extent{40, 23}})
        for (const int radius : {0, 1, 2, 5, 10, 30}) check_box_mean(random_image(size, 5), radius, memory);
}

TEST_CASE("the box mean leaves out what is no number, and is none where nothing else is near") {
    std::vector<float> memory;
    image<float> from = random_image({17, 12}, 6);
    for (int y = 3; y < 9; ++y)
        for (int x = 4; x < 10; ++x) from.at(x, y) = nan_value;
    from.at(0, 0) = std::numeric_limits<float>::infinity();
    from.at(16, 11) = -std::numeric_limits<float>::infinity();
    for (const int radius : {0, 1, 3}) check_box_mean(from, radius, memory);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 17; ++x) from.at(x, y) = nan_value;
    check_box_mean(from, 2, memory);
}

TEST_CASE("an outlier of 1e30 leaves nothing behind where the square does not hold it") {
    std::vector<float> memory;
    image<float> from = random_image({29, 21}, 7);
    from.at(9, 8) = from.at(20, 0) = from.at(0, 20) = 1e30f;
    for (const int radius : {0, 1, 4}) check_box_mean(from, radius, memory);
}

TEST_CASE("the memory of an average may have held another: larger, smaller, spoilt") {
    std::vector<float> memory;
    image<float> spoilt({50, 3}), small({3, 3});
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 50; ++x) spoilt.at(x, y) = nan_value;
    image<float> ignored(spoilt.size());
    for (const int radius : {9, 0, 3, 1}) {
        memory.assign(memory.size(), nan_value);
        check_box_mean(random_image({31, 17}, 8), radius, memory);
        detail::box_mean([&](int x, int y) { return spoilt.at(x, y); }, ignored.view(), 4, memory);
        check_box_mean(random_image({5, 40}, 9), radius, memory);
    }
}

TEST_CASE("what is larger than any variance is cut, so that its neighbours' average is a number") {
    image<float> a({9, 5}), b({9, 5}), v({9, 5});
    a.at(4, 2) = 3e38f, b.at(4, 2) = 0;
    a.at(3, 2) = 3e38f, b.at(3, 2) = -3e38f;  // their difference is infinite: left out
    variance_from_halves(a.view(), b.view(), v.view(), 1);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) CHECK(is_finite(v.at(x, y)));
    CHECK(v.at(5, 2) == Approx(1e30 / 9));
    CHECK(v.at(3, 2) == Approx(1e30 / 8));
    CHECK(v.at(6, 2) == 0);
    image<float> raw({9, 5});
    raw.at(4, 2) = 3e38f;
    smooth_variance(raw.view(), v.view(), 2);
    CHECK(v.at(4, 2) == Approx(1e30 / 25));
}

TEST_CASE("a second call with the same memory gives the same, and needs no more of it") {
    const image<float> a = random_image({30, 20}, 10), b = random_image({30, 20}, 11),
                       shown = random_image({30, 20}, 12);
    image<float> first(a.size()), second(a.size());
    variance_memory memory;
    const auto run = [&](image<float>& to) {
        scale_variance_to_halves(shown.view(), a.view(), b.view(), to.view(), 10, 0.25f, memory);
    };
    run(first);
    const float* const rows = memory.rows.data();
    const float* const halves = memory.halves.data();
    const float* const average = memory.average.data();
    run(second);
    CHECK((memory.rows.data() == rows && memory.halves.data() == halves && memory.average.data() == average));
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x) CHECK(first.at(x, y) == second.at(x, y));
}
