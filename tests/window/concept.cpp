// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <set>
#include <support/catch.hpp>
#include <support/policies.hpp>

using namespace winnow;
using namespace winnow::test;

static_assert(!window_policy<int> && !window_policy<distance::spatial>);

namespace {
/// All offsets as an executor meets them.
std::set<std::pair<int, int>> offsets(const window_policy auto& window) {
    std::set<std::pair<int, int>> all;
    for (int dy = -window.reach(); dy <= window.reach(); ++dy)
        for (int dx = -window.half_width(dy); dx <= window.half_width(dy); ++dx)
            if (dx % step(window) == 0 && dy % step(window) == 0) all.emplace(dx, dy);
    return all;
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("a window holds its centre, is symmetric, and nothing is beyond its reach", "", windows) {
    const auto window = std::get<TestType>(window_examples);
    const auto all = offsets(window);
    CHECK(all.count({0, 0}) == 1);
    for (const auto& [dx, dy] : all) {
        CHECK(all.count({-dx, dy}) == 1);
        CHECK(all.count({dx, -dy}) == 1);
        CHECK(std::max(std::abs(dx), std::abs(dy)) <= window.reach());
    }
    CHECK(window.half_width(window.reach()) >= 0);  // its reach is no larger than it needs
}

TEMPLATE_LIST_TEST_CASE("area counts the offsets of a window", "", windows) {
    const auto window = std::get<TestType>(window_examples);
    CHECK(area(window) == static_cast<long long>(offsets(window).size()));
}
