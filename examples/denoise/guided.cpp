// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/estimator/residual_variance.hpp>
#include <winnow/paper/guided_2010.hpp>

#include "entry.hpp"

namespace denoise {

namespace {

/// Whether depth or position is a guide depends on what the input has.
struct open_guided {
    paper::guided_numbers numbers;
    bool positions;
};

/// The albedo as a guide does what a division by it would do, and needs no care where it is dark or shines itself:  on
/// real renders at 4 to 32 samples it was as good.  So few samples also want smaller windows than the library's.
struct numbers : paper::guided_numbers {
    numbers() : paper::guided_numbers{.radius = 2, .epsilon = least_epsilon} {}
};

int halo(const open_guided& f) { return halo(paper::guided{f.numbers}); }

template <class Guides>
void run(const open_guided& f, const job& j, Guides) {
    output out = j.out;
    for (const further_layer& layer : j.layers) out.layer(layer.mean, layer.filtered);
    with_executor(j.executor, j.threads, [&](const auto& executor) {
        paper::guided_of<Guides, estimator::residual_variance>{f.numbers}(j.frame, out, executor, j.memory);
    });
}

void run(const open_guided& f, const job& j) {
    if (f.positions) return run(f, j, planes<albedo_t, normal_t, position_t>{});
    // A depth that is not there is the same everywhere.
    static constexpr float nothing = 0;
    named_layers frame = j.frame;
    if (!frame.find(depth)) frame.bind("depth", image_view<const float>(&nothing, j.out.mean().size, 1, strides{}));
    run(f, job{frame, j.out, j.layers, j.executor, j.threads, j.memory, j.selection},
        planes<albedo_t, normal_t, depth_t>{});
}

}  // namespace

filter_entry guided_entry() {
    using G = numbers;
    filter_entry e = entry<G>(
        "guided", "in every window a linear function of albedo, normal and depth", {"color", "albedo", "normal"},
        {"depth", "position"},
        {{"radius", &G::radius, 0, 100, "of the windows, in pixels; a pixel is filtered from twice as far"},
         {"epsilon", &G::epsilon, double{G::least_epsilon}, 1e6, "variance below which a feature explains nothing"}},
        [](const G& n, const scene_facts& about) {
            return open_guided{n, !about.has.contains("depth") && about.has.contains("position")};
        },
        [](const open_guided& f, const job& j) { run(f, j); });
    e.unit_features = e.own_noise = true;
    return e;
}

}  // namespace denoise
