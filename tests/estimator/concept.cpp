// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/policies.hpp>
#include <support/scattered.hpp>

using namespace winnow;
using namespace winnow::test;

static_assert(!estimator_policy<int> && !estimator_policy<window::square>);

TEMPLATE_LIST_TEST_CASE("an estimated error is never negative", "", estimators) {
    const auto estimator = std::get<TestType>(estimator_examples);
    for (std::uint32_t i = 0; i < 100; ++i)
        for (const float scale : {1e-6f, -1.0f, 1e6f}) {
            const pixel_estimate x{.input = scattered(4 * i) * scale,
                                   .filtered = scattered(4 * i + 1),
                                   .half_a = scattered(4 * i + 2) * scale,
                                   .half_b = scattered(4 * i + 3)};
            CHECK(estimator(x) >= 0);
        }
}

TEMPLATE_LIST_TEST_CASE("no error is estimated where nothing speaks of one", "", estimators) {
    const auto estimator = std::get<TestType>(estimator_examples);
    for (const float value : {0.0f, -2.5f, 1e8f})
        CHECK(estimator({.input = value, .filtered = value, .half_a = value, .half_b = value}) == 0);
}
