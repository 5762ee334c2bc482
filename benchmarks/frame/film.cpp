// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Time to add one sample of colour, albedo, normal and depth to a film, beside a loop that only sums them up.
#include <benchmark/benchmark.h>
#include <winnow/frame/film.hpp>

#include <cmath>
#include <random>

#include "support/timed.hpp"

namespace {

using namespace winnow;

using means = planes<color_t, albedo_t, normal_t, depth_t>;
using variances =
    joined<means, planes<variance_of<color_t>, variance_of<albedo_t>, variance_of<normal_t>, variance_of<depth_t>>>;
using everything = joined<variances, planes<half_a<color_t>, half_b<color_t>, half_a<albedo_t>, half_b<albedo_t>,
                                            half_a<normal_t>, half_b<normal_t>, half_a<depth_t>, half_b<depth_t>>>;

constexpr extent size{256, 256};
constexpr int spp = 16;

/// What a renderer hands over, in the order in which it traces: tile by tile, all samples of a pixel in a row.
const std::vector<sample<means>>& traced() {
    static const std::vector<sample<means>> all = [] {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform;
        std::vector<sample<means>> made(static_cast<std::size_t>(size.pixels()) * spp);
        for (auto& s : made)
            for (float& v : s.values) v = uniform(random);
        return made;
    }();
    return all;
}

/// Calls add(x, y, i, sample); either pixel by pixel, or one sample of every pixel after the other (progressive).
template <class Add>
void for_each_sample(bool progressive, const Add& add) {
    const sample<means>* next = traced().data();
    for (int pass = 0; pass < (progressive ? spp : 1); ++pass)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                for (int i = 0; i < (progressive ? 1 : spp); ++i) add(x, y, pass + i, *next++);
}

void report(benchmark::State& state, double seconds, std::size_t pixel_bytes, double error) {
    state.counters["ns/sample"] = seconds / static_cast<double>(traced().size()) * 1e9;
    state.counters["bytes/pixel"] = static_cast<double>(pixel_bytes);
    if (!(error < 1e-6)) state.SkipWithError("the mean is wrong");
}

/// The largest difference of a mean from that of a sum in double, over some pixels.
template <class Mean>
double largest_error(bool progressive, const Mean& mean) {
    std::vector<double> sums(static_cast<std::size_t>(size.pixels()) * means::count);
    for_each_sample(progressive, [&](int x, int y, int, const sample<means>& s) {
        for (int c = 0; c < means::count; ++c) sums[(y * size.width + x) * means::count + c] += s.values[c];
    });
    double worst = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < means::count; ++c)
                worst = std::max(worst, std::abs(mean(x, y, c) - sums[(y * size.width + x) * means::count + c] / spp));
    return worst;
}

void sum_only(benchmark::State& state, bool progressive) {
    struct pixel {
        float sum[means::count] = {};
        int n = 0;
    };
    std::vector<pixel> pixels(size.pixels());
    const double seconds = benchmarks::seconds_each(state, [&] {
        pixels.assign(size.pixels(), {});
        for_each_sample(progressive, [&](int x, int y, int, const sample<means>& s) {
            pixel& p = pixels[y * size.width + x];
            for (int c = 0; c < means::count; ++c) p.sum[c] += s.values[c];
            ++p.n;
        });
        benchmark::DoNotOptimize(pixels.data());
        benchmark::ClobberMemory();
    });
    report(state, seconds, sizeof(pixel), largest_error(progressive, [&](int x, int y, int c) {
               const pixel& p = pixels[y * size.width + x];
               return p.sum[c] / static_cast<float>(p.n);
           }));
}

template <class Planes>
void of_film(benchmark::State& state, bool progressive) {
    film<Planes> kept(size);
    const film<Planes> empty(size);
    const double seconds = benchmarks::seconds_each(state, [&] {
        kept = empty;
        for_each_sample(progressive, [&](int x, int y, int i, const sample<means>& s) { kept.add(x, y, i, s); });
        benchmark::ClobberMemory();
    });
    const auto images = kept.develop();
    report(state, seconds, kept.pixel_bytes, largest_error(progressive, [&](int x, int y, int c) {
               if (c < 3) return images[color].at(x, y, c);
               if (c < 6) return images[albedo].at(x, y, c - 3);
               return c < 9 ? images[normal].at(x, y, c - 6) : images[depth].at(x, y);
           }));
}

template <class Planes>
void develop(benchmark::State& state) {
    film<Planes> kept({1024, 1024});
    for (int y = 0; y < 1024; ++y)
        for (int x = 0; x < 1024; ++x)
            for (int i = 0; i < 4; ++i) kept.add(x, y, i, traced()[(y * 1024 + x + i) % traced().size()]);
    const double seconds = benchmarks::seconds_each(state, [&] {
        auto images = kept.develop();
        benchmark::DoNotOptimize(images);
    });
    state.counters["ns/pixel"] = seconds / (1024 * 1024) * 1e9;
    state.counters["bytes/pixel"] = static_cast<double>(kept.pixel_bytes);
}

}  // namespace

int main(int argc, char** argv) {
    for (const bool progressive : {false, true}) {
        const std::string order = progressive ? ", one sample of every pixel at a time" : ", pixel by pixel";
        const auto add = [&](const char* name, void (*run)(benchmark::State&, bool)) {
            benchmark::RegisterBenchmark((name + order).c_str(), [=](benchmark::State& state) {
                run(state, progressive);
            })->Unit(benchmark::kMillisecond);
        };
        add("sum only", sum_only);
        add("film, means", of_film<means>);
        add("film, means and variances", of_film<variances>);
        add("film, means, variances and halves", of_film<everything>);
    }
    benchmark::RegisterBenchmark("develop, means", develop<means>)->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("develop, everything", develop<everything>)->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
