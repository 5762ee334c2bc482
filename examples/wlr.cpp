// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Weighted local regression: a noisy picture whose shading follows its features, and what the filter itself says about
/// the error that it leaves.
#include <cstdio>
#include <random>
#include <winnow/executor/openmp.hpp>
#include <winnow/metric/mse.hpp>
#include <winnow/paper/wlr_2014.hpp>

using namespace winnow;

int main() {
    // A renderer would hand over its own buffers; here they are made up.
    const extent size{160, 100};
    image<> truth(size, 3), noisy(size, 3), noise(size, 3), texture(size, 3), normals(size, 3), result(size, 3),
        error(size, 3);
    std::mt19937 random(7);
    std::normal_distribution<float> deviate(0.0f, 0.2f);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float u = static_cast<float>(x) / 20 - 4, v = static_cast<float>(y) / 20 - 2.5f;
            const float ball = std::max(0.0f, 4 - u * u - v * v);  // a ball in front of a wall
            const float n[] = {ball > 0 ? u / 2 : 0, ball > 0 ? v / 2 : 0, ball > 0 ? std::sqrt(ball) / 2 : 1};
            for (int c = 0; c < 3; ++c) {
                normals.at(x, y, c) = n[c];
                texture.at(x, y, c) = (x / 8 + y / 8) % 2 ? 0.7f : 0.3f + 0.1f * static_cast<float>(c);
                truth.at(x, y, c) = texture.at(x, y, c) * std::max(0.1f, 0.6f * n[2] - 0.5f * n[0]);
                noisy.at(x, y, c) = truth.at(x, y, c) + deviate(random);
                noise.at(x, y, c) = 0.04f;  // the variance of the mean of a pixel's samples
            }
        }

    // The list of features is the filter's type; where they lie is the picture's affair.
    const paper::wlr_of<planes<albedo_t, normal_t>> wlr{{.radius = 7}};
    const frame in{color = noisy.view(), variance(color) = noise.view(), albedo = texture.view(),
                   normal = normals.view()};
    wlr(in, output(result).error(error.view()), executor::openmp{});

    double estimated = 0;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) estimated += error.at(x, y, c);
    estimated /= 3.0 * static_cast<double>(size.pixels());
    const double before = metric::mse(noisy.view(), truth.view()), after = metric::mse(result.view(), truth.view());
    std::printf("squared error: %.4f before, %.4f after, %.4f by the filter's own estimate\n", before, after,
                estimated);
    return after < before / 4 && estimated > after / 3 && estimated < after * 3 ? 0 : 1;
}
