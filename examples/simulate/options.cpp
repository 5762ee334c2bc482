// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "options.hpp"

#include <iostream>
#include <support/command_line.hpp>
#include <support/size.hpp>
#include <thread>

#include "layers.hpp"

namespace simulator {

namespace {

constexpr const char* about =
    "Renders the built-in scenes, with everything that filters ask for: means, variances and half buffers of each "
    "layer,\n"
    "and on demand all samples.  What is written is read by denoise.\n\n"
    "    simulate --scene cars --spp 8 -o cars.exr\n"
    "    simulate --references refs\n";

bool ends_with(const std::string& name, const char* suffix) { return std::string_view(name).ends_with(suffix); }

std::string joined(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
    return all;
}

void list(const std::string& effect) {
    std::vector<const entry*> shown;
    if (effect.empty())
        for (const auto& s : scenes()) shown.push_back(s.get());
    else shown = scenes_that_show(effect);
    for (const entry* s : shown)
        std::cout << s->name() << std::string(s->name().size() < 12 ? 12 - s->name().size() : 1, ' ') << s->summary()
                  << "\n    shows " << joined(s->effects()) << "\n    gives " << joined(s->guides())
                  << "\n    a path draws " << s->camera_numbers() << " random numbers at the camera and up to "
                  << s->vertex_numbers() << " at each vertex; a sample is " << s->sample_bytes() << " bytes\n";
}

}  // namespace

std::optional<options> parse(int argc, const char* const* argv) {
    options o;
    o.what.size = {256, 192};
    bool listed = false;
    std::string size, effect, pattern = "stratified";
    CLI::App app(about, "simulate");
    app.add_option("--scene", o.scene, "One of those that --list names");
    app.add_option("-o,--output", o.output, "The render: .exr with all layers, or .png, tone-mapped");
    app.add_flag("--list", listed, "Names all scenes, what they show, and the layers that they give");
    app.add_option("--effect", effect, "With --list: only scenes that show this");
    app.add_option("--spp", o.what.settings.samples, "Samples per pixel")->capture_default_str();
    app.add_option("--seed", o.what.settings.seed, "Renders with other seeds are independent")->capture_default_str();
    app.add_option("--size", size, "WIDTHxHEIGHT (default: 256x192)");
    app.add_option("--frame", o.what.frame, "Number of the frame, of scenes that show frames")->capture_default_str();
    app.add_option("--pattern", pattern, "stratified or independent samples")->capture_default_str();
    app.add_option("--samples", o.what.deep, "DEEP.exr: also writes every sample");
    app.add_option("--layers", o.layers, "a,b: only these layers, and the colour")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--filter", o.filter, "Only the layers that this filter of denoise reads");
    app.add_option("--reference", o.references, "A.exr[,B.exr]: adds metrics; against two, their noise cancels")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--references", o.folder,
                   "FOLDER: renders two references of every scene (or of --scene) unless they are there");
    app.add_option("--threads", o.what.threads, "(default: one a core)")->check(CLI::Range(1, 1024));
    app.add_flag("--json", o.json, "Prints the result as one JSON object");
    app.add_flag("--progress", o.progress, "Says on stderr how far it is, and how long it will take");
    o.what.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    if (!programs::parse(app, argc, argv)) return {};

    if (!effect.empty() && !listed) winnow::fail("--effect " + effect + ": goes with --list");
    if (listed) {
        list(effect);
        return {};
    }
    o.sized = !size.empty();
    o.sampled = app.count("--spp") > 0;
    if (o.sized) o.what.size = programs::parse_size(size);
    if (o.what.settings.samples < 1)
        winnow::fail("--spp " + std::to_string(o.what.settings.samples) + ": there must be at least one sample");
    if (pattern == "independent") o.what.settings.pattern = winnow::simulate::pattern::independent;
    else if (pattern != "stratified") winnow::fail("--pattern " + pattern + ": expected stratified or independent");
    if (!o.folder.empty()) return o;
    if (o.scene.empty()) winnow::fail("no scene: say --scene NAME; simulate --list names them");
    if (o.output.empty() && o.what.deep.empty()) winnow::fail("no output: say -o OUTPUT.exr");
    if (!o.output.empty() && !ends_with(o.output, ".exr") && !ends_with(o.output, ".png"))
        winnow::fail(o.output + ": a render is written as .exr or .png");
    if (!o.what.deep.empty() && !ends_with(o.what.deep, ".exr"))
        winnow::fail(o.what.deep + ": samples are written as .exr");
    if (o.references.size() > 2)
        winnow::fail("--reference: one or two renders, not " + std::to_string(o.references.size()));
    if (!o.filter.empty() && !o.layers.empty()) winnow::fail("--filter and --layers both say what is written");
    return o;
}

}  // namespace simulator
