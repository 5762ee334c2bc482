// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: draws.*lens.*evaluated to .?false
// No effect of the scene draws a point on a lens: the number does not exist.
#include <winnow/simulate/effect.hpp>
using namespace winnow::simulate;
namespace {
template <class Effects>
struct numbers {
    template <class D>
    requires(Effects::template draws<D>) double operator()(D) const { return 0; }
};
}  // namespace
double draw_one() {
#ifdef WINNOW_WRONG
    return numbers<effects<effect::translation>>{}(draw::lens{});
#else
    return numbers<effects<effect::depth_of_field>>{}(draw::lens{});
#endif
}
