// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Edge-avoiding A-Trous: two walls in noisy light, five passes of 25 taps.  Prints the error before and after.
#include <cstdio>
#include <random>
#include <winnow/executor/openmp.hpp>
#include <winnow/metric/relative_mse.hpp>
#include <winnow/paper/a_trous_2010.hpp>

using namespace winnow;

int main() {
    // A renderer would hand over its own buffers; here they are made up.
    const extent size{320, 200};
    image<> truth(size, 3), noisy(size, 3), normals(size, 3), positions(size, 3), result(size, 3);
    std::mt19937 random(7);
    std::exponential_distribution<float> light(1.0f);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const bool left = x < 140;
            normals.at(x, y, left ? 0 : 2) = 1;
            for (int c = 0; c < 3; ++c) {
                positions.at(x, y, c) = 0.01f * static_cast<float>(c == 0 ? x : c == 1 ? y : 0);
                truth.at(x, y, c) = left ? 0.9f : 0.3f + 0.001f * static_cast<float>(y);
                noisy.at(x, y, c) = truth.at(x, y, c) * light(random);
            }
        }

    const paper::a_trous filter{{.sigma_color = 8, .sigma_normal = 0.3f, .sigma_position = 0.5f}};
    filter(frame{color = noisy.view(), normal = normals.view(), position = positions.view()}, result,
           executor::openmp{});

    const double before = metric::relative_mse(noisy.view(), truth.view());
    const double after = metric::relative_mse(result.view(), truth.view());
    std::printf("relative MSE: %.4f before, %.4f after\n", before, after);
    return after < before / 20 ? 0 : 1;
}
