// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// The guided filter by radius, halves and threads, beside its plain form: whole images, one after another, through box
/// means by running sums in double.
#include <benchmark/benchmark.h>
#include <array>
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/guided_2010.hpp>

#include "support/check.hpp"
#include "support/timed.hpp"

namespace {

using namespace winnow;
using benchmarks::scene;

scene& large() {
    static scene s({1024, 1024});
    return s;
}
scene& small() {
    static scene s({128, 128});
    return s;
}

void finish(benchmark::State& state, double seconds, const paper::guided& filter, const scene& s) {
    state.counters["ns/pixel"] = seconds / static_cast<double>(s.color.size().pixels()) * 1e9;
    const double error = benchmarks::largest_error(filter, halo(filter), s, s.result);
    state.counters["max error"] = error;
    if (!(error < 2e-5)) state.SkipWithError("the result differs from the definition");
}

template <class Executor>
void run(benchmark::State& state, int radius, const Executor& executor, scene& s, bool halves) {
    const paper::guided filter{{.radius = radius}};
    const auto in = s.frame();
    output out(s.result);
    if (halves) out.halves(s.result_a.view(), s.result_b.view());
    workspace memory;
    filter(in, out, executor, memory);
    const double seconds = benchmarks::seconds_each(state, [&] { filter(in, out, executor, memory); });
    finish(state, seconds, filter, s);
}

using plane = std::vector<double>;

/// The mean over each window, clipped: running sums along x, then along y.
plane box_mean(const plane& from, extent size, int radius) {
    plane to(from.size()), sums(from.size());
    const auto along = [radius](int count, const auto& in, const auto& out) {
        double sum = 0;
        for (int i = -radius; i < count; ++i) {
            if (i + radius < count) sum += in(i + radius);
            if (i - radius - 1 >= 0) sum -= in(i - radius - 1);
            if (i >= 0) out(i) = sum / (std::min(i + radius, count - 1) - std::max(i - radius, 0) + 1);
        }
    };
    const auto at = [&](auto& p, int x, int y) -> auto& { return p[static_cast<std::size_t>(y * size.width + x)]; };
    for (int y = 0; y < size.height; ++y)
        along(
            size.width, [&](int x) { return at(from, x, y); }, [&](int x) -> double& { return at(sums, x, y); });
    for (int x = 0; x < size.width; ++x)
        along(
            size.height, [&](int y) { return at(sums, x, y); }, [&](int y) -> double& { return at(to, x, y); });
    return to;
}

/// The guided filter as its authors write it down.
void plain(const paper::guided& filter, const scene& s, const target& out) {
    constexpr int guides = 4;
    const extent size = s.color.size();
    const auto count = static_cast<std::size_t>(size.pixels());
    const auto read = [&](const image<float>& from, int c) {
        const float* const first = &from.at(0, 0, c);
        return plane(first, first + count);
    };
    const auto box = [&](const plane& p) { return box_mean(p, size, filter.numbers.radius); };
    const auto map = [&](const auto& f) {
        plane p(count);
        for (std::size_t i = 0; i < count; ++i) p[i] = f(i);
        return p;
    };
    const auto covariance = [&](const plane& a, const plane& b, const plane& mean_a, const plane& mean_b) {
        const plane mean = box(map([&](std::size_t i) { return a[i] * b[i]; }));
        return map([&](std::size_t i) { return mean[i] - mean_a[i] * mean_b[i]; });
    };
    const std::array<plane, guides> guide{read(s.normal, 0), read(s.normal, 1), read(s.normal, 2), read(s.depth, 0)};
    std::array<plane, guides> means;
    for (int g = 0; g < guides; ++g) means[g] = box(guide[g]);
    std::array<plane, symmetric<double, guides>::count> matrix;
    for (int g = 0; g < guides; ++g)
        for (int h = 0; h <= g; ++h)
            matrix[symmetric<double, guides>::place(g, h)] = covariance(guide[g], guide[h], means[g], means[h]);
    for (int c = 0; c < 3; ++c) {
        const plane u = read(s.color, c);
        plane offset = box(u);
        std::array<plane, guides> slope;
        for (int g = 0; g < guides; ++g) slope[g] = covariance(guide[g], u, means[g], offset);
        for (std::size_t i = 0; i < count; ++i) {
            symmetric<double, guides> a;
            for (int k = 0; k < a.count; ++k) a.lower[k] = matrix[k][i];
            for (int g = 0; g < guides; ++g) a.at(g, g) += double{filter.numbers.epsilon};
            double b[guides];
            for (int g = 0; g < guides; ++g) b[g] = slope[g][i];
            cholesky<double, guides>(a, double{filter.numbers.epsilon}).solve(b);
            for (int g = 0; g < guides; ++g) slope[g][i] = b[g], offset[i] -= b[g] * means[g][i];
        }
        plane result = box(offset);
        for (int g = 0; g < guides; ++g) {
            const plane mean = box(slope[g]);
            for (std::size_t i = 0; i < count; ++i) result[i] += mean[i] * guide[g][i];
        }
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                out.channel(c).set(x, y, static_cast<float>(result[static_cast<std::size_t>(y * size.width + x)]));
    }
}

void run_plain(benchmark::State& state, int radius) {
    const paper::guided filter{{.radius = radius}};
    scene& s = large();
    const double seconds = benchmarks::seconds_each(state, [&] { plain(filter, s, s.result.view()); });
    finish(state, seconds, filter, s);
}

}  // namespace

int main(int argc, char** argv) {
    const auto add = [](const std::string& name, auto f) {
        benchmark::RegisterBenchmark(name.c_str(), f)->Unit(benchmark::kMillisecond)->UseRealTime();
    };
    for (const int radius : {2, 8, 32}) {
        const std::string of_radius = "radius " + std::to_string(radius);
        add(of_radius + "/plain", [=](benchmark::State& s) { run_plain(s, radius); });
        for (const bool halves : {false, true}) {
            const std::string name = of_radius + (halves ? ", halves" : "");
            add(name + "/simd", [=](benchmark::State& s) { run(s, radius, executor::simd{}, large(), halves); });
            for (const int threads : {1, 2})
                add(name + "/openmp " + std::to_string(threads), [=](benchmark::State& s) {
                    run(s, radius, executor::openmp{.threads = threads}, large(), halves);
                });
        }
        add(of_radius + "/serial, 128x128",
            [=](benchmark::State& s) { run(s, radius, executor::serial<>{}, small(), false); });
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
