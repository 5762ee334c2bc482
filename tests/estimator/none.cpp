// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/estimator/none.hpp>

using namespace winnow;

static_assert(!estimator::none::reports && !estimator::none::needs_halves);

TEST_CASE("none knows of no error") { CHECK(estimator::none{}({.input = 1, .filtered = 2, .half_a = 3}) == 0); }
