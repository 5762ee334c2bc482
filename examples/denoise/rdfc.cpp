// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/path_guides.hpp>
#include <winnow/paper/rdfc_2013.hpp>

#include "entry.hpp"

namespace denoise {

namespace {

/// RDFC with its selection and its features still open: they depend on what the input has.
struct open_rdfc {
    paper::rdfc_numbers numbers;
    bool blend, shadows, positions;
};

/// The paper's numbers but for two: larger ones were better on real renders at 4 to 32 samples and on most of the
/// built-in scenes, the more so the fewer samples there were.
struct numbers : paper::rdfc_numbers {
    numbers() {
        k_color = 0.6f;
        k_feature = 1;
    }
    int blend = 0;  ///< which selection
};

/// The usual features; visibility and caustics where the input has one of them; positions where it has no depth.
template <class F>
void with_features(const open_rdfc& f, const F& run) {
    if (f.positions) run(planes<albedo_t, normal_t, position_t>{});
    else if (f.shadows) run(planes<albedo_t, normal_t, depth_t, visibility_t, caustic_t>{});
    else run(planes<albedo_t, normal_t, depth_t>{});
}

void run(const open_rdfc& f, const job& j) {
    with_features(f, [&]<class... G>(planes<G...> features) {
        // A feature that is not there is the same everywhere.
        static constexpr float nothing = 0;
        named_layers frame = j.frame;
        const auto complete = [&](auto g) {
            if (!frame.find(g))
                frame.bind(g.name(), image_view<const float>(&nothing, j.out.mean().size, g.channels, strides{}));
        };
        (complete(G{}), ...);
        output out = j.out;
        for (const further_layer& layer : j.layers) out.layer(layer.mean, layer.filtered);
        with_executor(j.executor, j.threads, [&](const auto& executor) {
            using list = decltype(features);
            if (f.blend)
                paper::rdfc_of<list, paper::convex_blend>{f.numbers}(frame, out, executor, j.memory, j.selection);
            else paper::rdfc_of<list>{f.numbers}(frame, out, executor, j.memory, j.selection);
        });
    });
}

int halo(const open_rdfc& f) {
    return f.blend ? halo(paper::rdfc_of<planes<albedo_t>, paper::convex_blend>{f.numbers})
                   : halo(paper::rdfc_of<planes<albedo_t>>{f.numbers});
}

}  // namespace

filter_entry rdfc_entry() {
    using R = numbers;
    filter_entry e = entry<R>(
        "rdfc", "three filters between trust in colour and in features, and an estimate of which is right where",
        {"color", "halves"}, {"albedo", "normal", "depth", "position", "visibility", "caustic", "variance"},
        {{"radius", &R::radius, 0, 100, "of the window, in pixels; 20 where light has spikes"},
         {"k_color", &R::k_color, 1e-3, 1e3, "larger filters more"},
         {"k_feature", &R::k_feature, 1e-3, 1e3, "larger filters more"},
         {"tau", &R::tau, 1e-9, 1, "squared contrast below which features are alike, of two candidates"},
         {"tau_third", &R::tau_third, 1e-9, 1, "the same, of the candidate that looks at features alone"},
         {"epsilon", &R::epsilon, 0, 1, "variance below which a difference is real, over the squared mean"},
         {"feature_radius", &R::feature_radius, 0, 100, "of the window that cleans the features, in pixels"},
         {"blend", &R::blend, 0, 1, "1: candidates are blended for the least estimated error, not selected"}},
        [](const R& n, const scene_facts& about) {
            open_rdfc f{n, n.blend == 1, about.has.contains("visibility") || about.has.contains("caustic"),
                        !about.has.contains("depth") && about.has.contains("position")};
            f.numbers.epsilon = relative(n.epsilon, about.squared_mean);
            f.numbers.half_share = about.half_share;
            return f;
        },
        [](const open_rdfc& f, const job& j) { run(f, j); });
    e.unit_features = e.own_noise = true;
    return e;
}

}  // namespace denoise
