// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "filters.hpp"

#include <charconv>
#include <cmath>
#include <support/nearest.hpp>
#include <winnow/estimator/residual_variance.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/paper/rdfc_2013_candidate.hpp>

#include "entry.hpp"

namespace denoise {

namespace {

template <class W, class Window, class E>
void run(const filter<W, Window, E>& f, const job& j) {
    output out = j.out;
    for (const further_layer& layer : j.layers) out.layer(layer.mean, layer.filtered);
    with_executor(j.executor, j.threads, [&](const auto& executor) {
        f.with(estimator::residual_variance{})(j.frame, out, executor, j.memory);
    });
}

/// As dual_buffer itself, but layers that come in halves are filtered half by half like the colour: so they still add
/// up to it.
template <class F>
void run(const dual_buffer<F>& dual, const job& j) {
    const extent size = j.out.mean().size;
    struct half_results {
        image<float> color;
        std::vector<image<float>> layers;
    } a, b;
    const auto run_half = [&](const auto& frame, half_results& result, auto half) {
        result.color = image<float>(size, j.out.mean().channels);
        output out{result.color};
        for (const further_layer& layer : j.layers)
            result.layers.emplace_back(layer.filtered.size, layer.filtered.channels);
        for (std::size_t i = 0; i < j.layers.size(); ++i)
            out.layer(j.layers[i].*half ? j.layers[i].*half : j.layers[i].mean, result.layers[i].view());
        with_executor(j.executor, j.threads,
                      [&](const auto& executor) { dual.filter(frame, out, executor, j.memory); });
    };
    j.memory.progress.enter(0, 0.5f);
    run_half(crossed_frame<named_layers, half_b, half_a>{j.frame}, a, &further_layer::half_a);
    j.memory.progress.enter(0.5f, 1);
    run_half(crossed_frame<named_layers, half_a, half_b>{j.frame}, b, &further_layer::half_b);

    const auto combine = [](const source& x, const source& y, const target& to, const auto& f) {
        for (int c = 0; to && c < to.channels; ++c)
            for (int v = 0; v < to.size.height; ++v)
                for (int u = 0; u < to.size.width; ++u)
                    to.channel(c).set(u, v, f(x.channel(c).at(u, v), y.channel(c).at(u, v)));
    };
    const auto mean = [](float x, float y) { return (x + y) / 2; };
    const source first(a.color.view()), second(b.color.view());
    combine(first, second, j.out.mean(), mean);
    combine(first, second, j.out.half_a(), [](float x, float) { return x; });
    combine(first, second, j.out.half_b(), [](float, float y) { return y; });
    combine(first, second, j.out.error(), [](float x, float y) { return (x - y) * (x - y) / 4; });
    for (std::size_t i = 0; i < j.layers.size(); ++i)
        combine(a.layers[i].view(), b.layers[i].view(), j.layers[i].filtered, mean);
}

constexpr auto run_it = [](const auto& f, const job& j) { run(f, j); };

std::vector<filter_entry> all_filters() {
    using B = paper::bilateral_numbers;
    using J = paper::joint_bilateral_numbers;
    using N = paper::nlm_2012_numbers;
    using R = paper::rdfc_candidate_numbers;
    const std::vector<knob<N>> nlm_numbers{
        {"radius", &N::radius, 0, 100, "of the window, in pixels"},
        {"patch_radius", &N::patch_radius, 0, 20, "of the surroundings, in pixels"},
        {"k", &N::k, 1e-3, 1e3, "larger filters more"},
        {"epsilon", &N::epsilon, 0, 1, "variance below which a difference is real, over the squared mean"}};
    std::vector<filter_entry> all{
        entry<B>(
            "bilateral", "averages neighbours of like colour", {"color"}, {},
            {{"radius", &B::radius, 0, 100, "of the window, in pixels"},
             {"sigma_spatial", &B::sigma_spatial, 0, 1000, "in pixels"},
             {"sigma_color", &B::sigma_color, 0, 1e6, "in units of radiance"}},
            [](const B& n, const scene_facts&) { return paper::make_bilateral(n); }, run_it),
        entry<J>(
            "joint_bilateral", "averages neighbours of like albedo and normal", {"color", "albedo", "normal"}, {},
            {{"radius", &J::radius, 0, 100, "of the window, in pixels"},
             {"sigma_spatial", &J::sigma_spatial, 0, 1000, "in pixels"},
             {"sigma_albedo", &J::sigma_albedo, 0, 1e6, "in units of the albedo"},
             {"sigma_normal", &J::sigma_normal, 0, 1e6, "in units of the normal"}},
            [](const J& n, const scene_facts&) { return paper::make_joint_bilateral(n); }, run_it),
        entry<N>(
            "nlm", "averages neighbours whose surroundings are alike but for noise", {"color", "variance"}, {},
            nlm_numbers,
            [](N n, const scene_facts& about) {
                n.epsilon = relative(n.epsilon, about.squared_mean);
                return paper::make_nlm(n);
            },
            run_it),
        entry<N>(
            "nlm_dual", "as nlm, but each half of the samples with weights from the other", {"color", "halves"}, {},
            nlm_numbers,
            [](N n, const scene_facts& about) {
                n.epsilon = relative(n.epsilon, about.squared_mean);
                return paper::make_nlm_2012_released(n);
            },
            run_it),
        entry<R>(
            "rdfc_candidate", "as nlm, but never across an edge of albedo, normal or depth",
            {"color", "variance", "albedo", "normal", "depth"}, {},
            {{"radius", &R::radius, 0, 100, "of the window, in pixels"},
             {"patch_radius", &R::patch_radius, 0, 20, "of the surroundings, in pixels"},
             {"k_color", &R::k_color, 1e-3, 1e3, "larger filters more"},
             {"k_feature", &R::k_feature, 1e-3, 1e3, "larger filters more"},
             {"tau", &R::tau, 1e-9, 1, "squared contrast below which features are alike"},
             {"epsilon", &R::epsilon, 0, 1, "variance below which a difference is real, over the squared mean"}},
            [](R n, const scene_facts& about) {
                n.epsilon = relative(n.epsilon, about.squared_mean);
                return paper::make_rdfc_candidate(n);
            },
            run_it),
    };
    all.back().unit_features = true;
    all.push_back(guided_entry());
    all.push_back(rdfc_entry());
    all.push_back(sbf_entry());
    all.push_back(atrous_entry());
    all.push_back(wlr_entry());
    return all;
}

}  // namespace

std::string number::shown(double value) const {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

bool filter_entry::needs_buffer(const std::string& buffer) const {
    return std::find(needs.begin(), needs.end(), buffer) != needs.end();
}

bool filter_entry::reads_buffer(const std::string& buffer) const {
    return needs_buffer(buffer) || std::find(uses.begin(), uses.end(), buffer) != uses.end();
}

std::vector<double> filter_entry::values(const std::vector<std::pair<std::string, std::string>>& set) const {
    std::vector<double> values;
    std::vector<std::string> keys;
    for (const number& n : numbers) values.push_back(n.initial), keys.push_back(n.name);
    for (const auto& [key, said] : set) {
        const auto at = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
        if (at == keys.size()) fail(name + " has no number " + key + programs::did_you_mean(key, keys));
        const number& n = numbers[at];
        double value = 0;
        const auto [end, error] = std::from_chars(said.data(), said.data() + said.size(), value);
        const bool read = error == std::errc{} && end == said.data() + said.size();
        if (!read || !(value >= n.lowest && value <= n.highest) || (n.whole && value != std::floor(value)))
            fail("--set " + key + "=" + said + ": " + key + " is a " + (n.whole ? "whole number" : "number") +
                 " from " + n.shown(n.lowest) + " to " + n.shown(n.highest));
        values[at] = value;
    }
    return values;
}

std::string filter_entry::shown(const std::vector<double>& values) const {
    std::string all;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        all += (i ? " " : "") + numbers[i].name + "=" + numbers[i].shown(values[i]);
    return all;
}

const std::vector<filter_entry>& filters() {
    static const std::vector<filter_entry> all = all_filters();
    return all;
}

const filter_entry& find_filter(const std::string& name) {
    std::vector<std::string> known;
    for (const filter_entry& f : filters()) {
        if (f.name == name) return f;
        known.push_back(f.name);
    }
    fail("there is no filter " + name + programs::did_you_mean(name, known));
}

std::string default_executor() {
#if defined(_OPENMP)
    return "openmp";
#else
    return "simd";
#endif
}

int check_executor(const std::string& executor, int threads) {
    std::vector<std::string> known{"serial", "simd"};
    if (default_executor() == "openmp") known.push_back("openmp");
    if (std::find(known.begin(), known.end(), executor) == known.end())
        fail("there is no executor " + executor + programs::did_you_mean(executor, known));
#if defined(_OPENMP)
    if (executor == "openmp") return threads ? threads : omp_get_max_threads();
#endif
    if (threads > 1) fail("--threads " + std::to_string(threads) + ": " + executor + " runs on one thread");
    return 1;
}

}  // namespace denoise
