// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/archetype.hpp>
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <support/policies.hpp>

using namespace winnow;
using namespace winnow::test;

static_assert(!distance_policy<weight::gaussian<distance::spatial>>);  // a weight is no distance
static_assert(!distance_policy<albedo_t>);                             // nor is a guide
static_assert(!distance_policy<int>);

// The archetype offers no more than it should.
static_assert(!std::is_constructible_v<bool, archetype::mask>);
static_assert(!std::is_convertible_v<float, archetype> && !std::is_convertible_v<archetype, float>);
static_assert(!std::is_default_constructible_v<archetype>);
template <class Real>
concept too_much = requires(Real a) {
    a > a;
}
|| requires(Real a) { a += a; }
|| requires(Real a) { a < 0.0f; }
|| requires(Real a) { a * 2.0f; }
|| requires(Real a) { std::exp(a); }
|| requires(Real a) { a == a; };
static_assert(too_much<float> && !too_much<archetype>);

TEMPLATE_LIST_TEST_CASE("a pixel is never at a positive distance from itself", "", distances) {
    const auto& distance = std::get<TestType>(distance_examples);
    for (const scales& s : all_scales) {
        neighbourhood<typename TestType::reads> around({12, 9}, s);
        for (int x = 2; x < 10; ++x) CHECK(distance(around.pair(x, 4, 0, 0)) <= 0);
    }
}

TEMPLATE_LIST_TEST_CASE("a distance needs no more than the archetype offers, and float keeps to its bound", "",
                        distances) {
    const auto& distance = std::get<TestType>(distance_examples);
    for_pairs(distance, [&](auto& around, int x, int y, int dx, int dy) {
        const archetype exact = distance(around.template pair<archetype>(x, y, dx, dy));
        CHECK(std::abs(distance(around.pair(x, y, dx, dy)) - value_of(exact)) <= bound_of(exact));
        CHECK(distance(around.template pair<double>(x, y, dx, dy)) == Approx(value_of(exact)).epsilon(1e-10));
    });
}

TEMPLATE_LIST_TEST_CASE("a distance compares with itself", "", distances) {
    const auto& distance = std::get<TestType>(distance_examples);
    const auto copy = distance;
    CHECK(copy == distance);
    static_assert(std::is_trivially_copyable_v<TestType>);
}
