// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/outliers.hpp>

#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <support/statistics.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

/// Halves of an image with structure and noise, and `share` of the pixels of each with a firefly.
struct halves {
    image<> a, b;
};
halves lit(extent size, double share) {
    const auto half = [&](std::uint64_t stream) {
        return fill(size, 3, [&, stream](int x, int y, int c) {
            const double firefly = uniform(stream, x, y, 9) < share ? (3 + c) * 10 * uniform(stream, x, y, 10) : 0;
            return structure(x, y, c) + 0.05 * normal_deviate(stream, x, y, c) + firefly;
        });
    };
    return {half(1), half(2)};
}

double mean_of(const image<>& i, int c) {
    double sum = 0;
    detail::for_pixels(i.size(), [&](int x, int y) { sum += i.at(x, y, c); });
    return sum / static_cast<double>(i.size().pixels());
}

struct mended {
    image<> a, b, removed, count;
    outliers_found found;
    explicit mended(const halves& h) : a(h.a.size(), 3), b(a), removed(a), count(h.a.size()) {
        found = suppress_outliers(h.a.view(), h.b.view(), a.view(), b.view(), {removed.view(), count.view()});
    }
};

}  // namespace

TEST_CASE("a lone firefly leaves the mean, its half and the variance, and nothing else changes") {
    halves h = lit({30, 30}, 0);
    const mended before(h);
    for (int c = 0; c < 3; ++c) h.a.at(14, 15, c) += 90;
    const mended m(h);
    CHECK(m.found.count == before.found.count + 1);
    CHECK(m.count.at(14, 15) == 1);
    for (int c = 0; c < 3; ++c) {
        CHECK(std::abs(m.a.at(14, 15, c) - structure(14, 15, c)) < 0.3);
        CHECK(m.removed.at(14, 15, c) == Approx(45).margin(0.2));
        // Of 90 in one pixel of one of two halves.
        CHECK(m.found.removed[c] - before.found.removed[c] == Approx(90.0 / 2 / 900).epsilon(0.01));
    }
    image<> variance({30, 30}, 3);
    variance_from_halves(m.a.view(), m.b.view(), variance.view());
    CHECK(variance.at(14, 15) < 0.05);
    detail::for_pixels({30, 30}, [&](int x, int y) {
        for (int c = 0; c < 3; ++c)
            if (m.count.at(x, y) == 0 && m.removed.at(x, y, c) == 0) CHECK(m.a.at(x, y, c) == h.a.at(x, y, c));
        if (m.count.at(x, y) == 0) CHECK(m.removed.at(x, y) <= 0);
    });
}

TEST_CASE("the energy of many is kept, that of few is not, and all is accounted for") {
    for (double share : {0.0005, 0.02}) {
        const halves h = lit({100, 80}, share);
        const mended m(h);
        for (int c = 0; c < 3; ++c) {
            const double before = (mean_of(h.a, c) + mean_of(h.b, c)) / 2,
                         after = (mean_of(m.a, c) + mean_of(m.b, c)) / 2;
            CHECK(before - after == Approx(m.found.removed[c]).epsilon(1e-4));
            CHECK(mean_of(m.removed, c) == Approx(m.found.removed[c]).epsilon(1e-4));
            const double kept = m.found.spread[c] / (m.found.spread[c] + m.found.removed[c]);
            if (share > 0.01)
                CHECK((kept > 0.6 && kept < 0.85));  // some 18 within reach, of unequal strength: 1 - 3 (4 / 3) / 18
            else CHECK(kept < 0.1);
            // What was in a pixel is in the mended mean and in the map.
            detail::for_pixels(h.a.size(), [&](int x, int y) {
                const double was = (h.a.at(x, y, c) + h.b.at(x, y, c)) / 2,
                             is = (m.a.at(x, y, c) + m.b.at(x, y, c)) / 2;
                REQUIRE(std::abs(was - is - m.removed.at(x, y, c)) < 1e-5);
            });
        }
    }
}

TEST_CASE("half of what six equal ones hold is put back around each") {
    image<> a = fill({19, 13}, 1, [](int, int, int) { return 1.0; }), b = a;
    for (int i = 0; i < 6; ++i) (i % 2 ? a : b).at(6 * (i % 3) + 3, 6 * (i / 3) + 3) = 19;
    b.at(2, 2) = std::numeric_limits<float>::quiet_NaN();  // gets nothing; the other eight share
    const outliers_found found = suppress_outliers(a.view(), b.view(), a.view(), b.view(), {}, {.reach = 18});
    CHECK(found.count == 6);
    CHECK(found.spread[0] == Approx(6 * 9.0 / 2 / (19 * 13)));
    CHECK(found.removed[0] == Approx(6 * 9.0 / 2 / (19 * 13)));
    for (int x = 2; x <= 4; ++x) CHECK(b.at(x, 4) == Approx(1 + 9.0 / 8));
    CHECK(b.at(5, 4) == 1);
    CHECK(a.at(3, 3) == 1);
}

TEST_CASE("ordinary noise costs next to nothing") {
    const halves h = lit({100, 80}, 0);
    const mended m(h);
    CHECK(m.found.count < 2 * 8000 / 200);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(m.found.removed[c]) < 2e-4 * mean_of(h.a, c));
}

TEST_CASE("in place, by the other half first, and from a list it is the same") {
    const halves h = lit({50, 41}, 0.01);
    const mended m(h);
    REQUIRE(m.found.count > 10);
    mended swapped(halves{h.b, h.a});
    CHECK(beyond(1e-5, swapped.a.view(), m.b.view()) == "");
    CHECK(beyond(1e-5, swapped.removed.view(), m.removed.view()) == "");
    halves own = h;
    const source renders[] = {own.a.view(), own.b.view()};
    const target to[] = {own.a.view(), own.b.view()};
    suppress_outliers(renders, to);
    CHECK(other_bits(own.a.view(), m.a.view()) == "");
    CHECK(other_bits(own.b.view(), m.b.view()) == "");
}

TEST_CASE("samples are mended as renders are") {
    // Eight samples; one in a hundred is ninety times as bright as the others.
    std::vector<image<>> samples;
    for (std::uint64_t k = 0; k < 8; ++k)
        samples.push_back(fill({40, 40}, 3, [&](int x, int y, int c) {
            return uniform(k, x, y, 9) < 0.01 ? 90.0 : 1 + 0.2 * uniform(k, x, y, c);
        }));
    std::vector<source> from;
    std::vector<target> to;
    for (auto& s : samples) from.emplace_back(s.view()), to.emplace_back(s.view());
    image<> count({40, 40});
    const outliers_found found = suppress_outliers(from, to, {{}, count.view()});
    CHECK(found.spread[0] == Approx(0.9).epsilon(0.15));  // 128 events: a deviation of 9 %
    double most = 0, sum = 0;
    for (const auto& s : samples)
        detail::for_pixels(
            s.size(), [&](int x, int y) { most = std::max(most, double{s.at(x, y)}), sum += s.at(x, y) / 8 / 1600; });
    CHECK(most < 45);
    double marked = 0;
    detail::for_pixels(count.size(), [&](int x, int y) { marked += count.at(x, y); });
    CHECK(marked == static_cast<double>(found.count));
    CHECK(sum == Approx(1.1 + found.spread[0]).epsilon(0.02));
}

TEST_CASE("values that are no numbers are passed through and get nothing") {
    halves h = lit({40, 40}, 0.03);
    for (int i = 0; i < 40; ++i) h.a.at(i, 20, 1) = std::numeric_limits<float>::quiet_NaN();
    h.b.at(5, 20, 1) = std::numeric_limits<float>::infinity();
    const mended m(h);
    int changed = 0;
    for (int i = 0; i < 40; ++i) {
        CHECK(std::isnan(m.a.at(i, 20, 1)));
        CHECK(m.a.at(i, 20, 0) == h.a.at(i, 20, 0));
        for (int c = 0; c < 3; ++c) CHECK(is_finite(m.removed.at(i, 20, c)));
        changed += m.a.at(i, 19) != h.a.at(i, 19);
    }
    CHECK(changed > 0);
    CHECK(is_finite(static_cast<float>(m.found.removed[1])));
}

TEST_CASE("what cannot be mended is refused before any work") {
    image<> a({3, 2}, 3), b({2, 2}, 3), one({3, 2});
    const source renders[] = {a.view(), a.view()};
    const target to[] = {a.view(), a.view()};
    CHECK_THROWS_WITH(suppress_outliers(a.view(), b.view(), a.view(), a.view()), "a render is 2x2, not 3x2");
    CHECK_THROWS_WITH(suppress_outliers(a.view(), a.view(), a.view(), b.view()), "a mended render is 2x2, not 3x2");
    CHECK_THROWS_WITH(suppress_outliers(renders, to, {one.view(), {}}),
                      "the map of what is removed has 1 channels, not 3");
    CHECK_THROWS_WITH(suppress_outliers(renders, to, {{}, a.view()}), "the map of outliers has 3 channels, not 1");
    CHECK_THROWS_WITH(suppress_outliers(std::span(renders).first(1), std::span(to).first(1)),
                      "outliers: there is no other render to compare with");
    CHECK_THROWS_WITH(suppress_outliers(renders, std::span(to).first(1)),
                      "outliers: there are 2 renders, but 1 to write");
    CHECK_THROWS_AS(suppress_outliers(renders, to, {}, {.radius = 0}), invalid_input);
    CHECK_THROWS_AS(suppress_outliers(renders, to, {}, {.sigmas = std::nanf("")}), invalid_input);
}
