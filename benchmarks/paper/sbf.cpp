// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Time of SBF with one and with two settings of the features, and of the smoothing of errors within it.
#include <winnow/paper/sbf_2012.hpp>

#include "support/pipeline.hpp"

int main(int argc, char** argv) {
    using namespace winnow;
    // Where two candidates are equally good, lanes and the definition may choose differently.
    const double a_choice = 0.3;
    benchmarks::add_pipeline("SBF, scales 1 2 4", paper::sbf{}, false, a_choice);
    benchmarks::add_pipeline("SBF with halves", paper::sbf{}, true, a_choice);
    benchmarks::add_pipeline("SBF, two settings", paper::sbf_automatic{}, false, a_choice);
    benchmarks::add_pipeline("smoothing of errors, 17x17", paper::sbf{}.bank.smoothing(), false, 2e-5);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
