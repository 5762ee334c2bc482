// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <support/statistics.hpp>
#include <winnow/estimator/sure.hpp>
#include <winnow/executor/simd.hpp>
#include <winnow/paper/nlm_2012.hpp>

using namespace winnow;
using namespace winnow::test;

static_assert(estimator::sure<>::reports && estimator::sure<>::needs_derivative && !estimator::sure<>::needs_halves);

TEST_CASE("Stein's estimate, worked by hand") {
    const estimator::sure error;
    CHECK(error({.input = 3, .filtered = 1, .variance = 0.5f, .derivative = 0.25f}) == 4 - 0.5f + 0.25f);
    CHECK(error({.input = 1, .filtered = 1, .variance = 0.5f, .derivative = 0}) == -0.5f);
    CHECK(error({.input = 1, .filtered = 1, .variance = 0.5f, .derivative = 1}) ==
          0.5f);  // what is not filtered keeps its noise
}

TEST_CASE("it is unbiased: over both outcomes of a coin it is the squared error of a linear filter") {
    // u = x +- s with x = 2, s = 0.5;  F = 0.75 u + 0.1, dF/du = 0.75.
    double estimated = 0, squared = 0;
    for (const float noise : {-0.5f, 0.5f}) {
        const float u = 2 + noise, f = 0.75f * u + 0.1f;
        estimated += estimator::sure{}({.input = u, .filtered = f, .variance = 0.25f, .derivative = 0.75f});
        squared += (f - 2) * (f - 2);
    }
    CHECK(estimated == Approx(squared).epsilon(1e-6));
}

namespace {

struct over_draws {
    statistic excess;      ///< the estimate minus the squared error
    statistic squared;     ///< the squared error
    statistic derivative;  ///< 2 Var dF/du, what the estimate would lack without it
};

/// Non-local means of a structured image under many draws of Gaussian noise whose variance is known and differs from
/// pixel to pixel.  Each draw gives one value: the mean over the image.
over_draws over_noise(int patch_radius, int draws) {
    const extent size{13, 11};
    const image<> truth = fill(size, 3, [](int x, int y, int c) { return structure(2 * x, 2 * y, c); });
    const image<> noise = fill(size, 3, [](int x, int y, int c) { return 0.01 * (0.5 + uniform(7, x, y, c)); });
    const auto f = paper::make_nlm({.radius = 4, .patch_radius = patch_radius, .k = 0.45f}).with(estimator::sure{});
    image<> u(size, 3), filtered(size, 3), error(size, 3), derivative(size, 3);
    const frame in{color = u.view(), variance(color) = noise.view()};
    const output out = output{filtered}.error(error.view()).derivative(derivative.view());
    const executor::simd lanes;
    workspace memory;
    over_draws found;
    for (int n = 0; n < draws; ++n) {
        double excess = 0, squared = 0, of_derivative = 0;
        const auto each = [&](const auto& g) {
            for (int c = 0; c < 3; ++c)
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) g(x, y, c);
        };
        each([&](int x, int y, int c) {
            const double sigma = std::sqrt(double{noise.at(x, y, c)});
            u.at(x, y, c) = static_cast<float>(truth.at(x, y, c) +
                                               sigma * normal_deviate(static_cast<std::uint64_t>(100 + n), x, y, c));
        });
        f(in, out, lanes, memory);
        const double values = 3.0 * static_cast<double>(size.pixels());
        each([&](int x, int y, int c) {
            const double off = double{filtered.at(x, y, c)} - double{truth.at(x, y, c)};
            squared += off * off / values;
            excess += (error.at(x, y, c) - off * off) / values;
            of_derivative += 2.0 * noise.at(x, y, c) * derivative.at(x, y, c) / values;
        });
        found.excess.add(excess), found.squared.add(squared), found.derivative.add(of_derivative);
    }
    return found;
}

}  // namespace

TEST_CASE("over many draws of noise Stein's estimate is the squared error of non-local means") {
    for (const int patch_radius : {1, 3}) {
        const over_draws found = over_noise(patch_radius, 4000);
        CAPTURE(patch_radius, found.excess, found.squared, found.derivative);
        CHECK(std::abs(found.excess.mean) <= 3 * found.excess.standard_error());
        // What a twentieth of the derivative's share would change is seen: the test is not an empty one.
        CHECK(found.derivative.mean > 20 * 3 * found.excess.standard_error());
    }
}
