// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <vector>
#include <winnow/executor/lanes.hpp>
#include <winnow/executor/window_sums.hpp>
#include "support/catch.hpp"
#include "support/patterns.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

/// The sums of a region by box_sums, value(x, y) in the grown region.
template <class Lanes, class Value>
std::vector<double> sums_of(extent region, int radius, const Value& value) {
    using real = typename Lanes::real;
    const box_sums<Lanes> box(region, radius);
    std::vector<real> memory(box.reals(), real(NAN));  // none of what was there is in a sum
    std::vector<double> found;
    box(
        memory.data(),
        [&](int x, int y, real* to) {
            for (int lane = 0; lane < Lanes::size; ++lane) to[lane] = static_cast<real>(value(x + lane, y));
        },
        [&](int y, const real* row) {
            CHECK(y * region.width == static_cast<int>(found.size()));
            found.insert(found.end(), row, row + region.width);
        });
    return found;
}

}  // namespace

TEMPLATE_TEST_CASE("window sums: every length, against the plain loop", "", lanes, double_lanes) {
    using real = typename TestType::real;
    for (int n = 1; n <= 67; ++n)
        for (const int next : {1, int{TestType::size}}) {
            const int count = 5 * TestType::size;  // whole lanes
            std::vector<real> values(static_cast<std::size_t>(count + (n + 2) * next + 2 * TestType::size));
            for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<real>(i * i % 97);  // exact sums
            std::vector<real> work(values.size()), found(static_cast<std::size_t>(3 * count));
            const int step = 3 * TestType::size;  // results further apart than values
            sum_windows<TestType>(batches<const real>{values.data(), TestType::size}, next, count, n, work.data(),
                                  batches<real>{found.data(), step});
            int wrong = 0;
            for (int i = 0; i < count; ++i) {
                real expected = 0;
                for (int k = 0; k < n; ++k) expected += values[static_cast<std::size_t>(i + k * next)];
                wrong += found[static_cast<std::size_t>(i / TestType::size * step + i % TestType::size)] != expected;
            }
            CAPTURE(n, next);
            CHECK(wrong == 0);
        }
}

TEMPLATE_TEST_CASE("box sums: regions and radii of all kinds, against the plain loops", "", lanes, double_lanes) {
    const auto value = [](int x, int y) { return (x * 7 + y * 13) % 31; };  // exact sums
    for (const extent region : {extent{1, 1}, extent{3, 7}, extent{16, 2}, extent{37, 11}})
        for (const int radius : {0, 1, 2, 3, 5, 8}) {
            const auto found = sums_of<TestType>(region, radius, value);
            REQUIRE(static_cast<std::int64_t>(found.size()) == region.pixels());
            int wrong = 0;
            for (int y = 0; y < region.height; ++y)
                for (int x = 0; x < region.width; ++x) {
                    int expected = 0;
                    for (int j = 0; j <= 2 * radius; ++j)
                        for (int i = 0; i <= 2 * radius; ++i) expected += value(x + i, y + j);
                    wrong += found[static_cast<std::size_t>(y * region.width + x)] != expected;
                }
            CAPTURE(to_string(region), radius);
            CHECK(wrong == 0);
        }
}

TEST_CASE("box sums: a value of 1e8 leaves no trace beyond its window, and bits do not depend on where the region is") {
    const auto value = [](int x, int y) { return x == 20 && y == 9 ? 1e8f : static_cast<float>(uniform(1, x, y)); };
    const auto without = [](int x, int y) { return static_cast<float>(uniform(1, x, y)); };
    const int radius = 4;
    const extent region{40, 15};
    const auto with_outlier = sums_of<lanes>(region, radius, value), plain = sums_of<lanes>(region, radius, without);
    const auto moved = sums_of<lanes>({31, 10}, radius, [&](int x, int y) { return without(x + 5, y + 3); });
    int changed = 0;
    for (int y = 0; y < region.height; ++y)
        for (int x = 0; x < region.width; ++x) {
            const auto i = static_cast<std::size_t>(y * region.width + x);
            const bool reached = x + 2 * radius >= 20 && x <= 20 && y + 2 * radius >= 9 && y <= 9;
            changed += with_outlier[i] != plain[i];
            CHECK((with_outlier[i] != plain[i]) == reached);
            if (x >= 5 && x < 36 && y >= 3 && y < 13)
                CHECK(moved[static_cast<std::size_t>((y - 3) * 31 + x - 5)] == plain[i]);
        }
    CHECK(changed == 81);
}
