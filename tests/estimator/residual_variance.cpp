// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/estimator/residual_variance.hpp>

using namespace winnow;

static_assert(estimator::residual_variance::reports && estimator::residual_variance::needs_halves);

TEST_CASE("the residual variance is the square of half the difference of the halves, whatever else is known") {
    const estimator::residual_variance error;
    CHECK(error({.input = 9, .filtered = 7, .half_a = 3, .half_b = 1}) == 1);
    CHECK(error({.half_a = 1, .half_b = 3}) == 1);
    CHECK(error({.half_a = -0.25f, .half_b = 0.5f}) == 0.375f * 0.375f);
}

TEST_CASE("it is unbiased: over all outcomes of two coins it is the variance of their mean") {
    // Halves of -1 or 1 each: a variance of 1, so 1/2 for their mean.
    double sum = 0;
    for (const float a : {-1.0f, 1.0f})
        for (const float b : {-1.0f, 1.0f}) sum += estimator::residual_variance{}({.half_a = a, .half_b = b});
    CHECK(sum / 4 == 0.5);
}
