// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/metric/flicker.hpp>

#include <array>
#include <support/catch.hpp>
#include <vector>
#include <winnow/image/image.hpp>

using namespace winnow;

namespace {

/// Images of one row, by channels: {{r, r}, {g, g}, {b, b}}, and what metrics read of them.
struct sequence {
    std::vector<image<float>> images;
    std::vector<source> frames;

    sequence(std::initializer_list<std::vector<std::vector<float>>> values) {
        for (const auto& planes : values) {
            image<float> i({static_cast<int>(planes[0].size()), 1}, static_cast<int>(planes.size()));
            for (int c = 0; c < i.channels(); ++c)
                for (int x = 0; x < i.size().width; ++x) i.at(x, 0, c) = planes[c][x];
            images.push_back(std::move(i));
        }
        for (const auto& i : images) frames.emplace_back(i.view());
    }
};

constexpr float none = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("flicker worked by hand") {
    // Two pixels, three frames.  Errors: (1, 0), (0, 2), (0, 2); their changes: (-1, 2) and (0, 0).
    const sequence x{{{2, 1}}, {{3, 3}}, {{3, 7}}}, y{{{1, 1}}, {{3, 1}}, {{3, 5}}};
    const double wanted = (1 / ((9 + 1) / 2.0 + 0.01) + 4 / ((1 + 1) / 2.0 + 0.01) + 0 + 0) / 4;
    CHECK(metric::flicker(x.frames, y.frames) == Approx(wanted).epsilon(1e-12));
    CHECK(metric::flicker(x.frames, y.frames, 1) == Approx((1 / 6.0 + 4 / 2.0) / 4).epsilon(1e-12));
    // All channels count alike.
    const sequence rgb{{{1}, {0}, {0}}, {{0}, {2}, {0}}}, black{{{0}, {0}, {0}}, {{0}, {0}, {0}}};
    CHECK(metric::flicker(rgb.frames, black.frames, 0.5) == Approx((1 / 0.5 + 4 / 0.5 + 0) / 3).epsilon(1e-12));
}

TEST_CASE("what moves in the references is no flicker, nor is an error that stays") {
    const sequence y{{{1, 4}}, {{7, 2}}, {{0.5f, 3}}}, off{{{1.5f, 4.25f}}, {{7.5f, 2.25f}}, {{1, 3.25f}}};
    CHECK(metric::flicker(y.frames, y.frames) == 0);
    CHECK(metric::flicker(off.frames, y.frames) == 0);
    // One that comes and goes is.
    const sequence blinks{{{1.5f, 4}}, {{7, 2}}, {{1, 3}}};
    CHECK(metric::flicker(blinks.frames, y.frames) > 0);
}

TEST_CASE("played backwards, a sequence flickers as much") {
    const sequence x{{{2, 1}}, {{3, 3}}, {{9, 7}}}, y{{{1, 1}}, {{3, 1}}, {{3, 5}}};
    const std::vector<source> back_x(x.frames.rbegin(), x.frames.rend()), back_y(y.frames.rbegin(), y.frames.rend());
    CHECK(metric::flicker(back_x, back_y) == Approx(metric::flicker(x.frames, y.frames)).epsilon(1e-12));
    CHECK(metric::luminance_flicker(back_x) == metric::luminance_flicker(x.frames));
}

TEST_CASE("luminance flicker worked by hand") {
    const sequence gray{{{2, 1}}, {{3, 3}}, {{3, 7}}};
    CHECK(metric::luminance_flicker(gray.frames) == (1 + 2 + 0 + 4) / 4.0);
    // A change of hue alone is none: 0.7152 more of red is 0.2126 more of green.
    const sequence rgb{{{0.7152f, 0}, {0, 0}, {0, 1}}, {{0, 0}, {0.2126f, 0}, {0, 3}}};
    CHECK(metric::luminance_flicker(rgb.frames) == Approx((0 + 2 * 0.0722) / 2).epsilon(1e-6));
}

TEST_CASE("a value that is not finite makes flicker NaN") {
    const sequence good{{{1, 2}}, {{1, 2}}, {{1, 2}}};
    for (const float bad : {none, std::numeric_limits<float>::infinity()}) {
        const sequence last{{{1, 2}}, {{1, 2}}, {{1, bad}}}, first{{{bad, 2}}, {{1, 2}}, {{1, 2}}};
        for (const sequence* s : {&last, &first}) {
            CHECK(std::isnan(metric::flicker(s->frames, good.frames)));
            CHECK(std::isnan(metric::flicker(good.frames, s->frames)));
            CHECK(std::isnan(metric::luminance_flicker(s->frames)));
        }
    }
}

TEST_CASE("what is no sequence is refused with the numbers") {
    const sequence three{{{1, 2}}, {{1, 2}}, {{1, 2}}}, two{{{1, 2}}, {{1, 2}}}, one{{{1, 2}}};
    CHECK_THROWS_WITH(metric::flicker(three.frames, two.frames), "there are 3 frames and 2 references");
    CHECK_THROWS_WITH(metric::flicker(one.frames, one.frames), "1 frames: flicker is a matter of two at least");
    CHECK_THROWS_AS(metric::luminance_flicker(one.frames), invalid_input);
    CHECK_THROWS_AS(metric::luminance_flicker({}), invalid_input);
    const sequence other{{{1, 2}}, {{1, 2, 3}}}, more{{{1, 2}}, {{1, 2}, {1, 2}}};
    CHECK_THROWS_WITH(metric::luminance_flicker(other.frames),
                      "frame 1 is 3x1 with 1 channels, the first is 2x1 with 1");
    CHECK_THROWS_WITH(metric::flicker(two.frames, more.frames),
                      "reference 1 is 2x1 with 2 channels, the first is 2x1 with 1");
    CHECK_THROWS_WITH(metric::flicker(two.frames, sequence{{{1}}, {{1}}}.frames),
                      "the image is 2x1, the reference is 1x1");
    CHECK_THROWS_WITH(metric::flicker(two.frames, two.frames, 0), Catch::Contains("epsilon is 0.0"));
    const sequence pair{{{1}, {1}}, {{1}, {1}}};
    CHECK_THROWS_WITH(metric::luminance_flicker(pair.frames), "luminance is that of 1 or 3 channels, not of 2");
    CHECK_THROWS_WITH(metric::luminance_flicker(std::array<source, 2>{}), Catch::Contains("not of 0"));
    const std::array<source, 2> empty{image_view<const float>(nullptr, {0, 0}, 3, {}),
                                      image_view<const float>(nullptr, {0, 0}, 3, {})};
    CHECK_THROWS_WITH(metric::luminance_flicker(empty), Catch::Contains("nothing to compare"));
}
