// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/policies.hpp>
#include <support/scattered.hpp>

using namespace winnow;
using namespace winnow::test;

static_assert(!estimator_policy<int> && !estimator_policy<window::square>);

TEMPLATE_LIST_TEST_CASE("an estimate is a squared error: twice the radiance is four times the error", "", estimators) {
    const auto estimator = std::get<TestType>(estimator_examples);
    for (std::uint32_t i = 0; i < 100; ++i) {
        const auto at = [&](float scale) {
            return estimator({.input = scattered(4 * i) * scale,
                              .filtered = scattered(4 * i + 1) * scale,
                              .half_a = scattered(4 * i + 2) * scale,
                              .half_b = scattered(4 * i + 3) * scale,
                              .variance = scattered(5 * i + 1) * scale * scale,
                              .derivative = scattered(7 * i)});
        };
        CHECK(at(2) == Approx(4 * at(1)).margin(1e-5));
        CHECK(at(-1) == Approx(at(1)).margin(1e-6));
    }
}

TEMPLATE_LIST_TEST_CASE("no error is estimated where nothing speaks of one", "", estimators) {
    const auto estimator = std::get<TestType>(estimator_examples);
    for (const float value : {0.0f, -2.5f, 1e8f})
        CHECK(estimator({.input = value, .filtered = value, .half_a = value, .half_b = value}) == 0);
}
