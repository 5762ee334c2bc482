// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// SBF: tiles under a light that fades, filtered at the scale whose estimated error is the least.  Prints the error
/// before and after, what the filter itself thinks of it, and how often each scale was chosen.
#include <cstdio>
#include <random>
#include <winnow/executor/openmp.hpp>
#include <winnow/metric/mse.hpp>
#include <winnow/paper/sbf_2012.hpp>

using namespace winnow;

int main() {
    // A renderer would hand over its own buffers; here they are made up.
    const extent size{320, 200};
    image<> truth(size, 3), noisy(size, 3), noise(size, 3), texture(size, 3), exact(size, 3), result(size, 3);
    image<> error(size, 3), chosen(size, 1);
    std::mt19937 random(7);
    std::normal_distribution<float> deviate;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c) {
                texture.at(x, y, c) = (x / 40 + y / 40) % 2 == 0 ? 0.8f : 0.3f;
                // Light with shadows on the left that the albedo does not show.
                const bool lit = x > 160 || (x / 4 + y / 4) % 2 == 0;
                truth.at(x, y, c) = texture.at(x, y, c) * (lit ? 1.0f : 0.2f);
                const float sigma = 0.15f;
                noisy.at(x, y, c) = truth.at(x, y, c) + sigma * deviate(random);
                noise.at(x, y, c) = sigma * sigma;
            }

    paper::sbf_of<planes<albedo_t>> sbf;
    sbf.bank.scales = {0.5f, 1, 3};
    const frame in{color = noisy.view(), variance(color) = noise.view(), albedo = texture.view(),
                   variance(albedo) = exact.view()};
    workspace memory;
    sbf(in, output{result}.error(error.view()), executor::openmp{}, memory, chosen.view());

    double estimate = 0;
    int count[3] = {};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            estimate += error.at(x, y) / static_cast<double>(size.pixels());
            ++count[static_cast<int>(chosen.at(x, y))];
        }
    const double before = metric::mse(noisy.view(), truth.view()), after = metric::mse(result.view(), truth.view());
    std::printf("MSE: %.5f before, %.5f after, %.5f estimated; scales chosen: %d %d %d\n", before, after, estimate,
                count[0], count[1], count[2]);
    return after < before / 2 ? 0 : 1;
}
