// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// That candidates give the bits of their filters one by one is tested with the executors.
#include <array>
#include <winnow/filter/candidates.hpp>
#include "support/catch.hpp"
#include "support/filters.hpp"
#include "winnow/distance/squared_difference.hpp"
#include "winnow/estimator/residual_variance.hpp"
#include "winnow/weight/gaussian.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {
constexpr extent size{15, 9};
constexpr auto narrow = filter{gaussian(l2(albedo), 0.05f), window::square{.radius = 2}};
constexpr auto wide = filter{gaussian(l2(normal), 0.5f), window::square{.radius = 2}};
}  // namespace

static_assert(candidates<window::square, estimator::none, decltype(narrow.weight), decltype(wide.weight)>::count == 2);

TEST_CASE("candidates must agree in window and border") {
    CHECK_NOTHROW(candidates{narrow, wide});
    CHECK_THROWS_AS((candidates{narrow, wide.with(window::square{.radius = 3})}), invalid_input);
    CHECK_THROWS_AS((candidates{narrow, wide.with(border::mirror)}), invalid_input);
}

TEST_CASE("each candidate writes its own outputs, and only those asked for") {
    const buffers in = make_buffers(size);
    image<> first(size, 3), second(size, 3), half(size, 3), expected(size, 3), expected_half(size, 3);
    candidates{narrow, wide}(in.layers(), {output{first}, output{}.halves(half.view(), {})});
    narrow(in.layers(), expected);
    CHECK(other_bits(first, expected) == "");
    wide(in.layers(), output{expected}.halves(expected_half.view(), {}));
    CHECK(other_bits(half, expected_half) == "");
    CHECK(largest_magnitude(second) == 0);
}

TEST_CASE("candidates report their errors one by one") {
    const buffers in = make_buffers(size);
    const auto a = narrow.with(estimator::residual_variance{});
    const auto b = wide.with(estimator::residual_variance{});
    image<> error_a(size, 3), error_b(size, 3), expected(size, 3);
    candidates{a, b}(in.layers(), {output{}.error(error_a.view()), output{}.error(error_b.view())});
    a(in.layers(), output{}.error(expected.view()));
    CHECK(other_bits(error_a, expected) == "");
    b(in.layers(), output{}.error(expected.view()));
    CHECK(other_bits(error_b, expected) == "");
}

TEST_CASE("the further layers of all candidates are the same, or they are refused") {
    const buffers in = make_buffers(size);
    image<> first(size, 3), second(size, 3), third(size, 3), fourth(size, 3);
    const auto run = [&](const output& a, const output& b) { candidates{narrow, wide}(in.layers(), {a, b}); };
    const output with_albedo = output{first}.layer(in.albedo.view(), second.view());
    CHECK_THROWS_WITH(run(with_albedo, output{third}), Catch::Contains("further layers"));
    CHECK_THROWS_WITH(run(with_albedo, output{third}.layer(in.normal.view(), fourth.view())),
                      Catch::Contains("further layers"));
    CHECK_NOTHROW(run(with_albedo, output{third}.layer(in.albedo.view(), fourth.view())));
}
