// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/scattered.hpp>
#include <winnow/metric/ssim.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr double c1 = 1e-4, c2 = 9e-4;

image<> constant(extent size, float value) {
    image<> i(size, 3);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) i.at(x, y, c) = value;
    return i;
}

double ssim_of(const image<>& x, const image<>& reference) { return metric::ssim(x.view(), reference.view()); }

/// The definition, one pixel and one 11x11 window at a time.
double by_definition(const image<>& x, const image<>& reference) {
    const extent size = x.size();
    double sum = 0;
    for (int c = 0; c < x.channels(); ++c)
        for (int py = 0; py < size.height; ++py)
            for (int px = 0; px < size.width; ++px) {
                const auto mean = [&](auto f) {
                    double total = 0, weights = 0;
                    for (int dy = -5; dy <= 5; ++dy)
                        for (int dx = -5; dx <= 5; ++dx) {
                            const int qx = resolve(border::mirror, px + dx, size.width);
                            const int qy = resolve(border::mirror, py + dy, size.height);
                            const double w = std::exp(-(dx * dx + dy * dy) / 4.5);
                            total += w * f(srgb(x.at(qx, qy, c)), srgb(reference.at(qx, qy, c)));
                            weights += w;
                        }
                    return total / weights;
                };
                const double a = mean([](double v, double) { return v; }), b = mean([](double, double v) { return v; });
                const double aa = mean([a](double v, double) { return (v - a) * (v - a); });
                const double bb = mean([b](double, double v) { return (v - b) * (v - b); });
                const double ab = mean([a, b](double v, double w) { return (v - a) * (w - b); });
                sum += (2 * a * b + c1) * (2 * ab + c2) / ((a * a + b * b + c1) * (aa + bb + c2));
            }
    return sum / (3 * static_cast<double>(size.pixels()));
}

}  // namespace

TEST_CASE("identical images have an ssim of 1") {
    for (const extent size : {extent{1, 1}, extent{1, 9}, extent{13, 2}, extent{23, 17}})
        CHECK(ssim_of(pattern(size, 3), pattern(size, 3)) == Approx(1).epsilon(1e-12));
}

TEST_CASE("constant images differ by their means alone") {
    // Tones a = 0.02584 and b = 0.01292 without variance: (2 a b + c1) / (a^2 + b^2 + c1).
    const double a = 0.02584, b = 0.01292;
    for (const extent size : {extent{1, 1}, extent{2, 30}, extent{19, 13}})
        CHECK(ssim_of(constant(size, 0.002f), constant(size, 0.001f)) ==
              Approx((2 * a * b + c1) / (a * a + b * b + c1)).epsilon(1e-6));
}

TEST_CASE("two pixels against their exchange, by hand") {
    // Mirroring repeats the pixels in turn, so that even offsets meet the pixel itself and odd ones the other one.
    // exp(-n^2 / 4.5): 1, 0.8007374, 0.4111123, 0.1353353, 0.0285655, 0.0038659.
    const double even = 1 + 2 * (0.4111123 + 0.0285655), odd = 2 * (0.8007374 + 0.1353353 + 0.0038659);
    const double e = even / (even + odd), o = odd / (even + odd);
    // At the black pixel of x the means are o and e, both variances e o, and the covariance -e o.
    const double wanted = (2 * e * o + c1) * (-2 * e * o + c2) / ((e * e + o * o + c1) * (2 * e * o + c2));
    const float x[] = {0, 1}, reference[] = {1, 0};
    CHECK(metric::ssim(planar(x, {2, 1}, 1), planar(reference, {2, 1}, 1)) == Approx(wanted).epsilon(1e-6));
    CHECK(metric::ssim(planar(x, {1, 2}, 1), planar(reference, {1, 2}, 1)) == Approx(wanted).epsilon(1e-6));
}

TEST_CASE("ssim is what the definition gives, and symmetric") {
    const extent size{14, 9};
    const image<> x = pattern(size, 3, 1), reference = pattern(size, 3, 2);
    const double found = ssim_of(x, reference);
    CHECK(found == Approx(by_definition(x, reference)).epsilon(1e-10));
    CHECK(found == Approx(ssim_of(reference, x)).epsilon(1e-12));
    CHECK(found < 0.9);
}

TEST_CASE("ssim sees structure, not only means") {
    image<> up({16, 4}, 1), down({16, 4}, 1);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) {
            up.at(x, y) = static_cast<float>(1 + x) / 17;
            down.at(x, y) = static_cast<float>(16 - x) / 17;
        }
    CHECK(ssim_of(up, down) < 0);
}

TEST_CASE("ssim is NaN where a value is not finite, and refuses images of different sizes") {
    image<> bad = pattern({12, 5}, 3);
    bad.at(11, 4, 2) = std::numeric_limits<float>::quiet_NaN();
    CHECK(std::isnan(ssim_of(bad, pattern({12, 5}, 3))));
    CHECK(std::isnan(ssim_of(pattern({12, 5}, 3), bad)));
    CHECK_THROWS_WITH(ssim_of(pattern({4, 3}, 3), pattern({3, 4}, 3)), "the image is 4x3, the reference is 3x4");
}
