// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: has.*half_b<winnow::color_t>.*evaluated to .?false
// A dual buffer needs both halves and the variance of each.
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/winnow.hpp>
using namespace winnow;
void run(const image<>& a, const image<>& b, const image<>& noise, image<>& out) {
    const auto f = paper::make_nlm_2012();
#ifdef WINNOW_WRONG
    f(frame{first_half(color) = a.view(), variance(first_half(color)) = noise.view()}, out);
    (void)b;
#else
    f(frame{first_half(color) = a.view(), variance(first_half(color)) = noise.view(), second_half(color) = b.view(),
            variance(second_half(color)) = noise.view()},
      out);
#endif
}
