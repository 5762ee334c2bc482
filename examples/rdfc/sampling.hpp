// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Rendering where the filter wants it.
#include <simulate/entry.hpp>
#include <winnow/frame/sample_iterations.hpp>

#include "filter.hpp"

namespace rdfc {

struct adaptive_render {
    winnow::sample_counts counts;
    simulator::result planes;
};

/// As many samples in all as job.settings.samples in each pixel; the first of the iterations is uniform, and each of
/// the others goes where the filter of all samples so far expects most.  Stops early, with planes missing, when
/// `progress.cancel` is set.
adaptive_render render_adaptively(const simulator::entry& scene, const simulator::job& job, int iterations,
                                  const reading& how, const settings& s, winnow::workspace& memory,
                                  winnow::simulate::render_progress& progress);

/// The iterations of that; fails where there are too few samples for them.
winnow::sample_iterations iterations_of(const simulator::job& job, int iterations);

}  // namespace rdfc
