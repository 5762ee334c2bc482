// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (spatial.*window_policy|window_policy.*spatial)
#include <winnow/winnow.hpp>
using namespace winnow;
#ifdef WINNOW_WRONG
const auto f = filter{gaussian(l2(albedo), 0.1f), gaussian(spatial, 3)};
#else
const auto f = filter{gaussian(l2(albedo), 0.1f) * gaussian(spatial, 3)};
#endif
