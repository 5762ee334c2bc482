// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// What the authors of the SURE pre-filter claim, measured on the built-in scenes and printed as Markdown:
///     simulate --references refs --size 160x120 && benchmark-prefilter refs [SCENE...]
/// Renders are as large as the references.
#include <iostream>
#include <map>
#include <simulate/output.hpp>
#include <sure_prefilter/features.hpp>
#include <thread>
#include <winnow/metric/mse.hpp>

#include "accuracy/ratio.hpp"
#include "accuracy/truth.hpp"

namespace {

using namespace winnow;
using namespace winnow::benchmarks;
using sure_prefilter::cleaning;
using sure_prefilter::cleaning_names;

constexpr int seeds = 2;
const std::vector<std::string> filters{"sbf",  "sbf as published", "wlr",   "wlr as published",
                                       "rdfc", "atrous",           "guided"};

/// Errors by seed.
using errors = std::vector<double>;

/// Everything that is measured on one scene at one number of samples.
struct row {
    std::string scene;
    int samples;
    errors input;
    std::map<std::pair<std::string, int>, errors> color;  ///< by filter and cleaning
    std::map<int, errors> texture;                        ///< MSE of the cleaned albedo, by cleaning
    std::map<std::string, double> seconds;                ///< the least, of each filter and of the cleaning

    /// How many times the error is smaller with the features cleaned.
    estimate gain(const std::string& filter, cleaning how) const {
        return ratio(color.at({filter, 0}), color.at({filter, static_cast<int>(how)}));
    }
};

/// SBF as published takes the noise of one sample for that of a feature; here it forgives more, and the more so the
/// fewer samples there are.  WLR as published cleans no features by itself.
sure_prefilter::chosen_filter chosen(const std::string& filter, int samples) {
    if (filter == "sbf as published") return {"sbf", {{"automatic", "0"}, {"spread", std::to_string(samples)}}};
    if (filter == "wlr as published") return {"wlr", {{"clean", "0"}}};
    return {filter, {}};
}

void keep_least(std::map<std::string, double>& seconds, const std::string& of, double s) {
    const auto [at, is_new] = seconds.emplace(of, s);
    if (!is_new) at->second = std::min(at->second, s);
}

row measure(const simulator::entry& scene, const truth& reference, const std::string& folder, int samples,
            int threads) {
    row r{scene.name(), samples, {}, {}, {}, {}};
    const image<float> albedo_truth =
        io::read_exr(folder + "/" + scene.name() + "_1.exr").read({"albedo.R", "albedo.G", "albedo.B"});
    simulator::result exact;
    exact.planes = {{"albedo", {}, albedo_truth},
                    {"normal", {}, image<float>(reference.size(), 3)},
                    {"depth", {}, image<float>(reference.size())}};
    simulate::render_progress unwatched;
    simulator::job job;
    job.size = reference.size();
    job.threads = threads;
    job.settings.samples = samples;
    workspace memory;
    for (int seed = 1; seed <= seeds; ++seed) {
        job.settings.seed = static_cast<std::uint64_t>(seed);
        const simulator::result render = scene.render(job, unwatched);
        r.input.push_back(reference.relative_mse(simulator::plane_of(render, "color")));
        const denoise::scene buffers = sure_prefilter::scene_of(render, samples);
        const auto albedo_in_range = sure_prefilter::features_in_range_of(buffers, exact)[0];
        for (const std::string& filter : filters)
            for (int how = 0; how < static_cast<int>(cleaning_names.size()); ++how) {
                const auto f = sure_prefilter::filter(buffers, chosen(filter, samples), static_cast<cleaning>(how),
                                                      samples, threads, memory);
                r.color[{filter, how}].push_back(reference.relative_mse(f.color));
                if (filter == "rdfc")
                    r.texture[how].push_back(metric::mse(f.features[0].view(), albedo_in_range.view()));
                keep_least(r.seconds, filter, f.filter_seconds);
                keep_least(r.seconds, cleaning_names[static_cast<std::size_t>(how)], f.clean_seconds);
            }
    }
    return r;
}

double mean(const errors& e) {
    double sum = 0;
    for (const double x : e) sum += x;
    return sum / static_cast<double>(e.size());
}

std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
}

void print_gains(const std::vector<row>& rows) {
    std::cout << "How many times smaller the relative MSE of the filter is with cleaned features (without: the error "
                 "itself).\n\n| scene | samples | input | filter | without |";
    for (std::size_t how = 1; how < cleaning_names.size(); ++how) std::cout << " `" << cleaning_names[how] << "` |";
    std::cout << "\n|---|---|---|---|---|";
    for (std::size_t how = 1; how < cleaning_names.size(); ++how) std::cout << "---|";
    for (const std::string& filter : filters)
        for (const row& r : rows) {
            std::cout << "\n| " << r.scene << " | " << r.samples << " | " << number(mean(r.input)) << " | " << filter
                      << " | " << number(mean(r.color.at({filter, 0}))) << " |";
            for (std::size_t how = 1; how < cleaning_names.size(); ++how)
                std::cout << ' ' << r.gain(filter, static_cast<cleaning>(how)).short_form() << " |";
        }
    std::cout << '\n';
}

void print_textures(const std::vector<row>& rows) {
    std::cout << "\nMSE of the albedo in unit range.\n\n| scene | samples |";
    for (const char* name : cleaning_names) std::cout << " `" << name << "` |";
    std::cout << "\n|---|---|";
    for (std::size_t i = 0; i < cleaning_names.size(); ++i) std::cout << "---|";
    for (const row& r : rows) {
        std::cout << "\n| " << r.scene << " | " << r.samples << " |";
        for (int how = 0; how < static_cast<int>(cleaning_names.size()); ++how)
            std::cout << ' ' << number(mean(r.texture.at(how))) << " |";
    }
    std::cout << '\n';
}

/// RDFC's authors compare it with SBF.
void print_rdfc_and_sbf(const std::vector<row>& rows) {
    std::cout << "\nError of SBF over that of RDFC, neither with cleaned features.\n\n| scene | samples | sbf | rdfc | "
                 "ratio |\n|---|---|---|---|---|";
    for (const row& r : rows)
        std::cout << "\n| " << r.scene << " | " << r.samples << " | " << number(mean(r.color.at({"sbf", 0}))) << " | "
                  << number(mean(r.color.at({"rdfc", 0}))) << " | "
                  << ratio(r.color.at({"sbf", 0}), r.color.at({"rdfc", 0})).shown() << " |";
    std::cout << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') {
        std::cerr << "usage: benchmark-prefilter REFERENCES [SCENE...]   (see simulate --references)\n";
        return 2;
    }
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<std::string> names(argv + 2, argv + argc);
    if (names.empty()) names = {"cars", "chess", "foliage", "planes"};
    try {
        std::vector<row> rows;
        for (const std::string& name : names) {
            const simulator::entry& scene = simulator::find_scene(name);
            const truth reference(argv[1], scene);
            for (const int samples : {8, 16, 32, 64}) {
                rows.push_back(measure(scene, reference, argv[1], samples, threads));
                std::cerr << name << ", " << samples << " samples: done\n";
            }
        }
        print_gains(rows);
        print_textures(rows);
        print_rdfc_and_sbf(rows);
        return 0;
    } catch (const std::exception& e) {
        std::cerr << "benchmark-prefilter: " << e.what() << '\n';
        return 2;
    }
}
