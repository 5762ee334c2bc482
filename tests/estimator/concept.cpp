// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/policies.hpp>
#include <support/scattered.hpp>

using namespace winnow;
using namespace winnow::test;

static_assert(!estimator_policy<int> && !estimator_policy<window::square>);

namespace {

/// A pixel all of whose noise is the same.
struct pixel_of_noise {
    float variance;
    template <class G>
    float p(G, int) const {
        return variance;
    }
};
struct unit_bandwidth {
    float sigma = 1;
};

/// What the estimator says of pixel i of an image that is `scale` times as bright.
template <class Estimator>
float estimate(const Estimator& estimator, std::uint32_t i, float scale) {
    if constexpr (summing_estimator<Estimator>) {
        // Differences grow with the scale, differences in units of the spread of the samples with its inverse.
        float sums[Estimator::sums];
        constexpr int D = Estimator::D;
        for (int k = 0; k < Estimator::sums; ++k)
            sums[k] = scattered(9 * i + static_cast<std::uint32_t>(k)) * (k < D ? scale : k < 2 * D ? 1 / scale : 1);
        return estimator(unit_bandwidth{}, 3.0f, sums, pixel_of_noise{scattered(5 * i + 1) * scale * scale});
    } else {
        return estimator({.input = scattered(4 * i) * scale,
                          .filtered = scattered(4 * i + 1) * scale,
                          .half_a = scattered(4 * i + 2) * scale,
                          .half_b = scattered(4 * i + 3) * scale,
                          .variance = scattered(5 * i + 1) * scale * scale,
                          .derivative = scattered(7 * i)});
    }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("an estimate is a squared error: twice the radiance is four times the error", "", estimators) {
    const auto estimator = std::get<TestType>(estimator_examples);
    for (std::uint32_t i = 0; i < 100; ++i) {
        const float once = estimate(estimator, i, 1);
        CHECK(estimate(estimator, i, 2) == Approx(4 * once).margin(1e-5));
        CHECK(estimate(estimator, i, -1) == Approx(once).margin(1e-6));
    }
}

TEMPLATE_LIST_TEST_CASE("no error is estimated where nothing speaks of one", "", estimators) {
    const auto estimator = std::get<TestType>(estimator_examples);
    if constexpr (summing_estimator<TestType>) {
        const float nothing[TestType::sums] = {};
        CHECK(estimator(unit_bandwidth{}, 1.0f, nothing, pixel_of_noise{0}) == 0);
    } else {
        for (const float value : {0.0f, -2.5f, 1e8f})
            CHECK(estimator({.input = value, .filtered = value, .half_a = value, .half_b = value}) == 0);
    }
}
