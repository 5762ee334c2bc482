// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Time of SBF with one and with two settings of the features, and of the smoothing of errors within it.
#include <winnow/paper/sbf_2012.hpp>

#include "support/pipeline.hpp"

int main(int argc, char** argv) {
    using namespace winnow;
    benchmarks::add_pipeline("SBF, scales 1 2 4", paper::sbf{}, false, 2e-5);
    benchmarks::add_pipeline("SBF with halves", paper::sbf{}, true, 2e-5);
    benchmarks::add_pipeline("SBF, two settings", paper::sbf_automatic{}, false, 2e-5);
    benchmarks::add_pipeline("smoothing of errors, 17x17", paper::sbf{}.bank.smoothing(), false, 2e-5);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
