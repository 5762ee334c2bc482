// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cmath>
#include <winnow/paper/a_trous_2010.hpp>

#include "entry.hpp"

namespace denoise {

namespace {

/// Sigmas for guides in unit range; larger ones of the colour blur edges more than they take noise away at 16 samples
/// and more.
struct numbers : paper::a_trous_numbers {
    numbers() {
        sigma_color = 1.5f;
        sigma_normal = 0.1f;
        sigma_position = sigma_other = 0.03f;
    }
    int demodulated = 1;
};

/// The filter with its guides still open: they depend on what the input has.
struct open_a_trous {
    paper::a_trous_numbers numbers;
    bool positions;
};

template <class F>
void with_features(const open_a_trous& f, const F& run) {
    if (f.positions) run(paper::a_trous_of<planes<normal_t, position_t>>{f.numbers}, planes<normal_t, position_t>{});
    else run(paper::a_trous_of<planes<normal_t, depth_t>>{f.numbers}, planes<normal_t, depth_t>{});
}

void run(const open_a_trous& f, const job& j) {
    output out = j.out;
    for (const further_layer& layer : j.layers) out.layer(layer.mean, layer.filtered);
    with_features(f, [&]<class... G>(const auto& a_trous, planes<G...>) {
        // A feature that is not there is the same everywhere.
        static constexpr float nothing = 0;
        named_layers frame = j.frame;
        const auto complete = [&](auto g) {
            if (!frame.find(g))
                frame.bind(g.name(), image_view<const float>(&nothing, j.out.mean().size, g.channels, strides{}));
        };
        (complete(G{}), ...);
        with_executor(j.executor, j.threads, [&](const auto& executor) { a_trous(frame, out, executor, j.memory); });
    });
}

int halo(const open_a_trous& f) { return halo(paper::a_trous{f.numbers}); }

}  // namespace

filter_entry atrous_entry() {
    using N = numbers;
    filter_entry e = entry<N>(
        "atrous", "averages over ever wider neighbourhoods of like colour, normal and place; fast", {"color"},
        {"albedo", "normal", "depth", "position"},
        {{"levels", &N::levels, 1, 12, "passes, each twice as wide"},
         {"sigma_color", &N::sigma_color, 0, 1e6, "of the first pass, in units of the mean colour"},
         {"sigma_normal", &N::sigma_normal, 0, 1e6, "in unit range, of neighbouring pixels"},
         {"sigma_position", &N::sigma_position, 0, 1e6, "in unit range"},
         {"sigma_depth", &N::sigma_other, 0, 1e6, "in unit range"},
         {"demodulated", &N::demodulated, 0, 1, "1: filters colour over albedo where there is one"}},
        [](N n, const scene_facts& about) {
            n.sigma_color *= static_cast<float>(std::sqrt(about.squared_mean));
            n.demodulate = n.demodulated && about.has.contains("albedo");
            return open_a_trous{n, !about.has.contains("depth") && about.has.contains("position")};
        },
        [](const open_a_trous& f, const job& j) { run(f, j); });
    e.unit_features = true;
    return e;
}

}  // namespace denoise
