// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/metric/psnr.hpp>

using namespace winnow;

namespace {
double psnr_of(const float (&x)[2], const float (&reference)[2]) {
    return metric::psnr(planar(x, {2, 1}, 1), planar(reference, {2, 1}, 1));
}
}  // namespace

TEST_CASE("psnr is that of the tone-mapped images") {
    // Errors of 0.02584 and 0, so an MSE of 0.02584^2 / 2.
    CHECK(psnr_of({0.002f, 0.7f}, {0.0f, 0.7f}) == Approx(-10 * std::log10(0.02584 * 0.02584 / 2)).epsilon(1e-6));
    CHECK(psnr_of({0.0f, 1.0f}, {1.0f, 0.0f}) == Approx(0).margin(1e-12));                   // as wrong as can be
    CHECK(psnr_of({0.0f, 9.0f}, {-2.0f, 1.0f}) == std::numeric_limits<double>::infinity());  // look the same
}

TEST_CASE("psnr is NaN where a value is not finite, and refuses images of different sizes") {
    CHECK(std::isnan(psnr_of({0.0f, std::numeric_limits<float>::infinity()}, {0.0f, 1.0f})));
    const float four[4] = {};
    CHECK_THROWS_WITH(metric::psnr(planar(four, {2, 2}, 1), planar(four, {4, 1}, 1)),
                      "the image is 2x2, the reference is 4x1");
}
