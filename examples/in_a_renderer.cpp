// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Inside a renderer: its own pixel struct, read and written in place without a copy, its own threads, and memory that
/// is allocated once.
#include <cstdio>
#include <thread>
#include <vector>
#include <winnow/executor/pool.hpp>
#include <winnow/executor/simd.hpp>
#include <winnow/winnow.hpp>

using namespace winnow;

namespace renderer {

/// The film as the renderer happens to keep it.
struct pixel {
    float radiance[3];
    half normal[3];
    short flags;
    float albedo[3];
    float denoised[3];
};

/// The renderer's thread pool; winnow asks only for size() and run(count, task).
struct thread_pool {
    int size() const { return 3; }

    template <class Task>
    void run(int count, const Task& task) {
        std::vector<std::jthread> threads;
        for (int i = 0; i < count; ++i) threads.emplace_back([&task, i] { task(i); });
    }
};

}  // namespace renderer

int main() {
    const extent size{160, 90};
    std::vector<renderer::pixel> film(static_cast<std::size_t>(size.pixels()));
    for (std::size_t i = 0; i < film.size(); ++i)
        film[i] = {.radiance = {i % 2 ? 1.2f : 0.8f, 1, 1},
                   .normal = {half(0), half(0), half(1)},
                   .flags = 0,
                   .albedo = {0.5f, 0.5f, 0.5f},
                   .denoised = {}};

    // Views: where the first value lies, how many channels, and how far it is to the next pixel.
    const auto view = [&](auto* first) { return interleaved(first, size, 3, sizeof(renderer::pixel)); };
    const frame in{color = view(film[0].radiance), normal = view(film[0].normal), albedo = view(film[0].albedo)};

    const filter denoise{gaussian(spatial, 3.0f) * gaussian(l2(albedo), 0.1f) * gaussian(l2(normal), 0.2f),
                         window::square{.radius = 7}};
    renderer::thread_pool threads;
    const executor::pool executor{threads, executor::simd{}};

    std::printf("scratch memory: %zu bytes\n", plan(denoise, size, executor).scratch_bytes);
    workspace memory;
    for (int frame_number = 0; frame_number < 3; ++frame_number)  // nothing is allocated after the first
        denoise(in, view(film[0].denoised), executor, memory);

    std::printf("red: 0.8 and 1.2 before, %.3f after\n", film[film.size() / 2].denoised[0]);
    return film[film.size() / 2].denoised[0] > 0.95f && film[film.size() / 2].denoised[0] < 1.05f ? 0 : 1;
}
