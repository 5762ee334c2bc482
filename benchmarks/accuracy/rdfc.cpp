// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// What RDFC's authors claim, measured on the built-in scenes and printed as Markdown:
///     simulate --references refs --size 160x120 && benchmark-accuracy refs
/// Renders are as large as the references.
#include <iostream>
#include <map>
#include <rdfc/sampling.hpp>
#include <simulate/output.hpp>
#include <thread>

#include "accuracy/ratio.hpp"
#include "accuracy/truth.hpp"
#include "accuracy/variants.hpp"

namespace {

using namespace winnow;
using namespace winnow::benchmarks;

constexpr int seeds = 4;

/// Errors of one variant, one for each seed.
using errors = std::vector<double>;

/// Everything that is measured on one scene at one number of samples, by the name of the variant.
struct row {
    std::string scene;
    int samples;
    std::map<std::string, errors> all, penumbra, shadow_edges, caustics;

    estimate of(const std::string& over, const std::string& under = "rdfc") const {
        return ratio(all.at(over), all.at(under));
    }
};

row measure(const simulator::entry& scene, const truth& reference, int samples, int threads) {
    row r{scene.name(), samples, {}, {}, {}, {}};
    const mask penumbra = reference.penumbra(), edges = reference.shadow_edges(), caustics = reference.caustics();
    workspace memory;
    simulate::render_progress unwatched;
    simulator::job job;
    job.size = reference.size();
    job.threads = threads;
    job.settings.samples = samples;
    for (int seed = 1; seed <= seeds; ++seed) {
        job.settings.seed = static_cast<std::uint64_t>(seed);
        const auto keep = [&](const std::string& name, const image<float>& picture) {
            r.all[name].push_back(reference.relative_mse(picture));
            if (!penumbra.empty()) r.penumbra[name].push_back(reference.relative_mse(picture, penumbra));
            if (!edges.empty()) r.shadow_edges[name].push_back(reference.relative_mse(picture, edges));
            if (!caustics.empty()) r.caustics[name].push_back(reference.relative_mse(picture, caustics));
        };
        const simulator::result render = scene.render(job, unwatched);
        keep("input", simulator::plane_of(render, "color"));
        for (variant v : all_variants()) {
            if (v.name == "no caustic" && caustics.empty()) continue;
            v.numbers.threads = threads;
            const rdfc::guides in(render, {v.features, v.keep_outliers});
            keep(v.name, rdfc::filter(in, v.numbers, memory).color);
        }
        rdfc::settings numbers;
        numbers.threads = threads;
        const rdfc::adaptive_render adaptive = rdfc::render_adaptively(scene, job, 4, {}, numbers, memory, unwatched);
        keep("adaptive input", simulator::plane_of(adaptive.planes, "color"));
        keep("adaptive", rdfc::filter(rdfc::guides(adaptive.planes), numbers, memory).color);
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
    std::snprintf(text, sizeof text, "%.4g", x);
    return text;
}

/// A claim that an error is so many times another, over all rows that have both.
void claim(const std::vector<row>& rows, const std::string& what, const std::string& paper, double accepted,
           std::map<std::string, errors> row::*where, const std::string& over, const std::string& under) {
    std::vector<estimate> ratios;
    double least = 1e30, most = 0;
    for (const row& r : rows) {
        const auto& found = r.*where;
        if (!found.contains(over) || !found.contains(under)) continue;
        ratios.push_back(ratio(found.at(over), found.at(under)));
        least = std::min(least, ratios.back().value);
        most = std::max(most, ratios.back().value);
    }
    if (ratios.empty()) return;
    const estimate all = mean_ratio(ratios);
    std::cout << "| " << what << " | " << paper << " | " << number(accepted) << " | " << all.shown() << " | "
              << number(least) << " to " << number(most) << " | " << ratios.size() << " | "
              << (all.value >= accepted ? "yes" : "no") << " |\n";
}

void print_claims(const std::vector<row>& rows) {
    std::cout << "| claim: error without, over error with | paper | accepted | here | of each scene and count | of "
                 "them | met |\n|---|---|---|---|---|---|---|\n";
    claim(rows, "visibility, in half shadow", "qualitative", 1.2, &row::penumbra, "no visibility", "rdfc");
    claim(rows, "visibility, at edges of shadows", "", 1.2, &row::shadow_edges, "no visibility", "rdfc");
    claim(rows, "visibility, whole picture", "", 1, &row::all, "no visibility", "rdfc");
    claim(rows, "caustic photons, where they are dense", "qualitative", 1.2, &row::caustics, "no caustic", "rdfc");
    claim(rows, "caustic photons, whole picture", "", 1, &row::all, "no caustic", "rdfc");
    claim(rows, "adaptive, at the same budget", "1.22", 1.05, &row::all, "rdfc", "adaptive");
    claim(rows, "texture, over the BRDF's mean in its place", "0.99", 0.9, &row::all, "rdfc", "brdf for albedo");
    for (const char* candidate : {"first", "second", "third"})
        claim(rows, std::string("selection, over ") + candidate + " alone", "most points", 1, &row::all,
              candidate + std::string(" alone"), "rdfc");

    int best = 0;
    for (const row& r : rows) {
        const double selected = mean(r.all.at("rdfc"));
        best += selected <= mean(r.all.at("first alone")) && selected <= mean(r.all.at("second alone")) &&
                selected <= mean(r.all.at("third alone"));
    }
    std::cout << "\nThe selection is at least as good as the best candidate alone in " << best << " of " << rows.size()
              << " rows; accepted are 80 %.\n";
}

void print_variants(const std::vector<row>& rows) {
    std::vector<std::string> names;
    for (const variant& v : all_variants())
        if (v.name != "rdfc") names.push_back(v.name);
    names.push_back("adaptive");
    std::cout << "\n| variant | mean |";
    for (const row& r : rows) std::cout << ' ' << r.scene << ' ' << r.samples << " |";
    std::cout << "\n|---|---|";
    for (std::size_t i = 0; i < rows.size(); ++i) std::cout << "---|";
    for (const char* plain : {"input", "rdfc"}) {
        std::cout << "\n| `" << plain << "`, relative MSE | |";
        for (const row& r : rows) std::cout << ' ' << number(mean(r.all.at(plain))) << " |";
    }
    for (const std::string& name : names) {
        std::vector<estimate> ratios;
        for (const row& r : rows)
            if (r.all.contains(name)) ratios.push_back(r.of(name));
        if (ratios.empty()) continue;
        std::cout << "\n| " << name << " | " << mean_ratio(ratios).shown() << " |";
        for (const row& r : rows) std::cout << ' ' << (r.all.contains(name) ? r.of(name).short_form() : "") << " |";
    }
    std::cout << '\n';
}

std::vector<std::string> scene_names(int argc, char** argv) {
    if (argc > 2) return {argv + 2, argv + argc};
    return {"balls", "cars", "chess", "conference", "fireflies", "fog", "foliage", "mirror", "planes", "rings"};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') {
        std::cerr << "usage: benchmark-accuracy REFERENCES [SCENE...]   (see simulate --references)\n";
        return 2;
    }
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    try {
        std::vector<row> rows;
        for (const std::string& name : scene_names(argc, argv)) {
            const simulator::entry& scene = simulator::find_scene(name);
            const truth reference(argv[1], scene);
            for (const int samples : {8, 32}) {
                rows.push_back(measure(scene, reference, samples, threads));
                std::cerr << name << ", " << samples << " samples: done\n";
            }
        }
        print_claims(rows);
        print_variants(rows);
        return 0;
    } catch (const std::exception& e) {
        std::cerr << "benchmark-accuracy: " << e.what() << '\n';
        return 2;
    }
}
