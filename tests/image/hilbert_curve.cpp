// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/image/hilbert_curve.hpp>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <support/catch.hpp>
#include <utility>
#include <vector>

using namespace winnow;

namespace {

std::vector<std::pair<int, int>> visited(extent size) {
    std::vector<std::pair<int, int>> order;
    along_hilbert_curve(size, [&](int x, int y) { order.emplace_back(x, y); });
    return order;
}

}  // namespace

TEST_CASE("the curve of side 4 as Hilbert drew it") {
    const std::vector<std::pair<int, int>> drawn{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 2}, {0, 3}, {1, 3}, {1, 2},
                                                 {2, 2}, {2, 3}, {3, 3}, {3, 2}, {3, 1}, {2, 1}, {2, 0}, {3, 0}};
    CHECK(visited({4, 4}) == drawn);
}

TEST_CASE("every pixel is visited once, whatever the size") {
    for (const extent size : {extent{1, 1}, extent{37, 29}, extent{64, 64}, extent{1, 1000}, extent{1000, 1}}) {
        const auto order = visited(size);
        CHECK(std::ssize(order) == size.pixels());
        CHECK(std::set(order.begin(), order.end()).size() == order.size());
        CHECK(std::all_of(order.begin(), order.end(), [&](const auto& p) {
            return p.first >= 0 && p.second >= 0 && p.first < size.width && p.second < size.height;
        }));
    }
    CHECK(visited({0, 0}).empty());
    CHECK(visited({100'000, 1}).size() == 100'000);  // not the square around it
}

TEST_CASE("in a square of side 2^n each step leads to a pixel beside, and aligned squares are visited in one go") {
    const auto order = visited({64, 64});
    for (std::size_t i = 1; i < order.size(); ++i)
        REQUIRE(std::abs(order[i].first - order[i - 1].first) + std::abs(order[i].second - order[i - 1].second) == 1);
    for (const int side : {2, 8, 32})
        for (std::size_t i = 0; i < order.size(); ++i) {
            const auto& begin = order[i / (side * side) * (side * side)];
            REQUIRE(order[i].first / side == begin.first / side);
            REQUIRE(order[i].second / side == begin.second / side);
        }
}
