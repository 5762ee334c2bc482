// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Time of edge-avoiding A-Trous, five levels of 25 taps, colour, normal and depth; and of each level by itself.
#include <winnow/paper/a_trous_2010.hpp>

#include "support/pipeline.hpp"

int main(int argc, char** argv) {
    using namespace winnow;
    const paper::a_trous_of<planes<normal_t, depth_t>> filter;
    benchmarks::add_pipeline("A-Trous, 5 levels", filter, false, 2e-5);
    benchmarks::add_pipeline("A-Trous with halves, 5 levels", filter, true, 2e-5);
    for (int i = 0; i < filter.numbers.levels; ++i)
        benchmarks::add_pipeline("level " + std::to_string(i), filter.level(i), false, 2e-5);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
