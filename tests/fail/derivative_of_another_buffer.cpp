// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: the estimator wants the derivative with respect to another buffer than the frame filters
// A derivative with respect to a buffer that the frame does not filter.
#include <winnow/winnow.hpp>
using namespace winnow;

void denoise(const image<>& rgb, const image<>& texture, const image<>& noise, image<>& result) {
    const frame in{color = rgb.view(), albedo = texture.view(), variance(albedo) = noise.view()};
    const filter f{gaussian(l2(albedo), 0.1f), window::square{}, estimator::sure<albedo_t>{}};
#ifdef WINNOW_WRONG
    f(in, result);
#else
    f(filtering(albedo, in), result);
#endif
}
