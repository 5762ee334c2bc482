// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/sample_counts.hpp>

#include <array>
#include <limits>
#include <numeric>
#include <support/catch.hpp>
#include <support/patterns.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr extent size{53, 38};
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Densities over many orders of magnitude, with holes.
image<> rugged(extent s, double scale = 1) {
    return fill(s, 1, [scale](int x, int y, int) {
        const double u = uniform(3, x, y);
        return u < 0.1 ? 0 : scale * std::exp(8 * normal_deviate(4, x, y) / 3);
    });
}

template <class F>
void for_each_pixel(extent s, const F& f) {
    for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < s.width; ++x) f(x, y);
}

}  // namespace

TEST_CASE("worked by hand") {
    // Four pixels of a square; the curve is (0, 0), (0, 1), (1, 1), (1, 0).
    image<> d({2, 2});
    d.at(0, 0) = 1, d.at(0, 1) = 2, d.at(1, 1) = 3, d.at(1, 0) = 4;
    const auto check = [&](const sample_budget& b, const std::array<int, 4>& wanted) {
        const sample_counts n = counts_from_density(d.view(), b);
        CHECK(std::array{n.at(0, 0), n.at(0, 1), n.at(1, 1), n.at(1, 0)} == wanted);
    };
    check({.total = 20}, {2, 4, 6, 8});
    // Shares 0.5, 1, 1.5, 2: the half that is left over goes on.
    check({.total = 5}, {1, 1, 1, 2});
    check({.total = 5, .phase = 0}, {0, 1, 2, 2});
    // 4 of 20 is above 6, and so is what 3 then gets of 14: 7.  The rest, 8, is shared by 1 and 2: 8/3 and 16/3.
    check({.total = 20, .cap = 6}, {3, 5, 6, 6});
    check({.total = 24, .cap = 6}, {6, 6, 6, 6});
    // All others are at the cap: the pixel without density gets the rest.
    d.at(0, 0) = 0;
    check({.total = 20, .cap = 6}, {2, 6, 6, 6});
    check({.total = 18, .cap = 6}, {0, 6, 6, 6});
}

TEST_CASE("the total is exact and no count is above the cap or below 0, whatever the density") {
    std::vector<image<>> densities{rugged(size), rugged(size, 1e-35), rugged(size, 1e30), image<>(size)};
    densities.push_back(fill(size, 1, [](int, int, int) { return 0.1; }));
    densities.push_back(fill(size, 1, [](int x, int y, int) { return x == 7 && y == 5 ? 1e30 : 0; }));
    densities.push_back(
        fill(size, 1, [](int x, int y, int) { return x == 7 && y == 5 ? 1e30 : 1 + uniform(1, x, y); }));
    densities.push_back(fill(size, 1, [](int x, int y, int) { return std::exp2(x + y - 70); }));
    densities.push_back(fill(size, 1, [](int x, int y, int) { return normal_deviate(8, x, y); }));
    const std::int64_t pixels = size.pixels();
    for (std::size_t i = 0; i < densities.size(); ++i)
        for (const std::int64_t total :
             {std::int64_t{0}, std::int64_t{1}, pixels / 3, pixels, 4 * pixels + 17, 16 * pixels})
            for (const int cap : {16, 17, 40, std::numeric_limits<int>::max()})
                for (const double phase : {0.0, 0.25, 0.5, std::nextafter(1.0, 0.0)}) {
                    CAPTURE(i, total, cap, phase);
                    const sample_counts n =
                        counts_from_density(densities[i].view(), {.total = total, .cap = cap, .phase = phase});
                    REQUIRE(n.total() == total);
                    REQUIRE(n.fewest() >= 0);
                    REQUIRE(n.most() <= cap);
                }
}

TEST_CASE("one pixel, rows and columns") {
    for (const extent s : {extent{1, 1}, extent{1, 9}, extent{9, 1}, extent{1, 1000}})
        for (const std::int64_t total : {0, 1, 7, 5000}) {
            const sample_counts n = counts_from_density(rugged(s).view(), {.total = total, .cap = 5000});
            CHECK(n.total() == total);
            CHECK(n.most() <= 5000);
        }
    CHECK(counts_from_density(image<>({1, 1}).view(), {.total = 12}).at(0, 0) == 12);
}

TEST_CASE("a constant density gives counts that differ by at most one, and so does none at all") {
    for (const float value : {0.0f, 0.1f, 1e-38f, 3e38f, -1.0f})
        for (const std::int64_t total : {std::int64_t{100}, size.pixels(), 3 * size.pixels(), 3 * size.pixels() + 100})
            for (const double phase : {0.0, 0.5}) {
                const image<> d = fill(size, 1, [=](int, int, int) { return value; });
                const sample_counts n = counts_from_density(d.view(), {.total = total, .phase = phase});
                CHECK(n.most() - n.fewest() == (total % size.pixels() != 0));
            }
}

TEST_CASE("each count is its share, rounded up or down: more density, no fewer samples") {
    const image<> d = rugged(size);
    const std::int64_t total = 8 * size.pixels();
    const sample_counts n = counts_from_density(d.view(), {.total = total, .cap = 60});
    // The shares of those that are not clamped are in proportion to their densities.
    double counted = 0, density = 0;
    int at_cap = 0;
    float least_clamped = infinity;
    for_each_pixel(size, [&](int x, int y) {
        if (n.at(x, y) == 60) return void((++at_cap, least_clamped = std::min(least_clamped, d.at(x, y))));
        counted += n.at(x, y), density += d.at(x, y);
    });
    REQUIRE(at_cap > 50);
    int wrong = 0;
    for_each_pixel(size, [&](int x, int y) {
        if (n.at(x, y) < 60) wrong += std::abs(n.at(x, y) - counted / density * d.at(x, y)) > 1.01;
        if (d.at(x, y) >= least_clamped) wrong += n.at(x, y) < 59;
        if (d.at(x, y) == 0) wrong += n.at(x, y) != 0;
    });
    CHECK(wrong == 0);
    std::vector<std::pair<float, int>> pixels;
    for_each_pixel(size, [&](int x, int y) { pixels.emplace_back(d.at(x, y), n.at(x, y)); });
    std::sort(pixels.begin(), pixels.end());
    int most_so_far = 0;
    for (const auto& [value, count] : pixels) {
        REQUIRE(count >= most_so_far - 1);
        most_so_far = std::max(most_so_far, count);
    }
}

TEST_CASE("the scale of a density does not matter, and nor does what is no density") {
    const image<> d = rugged(size);
    const sample_budget b{.total = 8 * size.pixels() + 3, .cap = 60};
    const sample_counts n = counts_from_density(d.view(), b);
    for (const float scale : {0x1p-40f, 0x1p20f}) {
        const image<> scaled = fill(size, 1, [&](int x, int y, int) { return scale * d.at(x, y); });
        CHECK(counts_from_density(scaled.view(), b) == n);
    }
    const image<> scaled = fill(size, 1, [&](int x, int y, int) { return 3 * d.at(x, y); });
    const sample_counts other = counts_from_density(scaled.view(), b);
    int wrong = 0;
    for_each_pixel(size, [&](int x, int y) { wrong += std::abs(other.at(x, y) - n.at(x, y)) > 1; });
    CHECK(wrong == 0);
    int hole = 0;
    const float none[] = {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, -1, -0.0f};
    const image<> holed =
        fill(size, 1, [&](int x, int y, int) { return d.at(x, y) > 0 ? d.at(x, y) : none[hole++ % 5]; });
    REQUIRE(hole > 50);
    CHECK(counts_from_density(holed.view(), b) == n);
}

TEST_CASE("what rounding leaves over stays near: every aligned square has its share, and rows and columns alike") {
    constexpr extent wide{256, 256};
    const auto ramp = [](int x, int y) { return 0.05 + 0.002 * x + 0.001 * y * y / 256.0; };
    const image<> d = fill(wide, 1, [&](int x, int y, int) { return ramp(x, y); });
    double sum = 0;
    for_each_pixel(wide, [&](int x, int y) { sum += d.at(x, y); });
    const std::int64_t total = wide.pixels() / 3;  // most pixels get 0 or 1
    const sample_counts n = counts_from_density(d.view(), {.total = total});
    const double scale = static_cast<double>(total) / sum;
    for (const int side : {1, 2, 8, 64}) {
        std::vector<double> missing(static_cast<std::size_t>(wide.pixels() / (side * side)));
        for_each_pixel(wide, [&](int x, int y) {
            missing[static_cast<std::size_t>(y / side * (wide.width / side) + x / side)] +=
                scale * d.at(x, y) - n.at(x, y);
        });
        double worst = 0;
        for (const double m : missing) worst = std::max(worst, std::abs(m));
        CAPTURE(side);
        CHECK(worst < 1 + 1e-6);
    }
    // Independent rounding would deviate by 256 * 0.22 = 7.5 at one sigma in a row, and a third of the rows more.
    double rows = 0, columns = 0;
    for (int i = 0; i < 256; ++i) {
        double row = 0, column = 0;
        for (int j = 0; j < 256; ++j) {
            row += n.at(j, i) - scale * d.at(j, i);
            column += n.at(i, j) - scale * d.at(i, j);
        }
        rows += row * row / 256, columns += column * column / 256;
    }
    CAPTURE(rows, columns);
    CHECK(rows < 8 * 8);
    CHECK(columns < 8 * 8);
}

TEST_CASE("other phases round up other pixels") {
    const image<> d = fill(size, 1, [](int, int, int) { return 1; });
    sample_counts sum(size);
    for (int k = 0; k < 4; ++k)
        sum += counts_from_density(d.view(), {.total = size.pixels() / 4, .phase = (k + 0.5) / 4});
    // One in four pixels each time: after four times nearly every pixel had its turn, and none twice.
    CHECK(sum.most() == 1);
    CHECK(sum.total() == size.pixels() / 4 * 4);
}

TEST_CASE("what cannot be handed out is refused with the numbers") {
    const image<> d({4, 3});
    CHECK_THROWS_WITH(counts_from_density(d.view(), {.total = 121, .cap = 10}),
                      "a budget of 121 samples is more than 10 in each of 12 pixels");
    CHECK(counts_from_density(d.view(), {.total = 120, .cap = 10}).fewest() == 10);
    CHECK_THROWS_AS(counts_from_density(d.view(), {.total = 1, .cap = 0}), invalid_input);
    CHECK(counts_from_density(d.view(), {.total = 0, .cap = 0}).total() == 0);
    CHECK_THROWS_WITH(counts_from_density(d.view(), {.total = -1}), Catch::Contains("neither may be negative"));
    CHECK_THROWS_WITH(counts_from_density(d.view(), {.total = 1, .cap = -5}), Catch::Contains("at most -5"));
    CHECK_THROWS_WITH(counts_from_density(d.view(), {.total = 1, .phase = 1}), Catch::Contains("phase"));
    CHECK_THROWS_WITH(counts_from_density(image<>({4, 3}, 3).view(), {.total = 1}),
                      "a sampling density has one channel, not 3");
    CHECK_THROWS_AS(counts_from_density(source{}, {}), invalid_input);
}

TEST_CASE("counts are added, and read by filters as a plane") {
    sample_counts n({3, 2}, 4);
    n.at(2, 1) = 7;
    CHECK(n.total() == 27);
    CHECK((n += n).at(2, 1) == 14);
    CHECK(n.fewest() == 8);
    CHECK(n.plane().at(2, 1) == 14);
    CHECK(n.plane().at(1, 0) == 8);
    CHECK_THROWS_WITH(n += sample_counts({2, 3}), "sample counts of 2x3 pixels cannot be added to some of 3x2");
    CHECK_THROWS_AS(sample_counts({0, 3}), invalid_input);
    CHECK(sample_counts() == sample_counts());
}
