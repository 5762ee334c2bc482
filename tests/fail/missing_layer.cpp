// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: has.*normal_t.*evaluated to .?false
// The frame lacks a buffer that the filter reads; the error names it.
#include <winnow/winnow.hpp>
using namespace winnow;
void run(const image<>& rgb, const image<>& texture, const image<>& shading, image<>& out) {
    const auto f = filter{gaussian(l2(albedo), 0.1f) * gaussian(l2(normal), 0.2f)};
#ifdef WINNOW_WRONG
    f(frame{color = rgb.view(), albedo = texture.view()}, out);
    (void)shading;
#else
    f(frame{color = rgb.view(), albedo = texture.view(), normal = shading.view()}, out);
#endif
}
