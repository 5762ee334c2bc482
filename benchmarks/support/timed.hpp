// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Wall time of one call, for counters that Google Benchmark does not know.
#include <benchmark/benchmark.h>

#include <chrono>

namespace winnow::benchmarks {

/// Runs the benchmark's loop over the call; returns seconds per call.
template <class Call>
double seconds_each(benchmark::State& state, const Call& call) {
    const auto start = std::chrono::steady_clock::now();
    for (auto _ : state) call();
    const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
    return all.count() / static_cast<double>(state.iterations());
}

}  // namespace winnow::benchmarks
