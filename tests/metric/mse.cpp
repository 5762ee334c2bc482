// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <vector>
#include <winnow/metric/mse.hpp>
#include <winnow/metric/relative_mse.hpp>

using namespace winnow;

namespace {
struct two_pixels {
    std::vector<float> x, reference;
    source image() const { return planar(x.data(), {2, 1}, static_cast<int>(x.size() / 2)); }
    source wanted() const { return planar(reference.data(), {2, 1}, static_cast<int>(reference.size() / 2)); }
};
const two_pixels gray{{1.0f, 3.0f}, {2.0f, 1.0f}};  // errors -1 and 2
}  // namespace

TEST_CASE("mse is the mean of squared errors over pixels and channels") {
    CHECK(metric::mse(gray.image(), gray.wanted()) == 2.5);  // (1 + 4) / 2
    // Planes R and G of two pixels: errors -1, 2, 0 and 3.
    const two_pixels color{{1.0f, 3.0f, 5.0f, 7.0f}, {2.0f, 1.0f, 5.0f, 4.0f}};
    CHECK(metric::mse(color.image(), color.wanted()) == 3.5);  // (1 + 4 + 0 + 9) / 4
}

TEST_CASE("relative mse divides each squared error by the reference squared plus epsilon") {
    CHECK(metric::relative_mse(gray.image(), gray.wanted()) == Approx((1 / 4.01 + 4 / 1.01) / 2).epsilon(1e-12));
    CHECK(metric::relative_mse(gray.image(), gray.wanted(), 0.001) ==
          Approx((1 / 4.001 + 4 / 1.001) / 2).epsilon(1e-12));
    // At a black reference only epsilon is left: 0.1^2 / 0.01 = 1.
    const two_pixels black{{0.1f, 0.1f}, {0.0f, 0.0f}};
    CHECK(metric::relative_mse(black.image(), black.wanted()) == Approx(1).epsilon(1e-6));
    CHECK_THROWS_WITH(metric::relative_mse(gray.image(), gray.wanted(), 0.0), Catch::Contains("epsilon is 0.0"));
}

TEST_CASE("half and interleaved images are measured like any other") {
    const std::vector<half> halves{half(1.0f), half(9.0f), half(3.0f), half(9.0f)};  // the second channel is not meant
    const source x = interleaved(halves.data(), {2, 1}, 1, 2 * sizeof(half));
    CHECK(metric::mse(x, gray.wanted()) == 2.5);
}

TEST_CASE("a value that is not finite makes a metric NaN") {
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
    for (const float value : bad) {
        const two_pixels in_image{{1.0f, value}, {2.0f, 1.0f}}, in_reference{{1.0f, 3.0f}, {value, 1.0f}};
        CHECK(std::isnan(metric::mse(in_image.image(), in_image.wanted())));
        CHECK(std::isnan(metric::mse(in_reference.image(), in_reference.wanted())));
        CHECK(std::isnan(metric::relative_mse(in_image.image(), in_image.wanted())));
        CHECK(std::isnan(metric::relative_mse(in_reference.image(), in_reference.wanted())));
    }
}

TEST_CASE("images that cannot be compared are refused with both sizes") {
    const std::vector<float> six(6);
    const source wide = planar(six.data(), {3, 2}, 1), tall = planar(six.data(), {2, 3}, 1);
    const source three = planar(six.data(), {2, 1}, 3), one = planar(six.data(), {2, 1}, 1);
    CHECK_THROWS_WITH(metric::mse(wide, tall), "the image is 3x2, the reference is 2x3");
    CHECK_THROWS_WITH(metric::mse(three, one), "the image has 3 channels, the reference has 1");
    CHECK_THROWS_WITH(metric::mse({}, {}), Catch::Contains("nothing to compare"));
    CHECK_THROWS_AS(metric::relative_mse(wide, tall), invalid_input);
}
