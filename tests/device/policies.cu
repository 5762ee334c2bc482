// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Every kind of policy inside a CUDA kernel: what the host compiles, the device compiles, without special flags.
#include <winnow/winnow.hpp>

namespace {

using namespace winnow;

/// The weight of each of n pairs of neighbouring pixels.
template <class Weight>
__global__ void weights(Weight weight, const float* planes, pitch step, int n, float* out) {
    const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < n) out[i] = weight(pixel_pair<float, typename Weight::reads>(planes + i, planes + i + 1, step, 1, 0));
}

template <class Weight>
void launch(const Weight& weight) {
    weights<<<1, 32>>>(weight, nullptr, pitch{64, 64}, 0, nullptr);
}

}  // namespace

void every_policy() {
    launch(min(exponential(patch(noise_normalized(color, {.k = 0.45f}), {.radius = 3})),
               exponential(max(cross(albedo), cross(normal), cross(depth)))));
    launch(gaussian(spatial, 3.0f) * gaussian(l2(albedo), 0.1f) * cutoff(l2(normal) + l2(depth), 0.2f));
    launch(min(cutoff(spatial, 4.0f), gaussian(l2(color), 0.1f)));
}
