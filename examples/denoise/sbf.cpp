// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/sbf_2012.hpp>

#include "entry.hpp"

namespace denoise {

namespace {

struct numbers {
    float scale = 1;
    float spread = 64;
    float floor = 1e-2f;
    float smoothing = 4;
    int automatic = 1;
};

/// SBF with its features still open: they depend on what the input has.
struct open_sbf {
    numbers n;
    bool positions;
};

template <class Features, std::size_t Settings>
auto make(const numbers& n) {
    paper::least_error_of<paper::cross_bilateral_bank<Features, Settings>> f;
    f.bank.scales = {n.scale, 2 * n.scale, 4 * n.scale};
    f.bank.smoothing_scale = n.smoothing;
    f.bank.like[0] = {.spread = n.spread, .floor = n.floor};
    if constexpr (Settings > 1) f.bank.like[1] = {.spread = 4 * n.spread, .floor = 0.3f * n.floor};
    return f;
}

/// f(SBF of the features and settings).
template <class F>
void with_settings(const open_sbf& s, const F& f) {
    const auto with_features = [&]<class Features>(Features) {
        if (s.n.automatic) f(make<Features, 2>(s.n), Features{});
        else f(make<Features, 1>(s.n), Features{});
    };
    if (s.positions) with_features(planes<albedo_t, normal_t, position_t>{});
    else with_features(planes<albedo_t, normal_t, depth_t>{});
}

void run(const open_sbf& s, const job& j) {
    output out = j.out;
    for (const further_layer& layer : j.layers) out.layer(layer.mean, layer.filtered);
    with_settings(s, [&]<class... G>(const auto& sbf, planes<G...>) {
        // A feature that is not there is the same everywhere.
        static constexpr float nothing = 0;
        named_layers frame = j.frame;
        const auto complete = [&](auto g) {
            if (!frame.find(g))
                frame.bind(g.name(), image_view<const float>(&nothing, j.out.mean().size, g.channels, strides{}));
        };
        (complete(G{}), ...);
        (complete(variance(G{})), ...);
        with_executor(j.executor, j.threads, [&](const auto& executor) { sbf(frame, out, executor, j.memory); });
    });
}

int halo(const open_sbf& s) {
    int reach = 0;
    with_settings(s, [&](const auto& sbf, const auto&) { reach = halo(sbf); });
    return reach;
}

}  // namespace

filter_entry sbf_entry() {
    using N = numbers;
    filter_entry e = entry<N>(
        "sbf", "averages over neighbours of like features, at the scale whose estimated error is the least",
        {"color", "variance"}, {"albedo", "normal", "depth", "position"},
        {{"scale", &N::scale, 0, 100, "the finest, in pixels; the others are twice and four times as large"},
         {"spread", &N::spread, 0, 1e6, "how much noise of features is forgiven: larger filters more"},
         {"floor", &N::floor, 1e-12, 1, "squared difference of features below which they are alike"},
         {"smoothing", &N::smoothing, 0, 100, "scale over which estimated errors are smoothed, in pixels"},
         {"automatic", &N::automatic, 0, 1, "1: also tries four times the spread with a third of the floor"}},
        [](const N& n, const scene_facts& about) {
            return open_sbf{n, !about.has.contains("depth") && about.has.contains("position")};
        },
        [](const open_sbf& s, const job& j) { run(s, j); });
    e.unit_features = true;
    return e;
}

}  // namespace denoise
