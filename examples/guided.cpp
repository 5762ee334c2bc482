// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// The guided filter on a picture that no average over neighbours can save: every pixel has its own albedo.  Where the
/// light is smooth, the colour is a linear function of the albedo all the same.
#include <cstdio>
#include <random>
#include <winnow/executor/openmp.hpp>
#include <winnow/metric/relative_mse.hpp>
#include <winnow/paper/guided_2010.hpp>
#include <winnow/paper/joint_bilateral.hpp>

using namespace winnow;

int main() {
    // A renderer would hand over its own buffers; here they are made up.
    const extent size{320, 200};
    image<> truth(size, 3), noisy(size, 3), texture(size, 3), result(size, 3);
    std::mt19937 random(7);
    std::exponential_distribution<float> light(1.0f);
    std::uniform_real_distribution<float> grain(0.1f, 0.9f);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c) {
                texture.at(x, y, c) = grain(random);
                truth.at(x, y, c) = texture.at(x, y, c) * (0.4f + 0.002f * static_cast<float>(x));
                noisy.at(x, y, c) = truth.at(x, y, c) * light(random);
            }

    // In windows of 17x17 pixels, with a ridge far below the variance of the albedo.
    const paper::guided_of<planes<albedo_t>> guided{{.radius = 8, .epsilon = 1e-3f}};
    const filter bilateral{gaussian(spatial, 4.0f) * gaussian(l2(albedo), 0.1f), window::square{.radius = 10}};

    const frame in{color = noisy.view(), albedo = texture.view()};
    const auto error = [&](const auto& filter) {
        filter(in, result, executor::openmp{});
        return metric::relative_mse(result.view(), truth.view());
    };
    const double before = metric::relative_mse(noisy.view(), truth.view());
    const double by_bilateral = error(bilateral), by_guided = error(guided);
    std::printf("relative MSE: %.4f before, %.4f by a joint bilateral filter, %.4f by the guided filter\n", before,
                by_bilateral, by_guided);
    return by_guided < before / 50 && by_guided < by_bilateral / 2 ? 0 : 1;
}
