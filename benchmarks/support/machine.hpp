// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The limits of the machine, measured: what a filter's speed is held against.
#include <chrono>
#include <thread>
#include <vector>
#include <winnow/executor/lanes.hpp>

namespace winnow::benchmarks {

/// Fused multiply-adds per second that the given number of threads reaches on independent registers, in GFLOP/s (two
/// operations each); the best of a few tries.
inline double peak_gflops(int threads) {
    constexpr int chains = 16, rounds = 4'000'000;
    const auto work = [](float& sink) {
        lanes a[chains];
        for (int i = 0; i < chains; ++i) a[i] = lanes(0.001f * static_cast<float>(i));
        const lanes m(0.999f), c(0.001f);
        for (int r = 0; r < rounds; ++r)
#pragma GCC unroll 16
            for (int i = 0; i < chains; ++i) a[i] = lanes::fma(a[i], m, c);
        lanes sum(0.0f);
        for (int i = 0; i < chains; ++i) sum = sum + a[i];
        float out[lanes::size];
        sum.store(out);
        sink = out[0];
    };
    double best = 0;
    for (int attempt = 0; attempt < 5; ++attempt) {
        std::vector<float> sinks(static_cast<std::size_t>(threads));
        const auto start = std::chrono::steady_clock::now();
        {
            std::vector<std::jthread> pool;
            for (int t = 0; t < threads; ++t) pool.emplace_back([&, t] { work(sinks[static_cast<std::size_t>(t)]); });
        }
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        volatile float keep = sinks[0];
        (void)keep;
        best = std::max(best, 2.0 * chains * rounds * lanes::size * threads / seconds * 1e-9);
    }
    return best;
}

}  // namespace winnow::benchmarks
