// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Time of each filter on each executor, per pixel and offset, beside the operation count and the machine's peak.
#include <benchmark/benchmark.h>
#include <winnow/executor/openmp.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/paper/rdfc_2013.hpp>

#include "support/check.hpp"
#include "support/counted.hpp"
#include "support/machine.hpp"
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

double peak(int threads) {
    static const double one = benchmarks::peak_gflops(1), two = benchmarks::peak_gflops(2);
    return threads == 1 ? one : two;
}

/// Times the filter, checks what it made, and reports ns per pixel and offset and the share of the peak.
template <class Filter, class Executor>
void run(benchmark::State& state, const Filter& filter, const Executor& executor, scene& s, bool halves, int threads) {
    const auto in = s.frame();
    output out(s.result);
    if (halves) out.halves(s.result_a.view(), s.result_b.view());
    workspace memory;
    filter(in, out, executor, memory);
    const double seconds = benchmarks::seconds_each(state, [&] { filter(in, out, executor, memory); });

    const double pairs = static_cast<double>(area(filter.window)) * static_cast<double>(s.color.size().pixels());
    const double operations = benchmarks::operations_per_pair(filter, halves ? 9 : 3);
    state.counters["ops/pair"] = operations;
    state.counters["ns/pair"] = seconds / pairs * 1e9;
    state.counters["GFLOP/s"] = operations * pairs / seconds * 1e-9;
    state.counters["peak"] = peak(threads);
    const double error = benchmarks::largest_error(filter, halo(filter), s, s.result);
    state.counters["max error"] = error;
    if (!(error < 2e-5)) state.SkipWithError("the result differs from the definition");
}

template <class Filter>
void add(const std::string& name, const Filter& filter, bool halves = false) {
    const auto add_one = [&](const std::string& executor_name, const auto& executor, scene& (*s)(), int threads) {
        benchmark::RegisterBenchmark(
            (name + "/" + executor_name).c_str(),
            [=](benchmark::State& state) { run(state, filter, executor, s(), halves, threads); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    };
    add_one("serial 128x128", executor::serial<>{}, small, 1);
    add_one("simd 1024x1024", executor::simd{}, large, 1);
    add_one("openmp 2 threads 1024x1024", executor::openmp{.threads = 2}, large, 2);
}

}  // namespace

int main(int argc, char** argv) {
    add("joint bilateral, 3-channel guide, 21x21",
        filter{gaussian(spatial, 5.0f) * gaussian(l2(albedo), 0.1f), window::square{.radius = 10}});
    add("nlm, 21x21, patch 3x3", paper::make_nlm({.patch_radius = 1}));
    add("nlm, 21x21, patch 7x7", paper::make_nlm({.patch_radius = 3}));
    add("rdfc candidate, 21x21, patch 7x7", paper::make_rdfc_candidate());
    add("rdfc candidate with halves, 21x21, patch 7x7", paper::make_rdfc_candidate(), true);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
