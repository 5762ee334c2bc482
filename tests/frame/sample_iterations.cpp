// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/sample_iterations.hpp>

#include <support/catch.hpp>
#include <support/patterns.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("iterations share a budget equally and spend it exactly") {
    constexpr extent size{23, 17};
    const image<> density = fill(size, 1, [](int x, int y, int) { return uniform(1, x, y) < 0.02 ? 1 : 1e-3; });
    for (const std::int64_t budget : {16 * size.pixels(), 16 * size.pixels() + 5, 37 * size.pixels() - 1})
        for (const int iterations : {1, 2, 3, 4, 7}) {
            CAPTURE(budget, iterations);
            const sample_iterations plan{.size = size, .budget = budget, .iterations = iterations};
            sample_counts had(size);
            for (int k = 0; k < iterations; ++k) {
                CHECK(std::abs(plan.share(k) - budget / iterations) <= 1);
                const sample_counts more = plan.counts(k, density.view());
                CHECK(more.total() == plan.share(k));
                CHECK(more.most() <= (budget + size.pixels() - 1) / size.pixels());
                if (k == 0) CHECK(more.most() - more.fewest() <= 1);
                else CHECK(more.most() - more.fewest() > 4);
                had += more;
            }
            CHECK(had.total() == budget);
        }
}

TEST_CASE("16 samples in 4 iterations of a uniform density are 16 in every pixel") {
    const sample_iterations plan{.size = {9, 7}, .budget = 16 * 63};
    const image<> flat = fill(plan.size, 1, [](int, int, int) { return 0.3; });
    for (int k = 0; k < 4; ++k) CHECK(plan.counts(k, flat.view()) == sample_counts(plan.size, 4));
}

TEST_CASE("where the density stays, other pixels are rounded up each time") {
    // A quarter of a sample in each pixel of the one half; the other half is busy.
    const sample_iterations plan{.size = {32, 32}, .budget = 12 * 1024, .iterations = 6, .cap = 8};
    const image<> density = fill(plan.size, 1, [](int x, int, int) { return x < 16 ? 0.25 : 3.75; });
    sample_counts sum(plan.size);
    for (int k = 1; k < 6; ++k) sum += plan.counts(k, density.view());
    int most = 0;
    std::int64_t total = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 16; ++x) most = std::max(most, sum.at(x, y)), total += sum.at(x, y);
    CHECK(std::abs(total - 5 * 128) < 5);
    CHECK(most == 2);  // 1.25 on the average
}

TEST_CASE("a cap of one's own is kept") {
    const sample_iterations plan{.size = {9, 7}, .budget = 16 * 63, .cap = 5};
    const image<> one = fill(plan.size, 1, [](int x, int y, int) { return x == 4 && y == 4; });
    CHECK(plan.counts(2, one.view()).at(4, 4) == 5);
    CHECK(sample_iterations{.size = {9, 7}, .budget = 16 * 63}.counts(2, one.view()).at(4, 4) == 16);
    CHECK_THROWS_WITH((sample_iterations{.size = {9, 7}, .budget = 16 * 63, .cap = 3}.counts(0)),
                      "a budget of 252 samples is more than 3 in each of 63 pixels");
}

TEST_CASE("iterations that make no sense are refused with the numbers") {
    const sample_iterations plan{.size = {4, 3}, .budget = 96};
    CHECK(plan.counts(0).fewest() == 2);
    CHECK_THROWS_WITH(plan.counts(4), "there is no iteration 4 of 4");
    CHECK_THROWS_WITH(plan.share(-1), "there is no iteration -1 of 4");
    CHECK_THROWS_WITH(plan.counts(1), "the density is 0x0, the iterations are for 4x3");
    CHECK_THROWS_WITH((sample_iterations{.size = {4, 3}, .budget = 95}.counts(0)),
                      "a budget of 95 samples in 4 iterations begins with fewer than two in each of 12 pixels");
    CHECK((sample_iterations{.size = {4, 3}, .budget = 7, .iterations = 1}.counts(0).total()) == 7);
    CHECK_THROWS_WITH((sample_iterations{.size = {4, 3}, .budget = 96, .iterations = 0}.share(0)),
                      "0 iterations: there must be at least one");
    CHECK_THROWS_WITH((sample_iterations{.budget = 96}.share(0)), "iterations for 0x0 have no pixels");
}
