// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/weight/gaussian.hpp>
#include <winnow/weight/shared.hpp>

using namespace winnow;
using namespace winnow::test;

// That it does not tell its exponent is what keeps it apart from the rest of a product.
static_assert(!exponential_weight<decltype(shared(gaussian(l2(depth), 1)))>);

TEST_CASE("a shared weight is the weight") {
    neighbourhood<planes<depth_t>> around({2, 1});
    around.at(depth, 0, 0) = 0.5f;
    const auto pq = around.pair(0, 0, 1, 0);
    CHECK(shared(gaussian(l2(depth), 0.3f))(pq) == gaussian(l2(depth), 0.3f)(pq));
}
