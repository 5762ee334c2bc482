// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (squared_difference<.*weight_policy|weight_policy.*squared_difference<)
#include <winnow/winnow.hpp>
using namespace winnow;
#ifdef WINNOW_WRONG
const auto f = filter{l2(albedo), window::square{.radius = 3}};
#else
const auto f = filter{gaussian(l2(albedo), 0.1f), window::square{.radius = 3}};
#endif
