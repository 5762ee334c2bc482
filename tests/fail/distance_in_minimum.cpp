// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (cross_feature<winnow::albedo_t>.*weight_policy|weight_policy.*cross_feature<winnow::albedo_t>)
// One of two exponentials is forgotten.
#include <winnow/winnow.hpp>
using namespace winnow;
#ifdef WINNOW_WRONG
const auto f = filter{min(exponential(cross(color)), cross(albedo))};
#else
const auto f = filter{min(exponential(cross(color)), exponential(cross(albedo)))};
#endif
