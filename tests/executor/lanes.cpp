// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <array>
#include <bit>
#include <support/archetype.hpp>
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <support/policies.hpp>
#include <winnow/core/cholesky.hpp>
#include <winnow/executor/lanes.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
using floats = std::array<float, lanes::size>;

floats stored(lanes v) {
    floats out;
    v.store(out.data());
    return out;
}

/// Calls f(x, result) for n arguments x, spread over all lanes, and their results under `operation`.
template <class Operation, class Argument, class F>
void for_arguments(int n, const Argument& argument, const Operation& operation, const F& f) {
    for (int i = 0; i < n; i += lanes::size) {
        floats x;
        for (int lane = 0; lane < lanes::size; ++lane) x[lane] = argument(i + lane);
        const floats result = stored(operation(lanes::load(x.data())));
        for (int lane = 0; lane < lanes::size; ++lane) f(x[lane], result[lane]);
    }
}

/// Every lane is within the archetype's bound of the exact result at its pixel.
template <class Policy>
void check_lanes(const Policy& policy) {
    for (const scales& s : all_scales) {
        neighbourhood<typename Policy::reads> around({16 + lanes::size, 9}, s);
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx) {
                const floats found = stored(policy(around.template pair<lanes>(5, 4, dx, dy)));
                for (int lane = 0; lane < lanes::size; ++lane) {
                    const archetype exact = policy(around.template pair<archetype>(5 + lane, 4, dx, dy));
                    CHECK(std::abs(found[lane] - value_of(exact)) <= bound_of(exact));
                }
            }
    }
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("lanes give every distance within the bound of float arithmetic", "", distances) {
    check_lanes(std::get<TestType>(distance_examples));
}

TEMPLATE_LIST_TEST_CASE("lanes give every weight within the bound of float arithmetic", "", weights) {
    check_lanes(std::get<TestType>(weight_examples));
}

TEST_CASE("lanes: exp is right to a relative 2e-7 from -80 to 0, and exactly 1 at 0") {
    constexpr int n = 1 << 20;
    double worst = 0, at = 0;
    for_arguments(
        n, [](int i) { return -80.0f * static_cast<float>(i) / n; }, [](lanes x) { return lanes::exp(x); },
        [&](float x, float found) {
            const double exact = std::exp(static_cast<double>(x)), error = std::abs(found - exact) / exact;
            if (error > worst) worst = error, at = x;
        });
    INFO("worst at " << at);
    CHECK(worst <= 2e-7);
    CHECK(stored(lanes::exp(lanes(0.0f))).front() == 1);
    CHECK(stored(lanes::exp(lanes(-0.0f))).back() == 1);
}

TEST_CASE("lanes: exp stays at or below 1 for whatever is not above 0") {
    // Exponents near 0: where a polynomial would overshoot.
    for_arguments(
        1 << 14, [](int i) { return -std::exp2(-static_cast<float>(i) / 128); }, [](lanes x) { return lanes::exp(x); },
        [](float, float found) {
            if (!(found <= 1 && found > 0)) FAIL(found);
        });
}

TEST_CASE("lanes: reciprocal is right to two units in the last place over the range of a positive number") {
    double worst = 0, at = 0;
    for_arguments(
        1 << 20,
        [](int i) {  // every binary exponent from 2^-120 to 2^120, every part of the mantissa
            return std::bit_cast<float>((7u << 23) + static_cast<std::uint32_t>(i) * 1913u);
        },
        [](lanes x) { return lanes::reciprocal(x); },
        [&](float x, float found) {
            const double exact = 1 / static_cast<double>(x);
            const double ulp = std::exp2(std::floor(std::log2(exact)) - 23);
            if (const double error = std::abs(found - exact) / ulp; !(error <= worst)) worst = error, at = x;
        });
    INFO("worst at " << at);
    CHECK(worst <= 2);
}

TEST_CASE("lanes: min, max and select choose as scalars do, with a NaN too") {
    const float numbers[] = {-1, 0, 2.5f, INFINITY, NAN};
    for (const float a : numbers)
        for (const float b : numbers) {
            const auto same = [](float wanted, lanes found) {
                const float value = stored(found).back();
                CHECK((value == wanted || (std::isnan(value) && std::isnan(wanted))));
            };
            same(math::min(a, b), math::min(lanes(a), lanes(b)));
            same(math::max(a, b), math::max(lanes(a), lanes(b)));
            same(math::select(a < b, 1.0f, 2.0f), math::select(lanes(a) < lanes(b), lanes(1.0f), lanes(2.0f)));
        }
}

TEST_CASE("lanes: every lane works on its own number") {
    floats x, y;
    for (int i = 0; i < lanes::size; ++i) x[i] = scattered(i), y[i] = scattered(100 + i);
    const lanes a = lanes::load(x.data()), b = lanes::load(y.data());
    const floats sum = stored(a + b), difference = stored(a - b), product = stored(a * b), quotient = stored(a / b),
                 negative = stored(-a), root = stored(lanes::sqrt(a)), fused = stored(lanes::fma(a, b, a)),
                 smaller = stored(lanes::select(a < b, a, b));
    for (int i = 0; i < lanes::size; ++i) {
        CHECK(sum[i] == x[i] + y[i]);
        CHECK(difference[i] == x[i] - y[i]);
        CHECK(product[i] == x[i] * y[i]);
        CHECK(quotient[i] == x[i] / y[i]);
        CHECK(negative[i] == -x[i]);
        CHECK(root[i] == std::sqrt(x[i]));
        CHECK(fused[i] == Approx(x[i] * y[i] + x[i]).epsilon(2e-7));
        CHECK(smaller[i] == std::min(x[i], y[i]));
    }
}

TEST_CASE("lanes solve as many systems as they are, each as a scalar would") {
    symmetric<lanes, 3> a;
    lanes b[3];
    for (int i = 0; i < a.count; ++i) {
        floats values;
        for (int lane = 0; lane < lanes::size; ++lane)
            values[lane] = (i == 0 || i == 2 || i == 5 ? 2.0f : 0.5f) + 0.01f * static_cast<float>(lane * i);
        a.lower[i] = lanes::load(values.data());
    }
    for (int i = 0; i < 3; ++i) b[i] = lanes(1.0f + static_cast<float>(i));
    cholesky<lanes, 3>(a, lanes(1e-4f)).solve(b);
    for (int lane = 0; lane < lanes::size; ++lane) {
        symmetric<float, 3> one;
        for (int i = 0; i < one.count; ++i) one.lower[i] = stored(a.lower[i])[lane];
        float x[3] = {1, 2, 3};
        cholesky<float, 3>(one, 1e-4f).solve(x);
        for (int i = 0; i < 3; ++i) CHECK(stored(b[i])[lane] == Approx(x[i]).epsilon(0).margin(2e-6));
    }
}
