// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Inside a renderer: its sample loop fills a film, its own threads filter it, its own pixels receive the result, and
/// memory is allocated once.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>
#include <winnow/executor/pool.hpp>
#include <winnow/executor/simd.hpp>
#include <winnow/frame/film.hpp>
#include <winnow/winnow.hpp>

using namespace winnow;

namespace renderer {

/// Pixels as the renderer happens to keep them.
struct pixel {
    half denoised[3];
    short flags;
};

/// The renderer's thread pool; winnow asks only for size() and run(count, task).
struct thread_pool {
    int size() const { return 2; }

    template <class Task>
    void run(int count, const Task& task) {
        std::vector<std::jthread> threads;
        for (int i = 0; i < count; ++i) threads.emplace_back([&task, i] { task(i); });
    }
};

constexpr extent size{160, 90};
constexpr int samples_per_pixel = 16;

double reflectance(int x, int y) { return (x / 20 + y / 15) % 2 ? 0.8 : 0.2; }
/// What infinitely many samples would show: a checkered floor, brighter to the right.
double radiance(int x, int y) { return reflectance(x, y) * (1 + 2.0 * x / size.width); }

/// "Traces" a path: noise from a hash of its number, the same in every run.
double noise(int x, int y, int i) {
    std::uint64_t z = static_cast<std::uint64_t>((i * size.height + y) * size.width + x) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    return static_cast<double>((z ^ (z >> 27)) >> 11) * 0x1p-52;  // in [0, 2)
}

}  // namespace renderer

int main() {
    using namespace renderer;
    const filter denoise{gaussian(spatial, 3.0f) * gaussian(l2(albedo), 0.1f) * gaussian(l2(normal), 0.2f),
                         window::square{.radius = 7}};
    thread_pool threads;

    // The filter says what the film must keep.  Threads take rows in turn: no pixel belongs to two of them.
    film_for<decltype(denoise)> film(size);
    threads.run(2, [&](int thread) {
        for (int y = thread; y < size.height; y += 2)
            for (int x = 0; x < size.width; ++x)
                for (int i = 0; i < samples_per_pixel; ++i) {
                    const double light = radiance(x, y) * noise(x, y, i), up[3] = {0, 1, 0};
                    film.add(x, y, i, color = light, albedo = reflectance(x, y), normal = up, depth = 100 - y);
                }
    });
    const auto images = film.develop();

    // A view says where the first value lies, how many channels, and how far it is to the next pixel.
    std::vector<pixel> pixels(static_cast<std::size_t>(size.pixels()));
    const auto result = interleaved(pixels[0].denoised, size, 3, sizeof(pixel));
    const executor::pool executor{threads, executor::simd{}};
    std::printf("film: %zu bytes, scratch: %zu bytes\n", film.bytes(size), plan(denoise, size, executor).scratch_bytes);
    workspace memory;
    for (int frame_number = 0; frame_number < 3; ++frame_number)  // nothing is allocated after the first
        denoise(images.frame(), result, executor, memory);

    double before = 0, after = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            before += std::pow(images[color].at(x, y) - radiance(x, y), 2);
            after += std::pow(result.at(x, y) - radiance(x, y), 2);
        }
    const double all = static_cast<double>(size.pixels());
    std::printf("root of the mean squared error: %.4f before, %.4f after\n", std::sqrt(before / all),
                std::sqrt(after / all));
    return after < before / 25 ? 0 : 1;
}
