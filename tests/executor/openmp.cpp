// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <omp.h>
#include <winnow/executor/openmp.hpp>
#include "executor/agreement.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {
std::vector<how> with_threads(executor_kind alone, executor_kind kind) {
    std::vector<how> hows = {{.kind = alone, .tile = {32, 8}}};
    for (const int threads : {1, 2, 3, 7}) hows.push_back({.kind = kind, .threads = threads, .tile = {32, 8}});
    return hows;
}
}  // namespace

TEST_CASE("openmp gives the bits of simd on 1, 2, 3 and 7 threads", "[openmp]") {
    for (const border rule : all_borders)
        check_same_bits({67, 45}, with_threads(executor_kind::simd, executor_kind::openmp),
                        all_filters({.radius = 2, .border = rule}));
}

TEST_CASE("openmp_over<serial<>> gives the bits of serial on 1, 2, 3 and 7 threads", "[openmp]") {
    check_same_bits({35, 67}, with_threads(executor_kind::serial, executor_kind::openmp_serial),
                    all_filters({.radius = 2}));
}

TEST_CASE("more threads than tiles do no harm", "[openmp]") {
    check_same_bits({5, 3}, with_threads(executor_kind::simd, executor_kind::openmp), all_filters({.radius = 2}));
}

TEST_CASE("openmp without a number of threads takes what OpenMP offers, and leaves its settings alone", "[openmp]") {
    CHECK(executor::openmp{}.workers() == omp_get_max_threads());
    const int before = omp_get_max_threads();
    const extent size{40, 30};
    const buffers in = make_buffers(size);
    bilateral().images(in.layers(), size, {.kind = executor_kind::openmp, .threads = 3, .tile = {16, 4}});
    CHECK(omp_get_max_threads() == before);
}
