// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/random.hpp>

#include <set>
#include <support/catch.hpp>
#include <support/statistics.hpp>
#include <winnow/simulate/effect.hpp>

using namespace winnow::simulate;
using winnow::test::statistic;

namespace {

sample_numbers numbers(int x, int y, int index, pattern p = pattern::stratified, std::uint64_t seed = 1,
                       int frame = 0) {
    return {p, seed, frame, x, y, index};
}

/// The points of one half in a pixel and a pair of dimensions.
std::vector<vec2> points(int count, int pixel, int half, pattern p = pattern::stratified) {
    std::vector<vec2> all;
    for (int i = 0; i < count; ++i) all.push_back(numbers(pixel, 7, 2 * i + half, p)(draw::light{}, 2));
    return all;
}

/// The second dimension of Sobol's sequence by its direction numbers, bit by bit.
std::uint32_t sobol(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t v = 1u << 31; index; index >>= 1, v ^= v >> 1)
        if (index & 1) result ^= v;
    return result;
}

}  // namespace

static_assert(!std::is_invocable_v<random_numbers<effects<>>, draw::lens>);  // nobody declared a lens
static_assert(std::is_invocable_v<random_numbers<effects<effect::depth_of_field>>, draw::lens>);
static_assert(std::is_invocable_v<random_numbers<effects<>>, draw::image>);

TEST_CASE("the product with Pascal's triangle is Sobol's second dimension") {
    for (std::uint32_t i : {0u, 1u, 2u, 3u, 5u, 255u, 4711u, 0x80000001u, 0xdeadbeefu, 0xffffffffu})
        CHECK(detail::reversed(detail::times_pascal(i)) == sobol(i));
}

TEST_CASE("any first 2^k samples of a half have one point in each elementary interval of that size") {
    for (int k = 0; k <= 7; ++k)
        for (int wide = 0; wide <= k; ++wide)
            for (int pixel = 0; pixel < 8; ++pixel) {
                std::set<std::pair<int, int>> cells;
                for (const vec2& p : points(1 << k, pixel, pixel % 2))
                    cells.insert({static_cast<int>(p.x() * (1 << wide)), static_cast<int>(p.y() * (1 << (k - wide)))});
                CHECK(cells.size() == std::size_t{1} << k);
            }
}

TEST_CASE("numbers are even from 0 to 1 and unrelated across dimensions, pixels, halves, seeds and frames") {
    for (const pattern p : {pattern::stratified, pattern::independent}) {
        statistic mean, square, axes, vertices, pixels, halves, seeds, frames;
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x < 200; ++x) {
                const auto centred = [](double u) { return u - 0.5; };
                const vec2 u = numbers(x, y, 0, p)(draw::light{}, 1);
                const double a = centred(u.x());
                REQUIRE((u.x() >= 0 && u.x() < 1));
                mean.add(u.x());
                square.add(a * a);
                axes.add(a * centred(u.y()));
                vertices.add(a * centred(numbers(x, y, 0, p)(draw::light{}, 2).x()));
                pixels.add(a * centred(numbers(x + 1, y, 0, p)(draw::light{}, 1).x()));
                halves.add(a * centred(numbers(x, y, 1, p)(draw::light{}, 1).x()));
                seeds.add(a * centred(numbers(x, y, 0, p, 2)(draw::light{}, 1).x()));
                frames.add(a * centred(numbers(x, y, 0, p, 1, 1)(draw::light{}, 1).x()));
            }
        CHECK(mean.allows(0.5));
        CHECK(square.allows(1.0 / 12));
        for (const statistic& s : {axes, vertices, pixels, halves, seeds, frames}) CHECK(s.allows(0));
    }
}

TEST_CASE("the two halves of a pixel are independent: their errors do not correlate") {
    statistic product;
    for (int pixel = 0; pixel < 4000; ++pixel) {
        double error[2];
        for (int half = 0; half < 2; ++half) {
            double sum = 0;
            for (const vec2& p : points(4, pixel, half)) sum += p.x() * p.y();
            error[half] = sum / 4 - 0.25;
        }
        product.add(error[0] * error[1]);
    }
    CHECK(product.allows(0));
}

TEST_CASE("stratified samples integrate a smooth function far better than independent ones") {
    statistic stratified, independent;
    for (int pixel = 0; pixel < 500; ++pixel)
        for (const pattern p : {pattern::stratified, pattern::independent}) {
            double sum = 0;
            for (const vec2& u : points(16, pixel, 0, p)) sum += u.x() * u.y();
            const double error = sum / 16 - 0.25;
            (p == pattern::stratified ? stratified : independent).add(error * error);
        }
    CHECK(stratified.mean < independent.mean / 10);
}
