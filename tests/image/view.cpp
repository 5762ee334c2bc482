// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <vector>
#include <winnow/image/plane.hpp>

using namespace winnow;

namespace {
/// A renderer's own pixel.
struct pixel {
    float weight;
    float rgb[3];
    half normal[3];
    std::uint16_t object;
};
constexpr extent size{5, 3};

/// The number of channel c at (x, y); all differ, and a half holds them.
float number(int x, int y, int c) { return static_cast<float>(x + 10 * y + 100 * c); }

template <class View>
void check_numbers(const View& v) {
    for (int c = 0; c < v.channels; ++c)
        for (int y = 0; y < v.size.height; ++y)
            for (int x = 0; x < v.size.width; ++x) {
                CHECK(float(v.at(x, y, c)) == number(x, y, c));
                CHECK(source(v).channel(c).at(x, y) == number(x, y, c));
            }
}
}  // namespace

TEST_CASE("members of a renderer's own struct are read and written in place, float and half") {
    std::vector<pixel> frame(size.pixels());
    const auto rgb = interleaved(&frame[0].rgb[0], size, 3, sizeof(pixel));
    const auto normal = interleaved(&frame[0].normal[0], size, 3, sizeof(pixel));
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                rgb.at(x, y, c) = number(x, y, c);
                target(normal).channel(c).set(x, y, number(x, y, c));
            }
    check_numbers(rgb);
    check_numbers(normal);
    CHECK(frame[7].rgb[2] == number(2, 1, 2));
    CHECK(float(frame[14].normal[1]) == number(4, 2, 1));
    for (const pixel& p : frame) CHECK((p.weight == 0 && p.object == 0));
}

TEST_CASE("planes and rows may be padded, and rows may run upwards") {
    std::vector<float> memory(1000, -1);
    const auto fill = [](const image_view<float>& v) {
        for (int c = 0; c < v.channels; ++c)
            for (int y = 0; y < v.size.height; ++y)
                for (int x = 0; x < v.size.width; ++x) v.at(x, y, c) = number(x, y, c);
        check_numbers(v);
    };
    fill(planar(memory.data(), size, 2));
    CHECK(memory[15 + 5 + 3] == number(3, 1, 1));
    fill(planar(memory.data(), size, 2, 8 * sizeof(float)));
    CHECK(memory[24 + 8 + 3] == number(3, 1, 1));
    fill(planar(memory.data(), size, 2, 8 * sizeof(float), 100 * sizeof(float)));
    CHECK(memory[100 + 8 + 3] == number(3, 1, 1));
    fill(interleaved(memory.data(), size, 2, 3 * sizeof(float), 20 * sizeof(float)));
    CHECK(memory[20 + 9 + 1] == number(3, 1, 1));
    const auto row = static_cast<std::ptrdiff_t>(-5 * sizeof(float));
    fill({memory.data() + 10, size, 1, {0, sizeof(float), row}});  // as OpenGL stores images
    CHECK(memory[5 + 3] == number(3, 1, 0));
}

TEST_CASE("a view of some channels or some pixels is the same memory") {
    std::vector<float> memory(size.pixels() * 3);
    const auto all = planar(memory.data(), size, 3);
    all.at(2, 1, 2) = 7;
    CHECK(&all.channel(1, 2).at(2, 1, 1) == &all.at(2, 1, 2));
    CHECK(all.channel(1, 2).channels == 2);
    const auto part = all.crop({1, 1, 4, 3});
    CHECK(part.size == extent{3, 2});
    CHECK(&part.at(1, 0, 2) == &all.at(2, 1, 2));
}

// What may be written may be read, not the other way round.
static_assert(std::is_convertible_v<image_view<float>, image_view<const float>>);
static_assert(!std::is_convertible_v<image_view<const float>, image_view<float>>);
static_assert(std::is_convertible_v<image_view<const half>, source>);
static_assert(!std::is_convertible_v<image_view<const half>, target>);
static_assert(std::is_convertible_v<target, source> && !std::is_convertible_v<source, target>);
