// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/samples.hpp>

#include <support/catch.hpp>
#include <winnow/image/image.hpp>

using namespace winnow;

namespace {

using some = planes<color_t, depth_t>;
using more = planes<depth_t, albedo_t, color_t>;

float value(int x, int y, int i, int c) { return static_cast<float>(((10 * y + x) * 10 + i) * 10 + c); }

samples<some> patterned(extent size, int spp) {
    samples<some> all(size, spp);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < spp; ++i) {
                sample<more> s;
                for (int c = 0; c < 3; ++c) s.at(color, c) = value(x, y, i, c);
                s.at(depth) = value(x, y, i, 3);
                s.at(albedo) = -1;
                all.set(x, y, i, s);
            }
    return all;
}

}  // namespace

TEST_CASE("every sample is where it was put") {
    const samples<some> all = patterned({4, 3}, 5);
    CHECK(all.size() == extent{4, 3});
    CHECK(all.per_pixel() == 5);
    int wrong = 0;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x)
            for (int i = 0; i < 5; ++i)
                for (int c = 0; c < 4; ++c) wrong += all.at(x, y, i).values[c] != value(x, y, i, c);
    CHECK(wrong == 0);
}

TEST_CASE("sample i of all pixels is an image, without a copy") {
    const samples<some> all = patterned({4, 3}, 5);
    const source colors = all.view(color, 2), depths = all.view(depth, 4);
    CHECK(colors.size == extent{4, 3});
    CHECK(colors.channels == 3);
    CHECK(depths.channels == 1);
    int wrong = 0;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) {
            for (int c = 0; c < 3; ++c) wrong += colors.channel(c).at(x, y) != value(x, y, 2, c);
            wrong += depths.at(x, y) != value(x, y, 4, 3);
        }
    CHECK(wrong == 0);
    CHECK(static_cast<const void*>(colors.data) == &all.at(0, 0, 2).values[0]);
}

TEST_CASE("the memory is known before, and refused where it makes no sense") {
    CHECK(samples<some>::bytes({1920, 1080}, 8) == std::size_t{1920} * 1080 * 8 * 4 * 4);
    CHECK_THROWS_WITH(samples<some>({4, 0}, 8), "an image of 4x0 pixels has no pixels");
    CHECK_THROWS_WITH(samples<some>({4, 4}, 0), "an image of 4x4 pixels with 0 samples in each has no samples");
    CHECK_THROWS_WITH(samples<some>({2000000000, 2000000000}, 2000000000),
                      "an image of 2000000000x2000000000 pixels at 16 bytes for each of 2000000000 samples is more "
                      "than can be addressed");
}
