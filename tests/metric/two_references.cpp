// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/metric/two_references.hpp>

#include <random>
#include <support/catch.hpp>
#include <support/statistics.hpp>
#include <winnow/image/image.hpp>
#include <winnow/metric/mse.hpp>
#include <winnow/metric/relative_mse.hpp>

using namespace winnow;

namespace {

image<float> pixels(std::initializer_list<float> values) {
    image<float> i({static_cast<int>(values.size()), 1});
    int x = 0;
    for (const float v : values) i.at(x++, 0) = v;
    return i;
}

}  // namespace

TEST_CASE("worked by hand") {
    const image<float> x = pixels({1, 2}), a = pixels({0, 2}), b = pixels({3, 1});
    CHECK(metric::mse(x.view(), a.view(), b.view()) == (1 * -2 + 0 * 1) / 2.0);
    CHECK(std::abs(metric::relative_mse(x.view(), a.view(), b.view(), 0.75) - (-2 / (1.5 * 1.5 + 0.75)) / 2) < 1e-12);
}

TEST_CASE("one reference given twice is one reference") {
    const image<float> x = pixels({1, 2, -3}), r = pixels({0.5, 2, 7});
    CHECK(metric::mse(x.view(), r.view(), r.view()) == metric::mse(x.view(), r.view()));
    CHECK(metric::relative_mse(x.view(), r.view(), r.view()) == metric::relative_mse(x.view(), r.view()));
}

TEST_CASE("the noise of the references does not count, that of one does") {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, 0.5f);
    test::statistic two, one;
    for (int seed = 0; seed < 400; ++seed) {
        image<float> x({16, 16}), a({16, 16}), b({16, 16});
        for (int j = 0; j < 16; ++j)
            for (int i = 0; i < 16; ++i) {
                x.at(i, j) = 1 + 0.3f;  // off by 0.3
                a.at(i, j) = 1 + noise(random);
                b.at(i, j) = 1 + noise(random);
            }
        two.add(metric::mse(x.view(), a.view(), b.view()));
        one.add(metric::mse(x.view(), a.view()));
    }
    CHECK(two.allows(0.09));
    CHECK(one.mean > 0.3);
}

TEST_CASE("references of another size are refused, and a NaN is not hidden") {
    const image<float> x = pixels({1, 2}), r = pixels({1, 2}), small = pixels({1});
    CHECK_THROWS_WITH(metric::mse(x.view(), r.view(), small.view()), "the image is 2x1, the reference is 1x1");
    CHECK_THROWS_AS(metric::relative_mse(x.view(), r.view(), r.view(), 0), invalid_input);
    CHECK(std::isnan(metric::mse(x.view(), r.view(), pixels({1, std::numeric_limits<float>::quiet_NaN()}).view())));
}
