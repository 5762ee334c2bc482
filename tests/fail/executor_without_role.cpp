// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (mine.*executor_policy|executor_policy.*mine)
#include <winnow/winnow.hpp>
using namespace winnow;
struct mine : executor::serial<> {
#ifdef WINNOW_WRONG
    using role = void;
#endif
};
void run(const named_layers& in, const output& out) {
    const auto f = filter{gaussian(spatial, 3)};
#ifdef WINNOW_WRONG
    f(in, out, mine{});
#else
    f(in, out, mine{});
#endif
}
