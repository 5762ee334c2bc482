// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/io/png.hpp>

#include <limits>
#include <support/folder.hpp>
#include <winnow/image/image.hpp>

using namespace winnow;
using test::folder;

TEST_CASE("radiance becomes 8 bits by exposure, a cut to [0, 1] and the sRGB curve") {
    const io::tone_map plain;
    CHECK(plain(0.0f) == 0);
    CHECK(plain(-3.0f) == 0);
    CHECK(plain(1.0f) == 255);
    CHECK(plain(1e30f) == 255);
    CHECK(plain(0.5f) == 188);  // 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354
    CHECK(plain(0.002f) == 7);  // 12.92 * 0.002 = 0.0258
    CHECK(io::tone_map{.exposure = 1}(0.25f) == 188);
    CHECK(io::tone_map{.exposure = -2}(2.0f) == 188);
}

TEST_CASE("a larger error is a brighter colour, from black on") {
    CHECK(io::error_colour(0) == io::rgb8{0, 0, 0});
    CHECK(io::error_colour(1) == io::error_colour(7));
    double last = -1;
    for (int i = 0; i <= 100; ++i) {
        const io::rgb8 c = io::error_colour(static_cast<float>(i) / 100);
        const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
        CHECK(luminance > last);
        last = luminance;
    }
    CHECK(io::error_colour(std::numeric_limits<float>::quiet_NaN()) == io::not_a_number);
}

TEST_CASE("a picture is a PNG file of the size of its image") {
    const folder f;
    image<float> rgb({5, 3}, 3);
    rgb.at(1, 1, 0) = std::numeric_limits<float>::infinity();
    io::write_png(f / "a.png", source(rgb.view()));
    const std::string png = f.read("a.png");
    REQUIRE(png.size() > 33);
    CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    CHECK(png.substr(12, 12) == std::string("IHDR\0\0\0\5\0\0\0\3", 12));
    CHECK(png.ends_with(std::string("IEND\xae\x42\x60\x82")));
    io::write_error_png(f / "e.png", source(rgb.view()).channel(0), 0.5f);
    CHECK(f.files() == 2);
}

TEST_CASE("a picture that cannot be written leaves nothing behind") {
    const folder f;
    image<float> grey({64, 64});
    for (int i = 0; i < 4096; ++i) grey.at(i % 64, i / 64) = static_cast<float>(i * 7919 % 4096) / 4096;
    const auto write = [&](const std::string& name) {
        return test::message_of([&] { io::write_png(f / name, source(grey.view())); });
    };
    CHECK(write("none/a.png") == "cannot write " + f.name("none/a.png") + ": No such file or directory");
    CHECK(test::with_files_of_at_most(100, [&] { return write("a.png"); }) ==
          "cannot write " + f.name("a.png") + ": File too large");
    CHECK(test::message_of([&] { io::write_png(f / "b.png", source(image_view<const float>())); }) ==
          "cannot write " + f.name("b.png") + ": the image is 0x0");
    CHECK(f.files() == 0);
}
