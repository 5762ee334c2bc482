// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/rdfc_2013_cleaning.hpp>
#include <winnow/paper/wlr_2014.hpp>

#include "entry.hpp"

namespace denoise {

namespace {

/// WLR with its features still open: they depend on what the input has.
struct open_wlr {
    paper::wlr_numbers numbers;
    bool cleaned, positions;
};

struct numbers : paper::wlr_numbers {
    int clean = 1;  ///< whether features are cleaned first: worth up to a third of the error on real renders
};

/// The usual features; positions where the input has no depth.
template <class F>
void with_features(const open_wlr& f, const F& run) {
    if (f.positions) run(planes<albedo_t, normal_t, position_t>{});
    else run(planes<albedo_t, normal_t, depth_t>{});
}

/// Features that come in halves are filtered by themselves, as RDFC does; the result lies in `memory`.
template <guide... G, class Executor>
void clean(named_layers& frame, extent size, const Executor& executor, workspace& memory) {
    // Two images of each feature, the noise of the colour, and what the cleaning of one takes in between.
    scratch_images images(memory.images, size, 2 * planes<G...>::count + 3 + 3 * 3);
    const auto cleaned = paper::rdfc_cleaning<G...>{}(pass_runner(executor, memory), frame, images);
    (frame.bind(G::name(), cleaned.find(G{})), ...);
    (frame.bind(variance(G{}).name(), cleaned.find(variance(G{}))), ...);
}

void run(const open_wlr& f, const job& j) {
    with_features(f, [&]<class... G>(planes<G...> features) {
        const extent size = j.out.mean().size;
        workspace cleaned;
        // A feature that is not there is the same everywhere: it is dropped.
        static constexpr float nothing = 0;
        named_layers frame = j.frame;
        const auto complete = [&](auto g) {
            if (!frame.find(g)) frame.bind(g.name(), image_view<const float>(&nothing, size, g.channels, strides{}));
        };
        (complete(G{}), ...);
        output out = j.out;
        for (const further_layer& layer : j.layers) out.layer(layer.mean, layer.filtered);
        with_executor(j.executor, j.threads, [&](const auto& executor) {
            if (f.cleaned && frame.find(first_half(color))) clean<G...>(frame, size, executor, cleaned);
            paper::wlr_of<decltype(features)>{f.numbers}(frame, out, executor, j.memory);
        });
    });
}

int halo(const open_wlr& f) {
    const int cleaning = f.cleaned ? 11 + halo(paper::rdfc_cleaning<albedo_t>{}.feature_filter(albedo)) + 3 : 0;
    return cleaning + halo(paper::wlr_of<planes<albedo_t>>{f.numbers});
}

}  // namespace

filter_entry wlr_entry() {
    using W = numbers;
    filter_entry e = entry<W>(
        "wlr", "the colour as a linear function of the features around each pixel", {"color", "variance"},
        {"albedo", "normal", "depth", "position"},
        {{"radius", &W::radius, 0, 100, "of the window, in pixels"},
         {"unit", &W::unit, 1e-6, 1e6, "radiance of a well-lit surface, over the root of the squared mean"},
         {"least_component", &W::least_component, 0, 1, "share of the window below which a component is dropped"},
         {"flatness", &W::flatness, 1e-6, 1e6, "larger trusts features less far"},
         {"outlier_sigmas", &W::outlier_sigmas, 0, 1e6, "deviations beyond which a neighbour does not count"},
         {"outlier_floor", &W::outlier_floor, 0, 1e6, "differences below this are never outliers, in units"},
         {"largest_bandwidth", &W::largest_bandwidth, 0.02, 1e3, "larger filters more"},
         {"smoothing", &W::smoothing, 0, 10, "of the bandwidths, in pixels"},
         {"clean", &W::clean, 0, 1, "1: features are filtered by themselves before"}},
        [](W n, const scene_facts& about) {
            n.unit = static_cast<float>(n.unit * std::sqrt(about.squared_mean) + 1e-15);
            return open_wlr{n, n.clean == 1, !about.has.contains("depth") && about.has.contains("position")};
        },
        [](const open_wlr& f, const job& j) { run(f, j); });
    e.unit_features = true;
    return e;
}

}  // namespace denoise
