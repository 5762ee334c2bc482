// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// A first filter: a noisy picture of two materials, smoothed where the albedo agrees.  Writes first_filter.png if this
/// build has stb_image_write, and prints how much noise is left.
#include <cstdio>
#include <random>
#include <winnow/executor/openmp.hpp>
#include <winnow/metric/relative_mse.hpp>
#include <winnow/winnow.hpp>
#if defined(WINNOW_WITH_PNG)
#include <winnow/io/png.hpp>
#endif

using namespace winnow;

int main() {
    // A renderer would hand over its own buffers; here they are made up.
    const extent size{320, 200};
    image<> truth(size, 3), noisy(size, 3), texture(size, 3), result(size, 3);
    std::mt19937 random(7);
    std::exponential_distribution<float> light(1.0f);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const bool tile = (x / 40 + y / 40) % 2 == 0;
            for (int c = 0; c < 3; ++c) {
                texture.at(x, y, c) = tile ? 0.2f + 0.3f * static_cast<float>(c) : 0.6f;
                truth.at(x, y, c) = texture.at(x, y, c) * (0.4f + 0.002f * static_cast<float>(x));
                noisy.at(x, y, c) = truth.at(x, y, c) * light(random);
            }
        }

    // The formula: a Gaussian of the distance in pixels times a Gaussian of the difference in albedo.
    const filter joint_bilateral{gaussian(spatial, 4.0f) * gaussian(l2(albedo), 0.1f), window::square{.radius = 10}};

    const frame in{color = noisy.view(), albedo = texture.view()};
    joint_bilateral(in, result, executor::openmp{});

    const double before = metric::relative_mse(noisy.view(), truth.view());
    const double after = metric::relative_mse(result.view(), truth.view());
    std::printf("relative MSE: %.4f before, %.4f after\n", before, after);
#if defined(WINNOW_WITH_PNG)
    io::write_png("first_filter.png", result.view());
#endif
    return after < before / 20 ? 0 : 1;
}
