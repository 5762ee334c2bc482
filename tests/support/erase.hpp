// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Makes an any_filter; compiles the filter for every executor.
#include <algorithm>
#include <array>
#include <support/any_filter.hpp>
#include <winnow/executor/openmp.hpp>
#include <winnow/executor/pool.hpp>
#include <winnow/filter/candidates.hpp>
#include <winnow/filter/dual_buffer.hpp>
#include <winnow/filter/filter.hpp>

namespace winnow::test {

/// Calls f with the executor that h describes.
template <class F>
auto with_executor(const how& h, const F& f) {
    const executor::simd lanes{.tile = h.tile};
    const executor::fresh_threads threads{h.threads};
    switch (h.kind) {
        case executor_kind::serial_double:
            return f(executor::serial<double>{});
        case executor_kind::serial:
            return f(executor::serial<>{});
        case executor_kind::simd:
            return f(lanes);
        case executor_kind::openmp:
            return f(executor::openmp{.threads = h.threads, .inner = lanes});
        case executor_kind::openmp_serial:
            return f(executor::openmp_over<executor::serial<>>{.threads = h.threads});
        case executor_kind::pool:
            break;
    }
    return f(executor::pool{threads, lanes});
}

template <class Filter>
int outputs_of(const Filter&) {
    return 1;
}
template <class W, class E, class... Weights>
int outputs_of(const candidates<W, E, Weights...>&) {
    return sizeof...(Weights);
}

template <class Filter, class Executor>
void run(const Filter& f, const named_layers& in, std::span<const output> out, const Executor& executor,
         workspace& memory) {
    f(in, out[0], executor, memory);
}
template <class W, class E, class... Weights, class Executor>
void run(const candidates<W, E, Weights...>& f, const named_layers& in, std::span<const output> out,
         const Executor& executor, workspace& memory) {
    std::array<output, sizeof...(Weights)> all;
    std::copy(out.begin(), out.end(), all.begin());
    f(in, all, executor, memory);
}

template <class Filter>
any_filter erase(std::string name, const Filter& f) {
    any_filter any;
    any.name = std::move(name);
    any.outputs = outputs_of(f);
    any.halo = halo(f);
    any.run = [f](const named_layers& in, std::span<const output> out, const how& h, workspace& memory) {
        with_executor(h, [&](const auto& executor) { run(f, in, out, executor, memory); });
    };
    any.plan = [f](extent size, const how& h, int values) {
        return with_executor(h, [&](const auto& executor) { return plan(f, size, executor, values); });
    };
    return any;
}

}  // namespace winnow::test
