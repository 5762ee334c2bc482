// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "sampling.hpp"

#include <algorithm>

namespace rdfc {

using namespace winnow;

sample_iterations iterations_of(const simulator::job& job, int iterations) {
    // From two samples in a pixel an error cannot be told.
    if (iterations == 0) iterations = std::clamp(job.settings.samples / 4, 2, 4);
    const sample_iterations plan{
        .size = job.size, .budget = job.size.pixels() * job.settings.samples, .iterations = iterations};
    if (iterations > 1 && job.settings.samples < 2 * iterations)
        fail("--spp " + std::to_string(job.settings.samples) + " in " + std::to_string(iterations) +
             " iterations: there must be at least two in each");
    return plan;
}

adaptive_render render_adaptively(const simulator::entry& scene, const simulator::job& job, int iterations,
                                  const reading& how, const settings& s, workspace& memory,
                                  simulate::render_progress& progress) {
    const sample_iterations plan = iterations_of(job, iterations);
    const auto render = scene.begin(job);
    adaptive_render r{sample_counts(job.size), {}};
    image<float> density;
    for (int k = 0; k < plan.iterations && !progress.cancel; ++k) {
        const sample_counts more = plan.counts(k, density.view());
        render->add(more, progress);
        r.counts += more;
        if (k + 1 == plan.iterations) break;
        const image<float> had = r.counts.plane();
        density = filter(guides(render->developed(), how), s, memory, &had).density;
    }
    r.planes = render->developed();
    return r;
}

}  // namespace rdfc
