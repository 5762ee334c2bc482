// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <limits>
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/executor/pool.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/filter/gaussian_blur.hpp>
#include <winnow/weight/gaussian.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

image<> blurred(const image<>& from, float sigma, int threads = 1) {
    image<> to(from.size(), from.channels());
    scratch_memory memory;
    executor::fresh_threads tasks{threads};
    gaussian_blur(from.view(), to.view(), sigma, executor::pool{tasks, executor::serial<>{}}, memory);
    return to;
}

}  // namespace

TEST_CASE("a blur along x, then along y, is the Gaussian filter") {
    for (const extent size : {extent{40, 31}, extent{3, 17}, extent{1, 1}, extent{16, 2}})
        for (const float sigma : {0.5f, 1.0f, 1.5f, 3.0f}) {
            const image<> from = fill(size, 3, structure);
            image<> expected(size, 3);
            const filter gaussian_filter{gaussian(spatial, sigma),
                                         window::square{static_cast<int>(std::ceil(3 * sigma))}};
            gaussian_filter(frame{color = from.view()}, expected, executor::serial<double>{});
            CAPTURE(size.width, size.height, sigma);
            CHECK(beyond(2e-6, blurred(from, sigma), expected) == "");
        }
}

TEST_CASE("a blur of sigma 0 is a copy, bit for bit") {
    const image<> from = fill({23, 9}, 2, structure);
    CHECK(beyond(0, blurred(from, 0), from) == "");
}

TEST_CASE("a blur has the same bits on any number of threads") {
    const image<> from = fill({33, 29}, 2, structure);
    const image<> expected = blurred(from, 1.5f);
    for (const int threads : {2, 3, 7, 64}) CHECK(beyond(0, blurred(from, 1.5f, threads), expected) == "");
}

TEST_CASE("a bad pixel is replaced before it is blurred") {
    image<> from = fill({21, 19}, 1, structure), mended = from;
    double sum = -from.at(7, 8);
    for (int y = 7; y <= 9; ++y)
        for (int x = 6; x <= 8; ++x) sum += from.at(x, y);
    from.at(7, 8) = std::numeric_limits<float>::quiet_NaN();
    mended.at(7, 8) = static_cast<float>(sum / 8);
    CHECK(beyond(1e-6, blurred(from, 1.5f), blurred(mended, 1.5f)) == "");
}
