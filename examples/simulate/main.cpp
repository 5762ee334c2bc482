// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Renders the built-in scenes from the command line; see --help.
#include <csignal>
#include <iostream>
#include <nlohmann/json.hpp>
#include <support/progress.hpp>
#include <winnow/io/png.hpp>

#include "layers.hpp"
#include "measure.hpp"
#include "options.hpp"
#include "output.hpp"
#include "references.hpp"

namespace simulator {

using namespace winnow;

namespace {

/// Shared with the signal handler.
simulate::render_progress progress;

void write(const options& o, const entry& scene, const result& r, const std::vector<std::string>& wanted) {
    if (o.output.empty()) return;
    if (std::string_view(o.output).ends_with(".png")) {
        io::write_png(o.output, source(plane_of(r, "color").view()));
        return;
    }
    io::write_exr(o.output,
                  as_exr(scene, o.what, r, [&](const std::string& plane) { return is_wanted(plane, wanted); }));
}

void report(const options& o, const entry& scene, const result& r, const std::optional<metrics>& m) {
    const double samples = static_cast<double>(o.what.size.pixels()) * o.what.settings.samples;
    const double each = 1e9 * r.seconds * o.what.threads / samples;
    if (o.json) {
        nlohmann::ordered_json j = {
            {"scene", scene.name()},
            {"width", o.what.size.width},
            {"height", o.what.size.height},
            {"samples", o.what.settings.samples},
            {"seed", o.what.settings.seed},
            {"frame", o.what.frame},
            {"effects", scene.effects()},
            {"random_numbers", {{"camera", scene.camera_numbers()}, {"vertex", scene.vertex_numbers()}}},
            {"bytes", {{"sample", scene.sample_bytes()}, {"memory", scene.bytes(o.what.size, 0)}}},
            {"threads", o.what.threads},
            {"seconds", r.seconds},
            {"nanoseconds_per_sample", each},
            {"bad_samples", r.rejected}};
        if (m) j["metrics"] = {{"mse", m->mse}, {"relmse", m->relmse}};
        std::cout << j.dump(2) << '\n';
        return;
    }
    std::printf("%s %s, %d samples per pixel: %.2f s, %.0f ns a sample on each of %d threads\n", scene.name().c_str(),
                to_string(o.what.size).c_str(), o.what.settings.samples, r.seconds, each, o.what.threads);
    if (m) std::printf("mse %.6g, relative mse %.6g\n", m->mse, m->relmse);
}

void run(const options& o) {
    if (!o.folder.empty()) return make_references(o, progress);
    const entry& scene = find_scene(o.scene);
    std::vector<std::string> wanted = o.layers;
    if (!o.filter.empty()) wanted = planes_of_filter(o.filter);
    check_given(scene, wanted, o.filter.empty() ? "--layers" : o.filter);
    check_memory(scene, o.what);
    for (const std::string& name : {o.output, o.what.deep})
        if (!name.empty()) io::atomic_file would_be_written(name);
    const references truth = references::read(o.references, o.what.size);

    const double all = static_cast<double>(o.what.size.pixels()) * o.what.settings.samples;
    const result r = [&] {
        const programs::progress_line line(o.progress, "simulate",
                                           [all] { return static_cast<double>(progress.done) / all; });
        return scene.render(o.what, progress);
    }();
    if (progress.cancel) return;
    if (r.rejected > 0) std::cerr << "simulate: " << r.rejected << " samples were no numbers and are left out\n";
    std::optional<metrics> m;
    if (!truth.empty()) m = truth.measure(plane_of(r, "color"));
    write(o, scene, r, wanted);
    report(o, scene, r, m);
}

}  // namespace

}  // namespace simulator

int main(int argc, char** argv) {
    std::signal(SIGINT, [](int) { simulator::progress.cancel = true; });
    std::signal(SIGTERM, [](int) { simulator::progress.cancel = true; });
    try {
        if (const auto options = simulator::parse(argc, argv)) simulator::run(*options);
        if (!simulator::progress.cancel) return 0;
        std::cerr << "simulate: interrupted; what was not finished is not written\n";
        return 1;
    } catch (const winnow::invalid_input& e) {
        std::cerr << "simulate: " << e.what() << '\n';
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "simulate: " << e.what() << '\n';
        return 1;
    }
}
