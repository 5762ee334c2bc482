// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: visibility_t.*evaluated to .?false
// A filter reads what no effect of the scene can give; the error names the guide.
#include <winnow/simulate/film_for.hpp>
namespace {
template <class Effects>
struct scene {
    using effects = Effects;
};
struct shadow_filter {
    using reads = winnow::planes<winnow::color_t, winnow::visibility_t>;
};
}  // namespace
using namespace winnow::simulate;
#ifdef WINNOW_WRONG
using film = film_for<scene<effects<effect::texture>>, shadow_filter>;
#else
using film = film_for<scene<effects<effect::texture, effect::area_light>>, shadow_filter>;
#endif
