// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Robust denoising using feature and colour information, on the built-in scenes; see --help.
#include <csignal>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <simulate/measure.hpp>
#include <simulate/output.hpp>
#include <support/progress.hpp>
#include <winnow/io/png.hpp>

#include "options.hpp"
#include "sampling.hpp"

namespace rdfc {

namespace {

using namespace winnow;
using simulator::metrics;
using simulator::plane_of;

/// Shared with the signal handler.
simulate::render_progress progress;

/// What becomes of the render.
struct outcome {
    simulator::result render;
    filtered result;
    double seconds = 0;  ///< of filtering the finished render
};

outcome filter_render(const options& o, simulator::result render, workspace& memory) {
    outcome r{std::move(render), {}, 0};
    const guides in(r.render, o.how);
    const programs::stopwatch since;
    r.result = filter(in, o.filter, memory);
    r.seconds = since.seconds();
    return r;
}

/// Two, of seeds that nothing else has.
simulator::references render_references(const options& o, const simulator::entry& scene) {
    std::vector<image<float>> pictures;
    simulator::job j = o.what;
    j.settings.samples = o.reference_samples;
    for (const std::uint64_t i : {1, 2}) {
        j.settings.seed = o.what.settings.seed + 1'000'000 * i;
        const simulator::result r = scene.render(j, progress);
        if (progress.cancel) return {};
        pictures.push_back(plane_of(r, "color"));
    }
    return simulator::references(std::move(pictures));
}

void write_pictures(const std::filesystem::path& folder, const outcome& r, const sample_counts* counts) {
    io::write_png(folder / "before.png", source(plane_of(r.render, "color").view()));
    io::write_png(folder / "after.png", source(r.result.color.view()));
    io::write_png(folder / "selection.png", source(r.result.share.view()));
    if (counts)
        io::write_error_png(folder / "density.png", source(counts->plane().view()), static_cast<float>(counts->most()));
}

nlohmann::ordered_json as_json(const metrics& m) { return {{"mse", m.mse}, {"relmse", m.relmse}}; }

void say(const options& o, const nlohmann::ordered_json& j) {
    if (o.json) {
        std::cout << j.dump(2) << '\n';
        return;
    }
    std::printf("%s %s, %lld samples: rendered in %.2f s, filtered in %.2f s\n", o.scene.c_str(),
                to_string(o.what.size).c_str(), j["samples"]["total"].get<long long>(),
                j["seconds"]["render"].get<double>(), j["seconds"]["filter"].get<double>());
    if (o.adaptive)
        std::printf("samples of a pixel: %d to %d\n", j["samples"]["fewest"].get<int>(),
                    j["samples"]["most"].get<int>());
    if (!j.contains("metrics")) return;
    for (const auto& [name, m] : j["metrics"].items())
        std::printf("%-15s mse %.6g, relative mse %.6g\n", name.c_str(), m["mse"].get<double>(),
                    m["relmse"].get<double>());
}

void run(const options& o) {
    const simulator::entry& scene = simulator::find_scene(o.scene);
    simulator::check_memory(scene, o.what);
    if (o.adaptive) iterations_of(o.what, o.iterations);
    const simulator::references named = simulator::references::read(o.references, o.what.size);
    const std::filesystem::path folder = o.folder;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder)) fail("cannot make the folder " + o.folder);
    const simulator::references truth = o.reference_samples ? render_references(o, scene) : named;
    if (progress.cancel) return;

    workspace memory;
    outcome r;
    sample_counts counts(o.what.size, o.what.settings.samples);
    if (o.adaptive) {
        adaptive_render adaptive = render_adaptively(scene, o.what, o.iterations, o.how, o.filter, memory, progress);
        if (progress.cancel) return;
        counts = std::move(adaptive.counts);
        r = filter_render(o, std::move(adaptive.planes), memory);
    } else {
        simulator::result render = scene.render(o.what, progress);
        if (progress.cancel) return;
        r = filter_render(o, std::move(render), memory);
    }
    write_pictures(folder, r, o.adaptive ? &counts : nullptr);

    nlohmann::ordered_json said = {
        {"scene", o.scene},
        {"width", o.what.size.width},
        {"height", o.what.size.height},
        {"samples", {{"total", counts.total()}, {"fewest", counts.fewest()}, {"most", counts.most()}}},
        {"seconds", {{"render", r.render.seconds}, {"filter", r.seconds}}}};
    if (!truth.empty()) {
        io::write_png(folder / "reference.png", source(truth.first().view()));
        said["metrics"] = {{"before", as_json(truth.measure(plane_of(r.render, "color")))},
                           {"after", as_json(truth.measure(r.result.color))}};
        if (o.adaptive) {
            simulator::result render = scene.render(o.what, progress);
            if (progress.cancel) return;
            const outcome uniform = filter_render(o, std::move(render), memory);
            io::write_png(folder / "uniform.png", source(uniform.result.color.view()));
            said["metrics"]["uniform before"] = as_json(truth.measure(plane_of(uniform.render, "color")));
            said["metrics"]["uniform after"] = as_json(truth.measure(uniform.result.color));
        }
    }
    say(o, said);
}

}  // namespace

}  // namespace rdfc

int main(int argc, char** argv) {
    std::signal(SIGINT, [](int) { rdfc::progress.cancel = true; });
    std::signal(SIGTERM, [](int) { rdfc::progress.cancel = true; });
    try {
        if (const auto options = rdfc::parse(argc, argv)) rdfc::run(*options);
        if (!rdfc::progress.cancel) return 0;
        std::cerr << "rdfc: interrupted\n";
        return 1;
    } catch (const winnow::invalid_input& e) {
        std::cerr << "rdfc: " << e.what() << '\n';
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "rdfc: " << e.what() << '\n';
        return 1;
    }
}
