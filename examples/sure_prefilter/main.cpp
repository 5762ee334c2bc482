// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// The SURE pre-filter of features on the built-in scenes; see --help.
#include <csignal>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <simulate/measure.hpp>
#include <simulate/output.hpp>
#include <winnow/io/png.hpp>
#include <winnow/metric/mse.hpp>

#include "options.hpp"

namespace sure_prefilter {

namespace {

using namespace winnow;
using simulator::plane_of;

/// Shared with the signal handler.
simulate::render_progress progress;

nlohmann::ordered_json as_json(const simulator::metrics& m) { return {{"mse", m.mse}, {"relmse", m.relmse}}; }

void say(const options& o, const nlohmann::ordered_json& j) {
    if (o.json) {
        std::cout << j.dump(2) << '\n';
        return;
    }
    std::printf("%s %s, %d samples: rendered in %.2f s, features cleaned in %.3f s, %s in %.3f s\n", o.scene.c_str(),
                to_string(o.what.size).c_str(), o.what.settings.samples, j["seconds"]["render"].get<double>(),
                j["seconds"]["prefilter"].get<double>(), o.filter.name.c_str(), j["seconds"]["filter"].get<double>());
    if (!j.contains("metrics")) return;
    for (const auto& [name, m] : j["metrics"].items())
        std::printf("%-8s mse %.6g, relative mse %.6g\n", name.c_str(), m["mse"].get<double>(),
                    m["relmse"].get<double>());
    for (const auto& [name, m] : j["features"].items())
        std::printf("%-8s mse %.6g before, %.6g after\n", name.c_str(), m["before"].get<double>(),
                    m["after"].get<double>());
}

void run(const options& o) {
    const simulator::entry& scene = simulator::find_scene(o.scene);
    simulator::check_memory(scene, o.what);
    const std::filesystem::path folder = o.folder;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder)) fail("cannot make the folder " + o.folder);

    std::vector<simulator::result> truth;
    for (const std::uint64_t i : {1, 2}) {
        if (!o.reference_samples) break;
        simulator::job j = o.what;
        j.settings.samples = o.reference_samples;
        j.settings.seed = o.what.settings.seed + 1'000'000 * i;
        truth.push_back(scene.render(j, progress));
        if (progress.cancel) return;
    }
    const simulator::result render = scene.render(o.what, progress);
    if (progress.cancel) return;

    const int samples = o.what.settings.samples;
    const denoise::scene buffers = scene_of(render, samples);
    workspace memory;
    const filtered without = filter(buffers, o.filter, cleaning::none, samples, o.what.threads, memory);
    const filtered with = filter(buffers, o.filter, o.how, samples, o.what.threads, memory);

    const auto write = [&](const char* name, const image<float>& i) { io::write_png(folder / name, source(i.view())); };
    write("render.png", plane_of(render, "color"));
    write("without.png", without.color);
    write("with.png", with.color);
    write("albedo_before.png", without.features[0]);
    write("albedo_after.png", with.features[0]);
    write("normal_before.png", without.features[1]);
    write("normal_after.png", with.features[1]);
    io::write_error_png(folder / "bandwidth.png", source(with.bandwidths.view()), 2.0f);

    nlohmann::ordered_json said = {
        {"scene", o.scene},
        {"width", o.what.size.width},
        {"height", o.what.size.height},
        {"samples", samples},
        {"filter", o.filter.name},
        {"prefilter", cleaning_names[static_cast<std::size_t>(o.how)]},
        {"seconds", {{"render", render.seconds}, {"prefilter", with.clean_seconds}, {"filter", with.filter_seconds}}}};
    if (!truth.empty()) {
        const simulator::references colors({plane_of(truth[0], "color"), plane_of(truth[1], "color")});
        io::write_png(folder / "reference.png", source(colors.first().view()));
        said["metrics"] = {{"render", as_json(colors.measure(plane_of(render, "color")))},
                           {"without", as_json(colors.measure(without.color))},
                           {"with", as_json(colors.measure(with.color))}};
        const auto exact = features_in_range_of(buffers, truth[0]);
        const auto mse = [&](const filtered& f, std::size_t i) {
            return metric::mse(f.features[i].view(), exact[i].view());
        };
        for (std::size_t i = 0; i < 3; ++i)
            said["features"][std::array{"albedo", "normal", "depth"}[i]] = {{"before", mse(without, i)},
                                                                            {"after", mse(with, i)}};
    }
    say(o, said);
}

}  // namespace

}  // namespace sure_prefilter

int main(int argc, char** argv) {
    std::signal(SIGINT, [](int) { sure_prefilter::progress.cancel = true; });
    std::signal(SIGTERM, [](int) { sure_prefilter::progress.cancel = true; });
    try {
        if (const auto options = sure_prefilter::parse(argc, argv)) sure_prefilter::run(*options);
        if (!sure_prefilter::progress.cancel) return 0;
        std::cerr << "sure_prefilter: interrupted\n";
        return 1;
    } catch (const winnow::invalid_input& e) {
        std::cerr << "sure_prefilter: " << e.what() << '\n';
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "sure_prefilter: " << e.what() << '\n';
        return 1;
    }
}
