// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Times a filter of several passes, 1024x1024, beside its definition on a small frame, and checks its result.
#include <benchmark/benchmark.h>

#include <string>
#include <winnow/executor/openmp.hpp>

#include "support/check.hpp"
#include "support/timed.hpp"

namespace winnow::benchmarks {

inline scene& frame_of(int side) {
    static scene large({1024, 1024}), small({128, 128});
    return side == 1024 ? large : small;
}

/// `bound` is what results may be off from the definition.
template <class Filter, class Executor>
void run_pipeline(benchmark::State& state, const Filter& filter, const Executor& executor, int side, bool halves,
                  double bound) {
    scene& s = frame_of(side);
    const auto in = s.frame();
    output out(s.result);
    if (halves) out.halves(s.result_a.view(), s.result_b.view());
    workspace memory;
    filter(in, out, executor, memory);
    const double seconds = seconds_each(state, [&] { filter(in, out, executor, memory); });
    state.counters["ns/pixel"] = seconds / static_cast<double>(s.color.size().pixels()) * 1e9;
    const double error = largest_error(filter, halo(filter), s, s.result);
    state.counters["max error"] = error;
    if (!(error < bound)) state.SkipWithError("the result differs from the definition");
}

template <class Filter>
void add_pipeline(const std::string& name, const Filter& filter, bool halves, double bound) {
    const auto add = [&](const char* how, const auto& executor, int side) {
        benchmark::RegisterBenchmark(
            (name + "/" + how).c_str(),
            [=](benchmark::State& state) { run_pipeline(state, filter, executor, side, halves, bound); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    };
    add("serial 128x128", executor::serial<>{}, 128);
    add("simd 1024x1024", executor::simd{}, 1024);
    add("openmp 2 threads 1024x1024", executor::openmp{.threads = 2}, 1024);
}

}  // namespace winnow::benchmarks
