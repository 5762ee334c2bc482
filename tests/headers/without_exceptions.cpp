// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <csignal>
#include <cstdlib>
#include <every_header_but_io.hpp>

using namespace winnow;

/// Filters 2x2 pixels with a depth; with an argument the depth has another size, which ends the program.
int main(int count, char**) {
    std::signal(SIGABRT, [](int) { std::_Exit(1); });
    const image<> rgb({2, 2}, 3), feature({count > 1 ? 3 : 2, 2}, 1);
    image<> out({2, 2}, 3);
    const auto f = filter{gaussian(l2(depth), 0.1f), window::square{.radius = 1}};
    f(frame{color = rgb.view(), depth = feature.view()}, out);
    return 0;
}
