// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (from|convert).*const .*image<>.*winnow::output
#include <winnow/winnow.hpp>
using namespace winnow;
void run(const named_layers& in, const image<>& kept, image<>& mine) {
    const auto f = filter{gaussian(spatial, 3)};
#ifdef WINNOW_WRONG
    f(in, kept);
    (void)mine;
#else
    f(in, mine);
    (void)kept;
#endif
}
