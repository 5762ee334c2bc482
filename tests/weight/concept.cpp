// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/archetype.hpp>
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <support/policies.hpp>

using namespace winnow;
using namespace winnow::test;

static_assert(!weight_policy<distance::spatial>);  // a distance is no weight
static_assert(!weight_policy<window::square>);
static_assert(!exponential_weight<weight::cutoff<distance::spatial>>);
static_assert(exponential_weight<weight::gaussian<distance::spatial>>);

TEMPLATE_LIST_TEST_CASE("a weight is in [0, 1]", "", weights) {
    const auto& weight = std::get<TestType>(weight_examples);
    for_pairs(weight, [&](auto& around, int x, int y, int dx, int dy) {
        const float w = weight(around.pair(x, y, dx, dy));
        CHECK((w >= 0 && w <= 1));
    });
}

TEMPLATE_LIST_TEST_CASE("a pixel counts 1 for itself", "", weights) {
    const auto& weight = std::get<TestType>(weight_examples);
    for (const scales& s : all_scales) {
        neighbourhood<typename TestType::reads> around({12, 9}, s);
        for (int x = 2; x < 10; ++x) CHECK(weight(around.pair(x, 4, 0, 0)) == 1);
    }
}

TEMPLATE_LIST_TEST_CASE("a weight needs no more than the archetype offers, and float keeps to its bound", "", weights) {
    const auto& weight = std::get<TestType>(weight_examples);
    for_pairs(weight, [&](auto& around, int x, int y, int dx, int dy) {
        const archetype exact = weight(around.template pair<archetype>(x, y, dx, dy));
        CHECK(std::abs(weight(around.pair(x, y, dx, dy)) - value_of(exact)) <= bound_of(exact));
        CHECK(weight(around.template pair<double>(x, y, dx, dy)) == Approx(value_of(exact)).epsilon(1e-10));
    });
}

TEMPLATE_LIST_TEST_CASE("exp(-exponent) is the weight, where there is an exponent", "", weights) {
    const auto& weight = std::get<TestType>(weight_examples);
    if constexpr (exponential_weight<TestType>)
        for_pairs(weight, [&](auto& around, int x, int y, int dx, int dy) {
            const auto pair = around.pair(x, y, dx, dy);
            CHECK(weight.exponent(pair) >= 0);
            CHECK(weight(pair) == math::exp_neg(weight.exponent(pair)));
        });
}

TEMPLATE_LIST_TEST_CASE("no number in a buffer makes a weight NaN", "", weights) {
    const auto& weight = std::get<TestType>(weight_examples);
    for (const float bad : {NAN, INFINITY, -INFINITY, 3e38f, -3e38f}) {
        neighbourhood<typename TestType::reads> around({12, 9}, scales{});
        TestType::reads::for_each([&]<class G>(G g) { around.at(g, 5, 4, G::channels - 1) = bad; });
        for (int x = 3; x < 9; ++x)
            for (int dx = -1; dx <= 1; ++dx) {
                const float w = weight(around.pair(x, 4, dx, 0));
                CHECK((w >= 0 && w <= 1));
            }
    }
}

namespace {
/// Writes its number where a distance is asked for.
struct given {
    using role = role::distance;
    using reads = planes<>;
    float d = 0;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>&) const {
        return Real(d);
    }
};
float weight_of(const weight_policy auto& weight) { return weight(neighbourhood<planes<>>({1, 1}).pair(0, 0, 0, 0)); }
}  // namespace

TEST_CASE("no distance makes a weight NaN, negative or larger than 1") {
    const float lowest = std::numeric_limits<float>::lowest(), largest = std::numeric_limits<float>::max();
    for (const float d : {NAN, INFINITY, -INFINITY, lowest, -1.0f, -1e-40f, 0.0f, 1e-40f, 1.0f, 100.0f, largest}) {
        const given distance{d};
        for (const float w :
             {weight_of(exponential(distance)), weight_of(gaussian(distance, 1)), weight_of(gaussian(distance, 0)),
              weight_of(gaussian(distance, 1e20f)), weight_of(cutoff(distance, 1)),
              weight_of(min(exponential(distance), cutoff(distance, 1))),
              weight_of(min(exponential(distance), gaussian(distance, 2))),
              weight_of(exponential(distance) * gaussian(distance, 2)),
              weight_of(cutoff(distance, 1) * gaussian(distance, 2))}) {
            CHECK((w >= 0 && w <= 1));
            if (d <= 0) CHECK(w == 1);              // what noise explains counts in full, and no more
            if (std::isnan(d)) CHECK(w <= 2e-35f);  // what is no number counts for nothing
        }
    }
}
