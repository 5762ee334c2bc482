// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cstdio>
#include <vector>
#include <winnow/winnow.hpp>

int main() {
    using namespace winnow;
    const std::vector<float> rgb(5 * 4 * 3, 0.5f);
    image<> out({5, 4}, 3);
    const auto f = filter{gaussian(spatial, 2) * gaussian(l2(color), 0.1f), window::disk{.radius = 2}};
    f(frame{color = interleaved(rgb.data(), {5, 4}, 3)}, out);
    if (out.at(4, 3, 2) != 0.5f) return 1;
    std::puts("filtered");
}
