// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: contains<.*normal_t.*evaluated to .?false
// A film is not given a value that the filter reads; the error names it.
#include <winnow/frame/film.hpp>
#include <winnow/paper/joint_bilateral.hpp>
using namespace winnow;
void run(film_for<paper::joint_bilateral>& f, const float* radiance, const float* texture, const float* n, float t) {
#ifdef WINNOW_WRONG
    f.add(0, 0, 0, color = radiance, albedo = texture, depth = t);
    (void)n;
#else
    f.add(0, 0, 0, color = radiance, albedo = texture, normal = n, depth = t);
#endif
}
