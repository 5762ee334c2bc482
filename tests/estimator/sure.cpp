// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/estimator/sure.hpp>

using namespace winnow;

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
