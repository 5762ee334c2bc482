// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/outlier_search.hpp>

#include <algorithm>
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <tuple>

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr extent size{40, 31};

/// One channel of level 1 with noise, another in each render.
std::vector<image<>> noisy(int renders, extent of = size, double noise = 0.05) {
    std::vector<image<>> all;
    for (int k = 0; k < renders; ++k)
        all.push_back(fill(of, 1, [&](int x, int y, int) {
            return 1 + noise * normal_deviate(static_cast<std::uint64_t>(k + 1), x, y);
        }));
    return all;
}

using place = std::tuple<int, int, int>;  // render, x, y

struct result {
    std::vector<place> places;
    std::vector<float> kept;
    bool has(int render, int x, int y) const {
        return std::find(places.begin(), places.end(), place{render, x, y}) != places.end();
    }
};

result search(const std::vector<image<>>& renders, const outlier_numbers& n = {}) {
    std::vector<source> views;
    for (const auto& r : renders) views.emplace_back(r.view());
    const outlier_search found(views, n);
    result all;
    for (const outlier& o : found.outliers()) {
        all.places.emplace_back(o.render, o.x, o.y);
        all.kept.push_back(o.kept);
    }
    std::sort(all.places.begin(), all.places.end());
    return all;
}

}  // namespace

TEST_CASE("what one render shows and nothing confirms is an outlier") {
    for (int renders : {2, 4, 8}) {
        auto all = noisy(renders);
        all[1].at(20, 15) = 30;
        all[0].at(0, 0) = 30;
        const result r = search(all);
        CHECK(r.has(1, 20, 15));
        CHECK(r.has(0, 0, 0));
        CHECK(!r.has(0, 20, 15));
        CHECK(r.places.size() < 2 + renders * 1240u / 200);  // beyond three deviations: 1 of 740
    }
}

TEST_CASE("what all renders show stays, however small and bright") {
    for (int renders : {2, 4}) {
        auto all = noisy(renders);
        for (auto& r : all) {
            r.at(9, 9) = 30;                                  // a star
            for (int x = 15; x < 35; ++x) r.at(x, 20) *= 30;  // a line
            for (int y = 24; y < 30; ++y)
                for (int x = 2; x < 8; ++x) r.at(x, y) *= 30;  // a disc
        }
        const result r = search(all);
        for (int k = 0; k < renders; ++k) {
            CHECK(!r.has(k, 9, 9));
            for (int x = 15; x < 35; ++x) CHECK(!r.has(k, x, 20));
            for (int y = 24; y < 30; ++y)
                for (int x = 2; x < 8; ++x) CHECK(!r.has(k, x, y));
        }
    }
}

TEST_CASE("a frame without noise has no outliers, one with a third of it in a pixel may have") {
    std::vector<image<>> all(2,
                             fill(size, 1, [](int x, int y, int) { return uniform(7, x, y) > 0.97 ? 1000.0 : 0.1; }));
    CHECK(search(all).places.empty());
    all[0].at(20, 15) = 4000;  // in the other it is 0.1 or 1000
    all[1].at(20, 15) = 0.1f;
    CHECK(search(all).has(0, 20, 15));
}

TEST_CASE("a step of half floats is no outlier, however even the rest is") {
    std::vector<image<>> all(2, fill(size, 1, [](int, int, int) { return 1.0; }));
    all[1].at(28, 15) = 50;  // so that nothing near is trusted
    all[0].at(20, 15) = 1.02f;
    CHECK(search(all).places == std::vector<place>{{1, 28, 15}});
    all[0].at(20, 15) = 1.2f;
    CHECK(search(all).has(0, 20, 15));
}

TEST_CASE("a bright pixel is trusted by the noise within reach") {
    // The star is 30 in both halves; a firefly of f has a standard error of f / 2, the star is trusted up to 10.
    const auto kept = [](float firefly, int distance, int reach) {
        auto all = noisy(2);
        all[0].at(15, 15) = all[1].at(15, 15) = 30;
        all[0].at(15 + distance, 15) = firefly;
        return !search(all, {.reach = reach}).has(0, 15, 15);
    };
    CHECK(kept(18, 10, 10));
    CHECK(!kept(24, 10, 10));
    CHECK(kept(24, 11, 10));
    CHECK(!kept(24, 11, 11));
}

TEST_CASE("outliers confirm each other") {
    // Of n equal ones the share 1 - 3 / n is kept, and nothing of up to three.
    for (int count : {1, 2, 3, 4, 6, 9}) {
        std::vector<image<>> all(2, fill({19, 19}, 1, [](int, int, int) { return 0.0; }));
        for (int i = 0; i < count; ++i) all[i % 2].at(6 * (i % 3) + 3, 6 * (i / 3) + 3) = 8;
        const result r = search(all, {.reach = 18});
        REQUIRE(r.places.size() == static_cast<std::size_t>(count));
        for (float kept : r.kept) CHECK(kept == Approx(std::max(0.0, 1 - 3.0 / count)));
    }
}

TEST_CASE("the place of an outlier is filled with the mean of the others in the square") {
    std::vector<image<>> all(2, fill({5, 5}, 2, [](int x, int y, int c) { return c ? 2.0 : 1 + 0.01 * (x + 5 * y); }));
    all[1].at(2, 2, 0) = 50;
    all[1].at(2, 2, 1) = 70;
    const source views[] = {all[0].view(), all[1].view()};
    const outlier_search found(views, {});
    REQUIRE(found.outliers().size() == 1);
    CHECK(found.instead(0, 0) == Approx(1.12));  // the mean of both without the centre, which is that itself
    CHECK(found.instead(0, 1) == Approx(2));
    CHECK(found.outliers()[0].taken == Approx(60 - (1.12 + 2) / 2));
}

TEST_CASE("outliers do not depend on the unit of radiance, on orientation, or on the order of the renders") {
    auto all = noisy(3, size, 0.5);
    for (int i = 0; i < 40; ++i)
        all[i % 3].at((7 * i) % size.width, (11 * i) % size.height) = 2 + 40 * static_cast<float>(uniform(99, i, 0));
    const result straight = search(all);
    REQUIRE(straight.places.size() > 20);
    for (float scale : {1e-3f, 1e3f}) {
        auto scaled = all;
        for (auto& i : scaled) i = fill(size, 1, [&](int x, int y, int) { return scale * i.at(x, y); });
        CHECK(search(scaled).places == straight.places);
    }
    std::vector<image<>> other;
    for (int k = 2; k >= 0; --k)
        other.push_back(
            fill({size.height, size.width}, 1, [&](int x, int y, int) { return all[k].at(size.width - 1 - y, x); }));
    std::vector<place> back;
    for (const auto& [k, x, y] : search(other).places) back.emplace_back(2 - k, size.width - 1 - y, x);
    std::sort(back.begin(), back.end());
    CHECK(back == straight.places);
}

TEST_CASE("too few others decide nothing, and unknown ones say nothing") {
    for (extent of : {extent{1, 1}, extent{2, 2}, extent{9, 1}, extent{1, 9}, extent{0, 0}}) {
        auto all = noisy(2, of);
        const int x = of.width / 2, y = of.height / 2;
        if (of.pixels()) all[0].at(x, y) = 1e6f;
        CHECK(search(all).has(0, x, y) == (of.pixels() == 9));
        if (of.pixels() != 9) continue;
        all[1].at(x, y) = std::numeric_limits<float>::quiet_NaN();
        CHECK(search(all).has(0, x, y));  // of eight others
        all[1].at(0, 0) = std::numeric_limits<float>::quiet_NaN();
        (of.width == 9 ? all[1].at(5, 0) : all[1].at(0, 5)) = std::numeric_limits<float>::quiet_NaN();
        CHECK(search(all).places.empty());
    }
    auto all = noisy(2);
    all[0].at(20, 15) = 30;
    all[1].at(19, 15) = std::numeric_limits<float>::infinity();
    const result r = search(all);
    CHECK(r.has(0, 20, 15));
    CHECK(!r.has(1, 19, 15));
}
