// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (albedo_t.*distance_policy|distance_policy.*albedo_t)
#include <winnow/winnow.hpp>
using namespace winnow;
#ifdef WINNOW_WRONG
const auto weight = gaussian(albedo, 0.1f);
#else
const auto weight = gaussian(l2(albedo), 0.1f);
#endif
