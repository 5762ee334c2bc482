// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (spatial.*estimator_policy|estimator_policy.*spatial)
#include <winnow/winnow.hpp>
using namespace winnow;
const auto f = filter{gaussian(spatial, 3)};
#ifdef WINNOW_WRONG
const auto g = f.with(spatial);
#else
const auto g = f.with(estimator::residual_variance{});
#endif
