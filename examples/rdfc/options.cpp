// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "options.hpp"

#include <algorithm>
#include <support/command_line.hpp>
#include <support/size.hpp>
#include <thread>

namespace rdfc {

namespace {

constexpr const char* about =
    "Renders a built-in scene and denoises it by RDFC, with pictures of what the filter does: which of its candidates\n"
    "it takes where, and, with --adaptive, where it wants its samples.  Files are filtered by denoise --filter "
    "rdfc.\n\n"
    "    rdfc --scene conference --spp 8 -o out --reference-spp 256\n"
    "    rdfc --scene rings --spp 16 --adaptive -o out\n\n"
    "before.png, after.png      the render and the result\n"
    "selection.png              shares of FIRST, SECOND and THIRD in red, green and blue\n"
    "density.png                --adaptive: samples of each pixel, from black over red to yellow, which is the most\n"
    "reference.png, uniform.png with references: the first, and --adaptive: the result of as many samples, uniform";

/// The place of a name in a list; fails with the nearest one.
template <class Names>
std::size_t place_of(const std::string& option, const std::string& name, const Names& names) {
    const std::vector<std::string> known(names.begin(), names.end());
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) winnow::fail(option + ": there is no " + name + programs::did_you_mean(name, known));
    return static_cast<std::size_t>(found - known.begin());
}

void check(const options& o) {
    if (o.scene.empty()) winnow::fail("no scene: say --scene NAME; simulate --list names them");
    if (o.folder.empty()) winnow::fail("no output: say -o FOLDER");
    if (o.what.settings.samples < 2)
        winnow::fail("--spp " + std::to_string(o.what.settings.samples) +
                     ": there must be at least two samples, one for each half");
    if (o.references.size() > 2)
        winnow::fail("--reference: one or two renders, not " + std::to_string(o.references.size()));
    if (!o.references.empty() && o.reference_samples)
        winnow::fail("--reference and --reference-spp both say what is measured against");
}

}  // namespace

std::optional<options> parse(int argc, const char* const* argv) {
    options o;
    o.what.size = {256, 192};
    o.what.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::string size, choice = selection_names[0], outliers = "on";
    CLI::App app(about, "rdfc");
    app.add_option("--scene", o.scene, "One of those that simulate --list names");
    app.add_option("-o,--output", o.folder, "The folder for the pictures; it is made where it is not there");
    app.add_option("--spp", o.what.settings.samples, "Samples per pixel; with --adaptive on average")
        ->capture_default_str();
    app.add_option("--seed", o.what.settings.seed, "Renders with other seeds are independent")->capture_default_str();
    app.add_option("--size", size, "WIDTHxHEIGHT (default: 256x192)");
    app.add_option("--frame", o.what.frame, "Number of the frame, of scenes that show frames")->capture_default_str();
    app.add_flag("--adaptive", o.adaptive, "Samples where the filter expects most of it");
    app.add_option(
           "--iterations", o.iterations,
           "Of --adaptive, in equal shares of the samples; the first is uniform (default: as many as have four\n"
           "samples per pixel each, from 2 to 4)")
        ->check(CLI::Range(1, 1000));
    app.add_option("--features", o.how.features,
                   "a,b of albedo, normal, depth, visibility, caustic (default: all that the scene gives), or brdf in\n"
                   "place of albedo")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--selection", choice, "binary maps as in the paper, blend, or first, second or third everywhere")
        ->capture_default_str();
    app.add_option("--outliers", outliers, "on: takes single bright samples out before it filters")
        ->capture_default_str();
    app.add_option("--radius", o.filter.radius, "Of the window, in pixels; 20 where light has spikes")
        ->check(CLI::Range(0, 100))
        ->capture_default_str();
    app.add_option("--reference", o.references, "A.exr[,B.exr]: adds metrics; against two, their noise cancels")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--reference-spp", o.reference_samples, "Renders two references of so many samples per pixel")
        ->check(CLI::Range(1, 1 << 24));
    app.add_option("--threads", o.what.threads, "(default: one a core)")->check(CLI::Range(1, 1024));
    app.add_flag("--json", o.json, "Prints the result as one JSON object");
    if (!programs::parse(app, argc, argv)) return {};

    o.filter.choice = static_cast<selection>(place_of("--selection", choice, selection_names));
    o.filter.threads = o.what.threads;
    if (outliers != "on" && outliers != "off") winnow::fail("--outliers " + outliers + ": expected on or off");
    o.how.keep_outliers = outliers == "off";
    std::vector<std::string> known = feature_names();
    known.push_back("brdf");
    for (const std::string& f : o.how.features) place_of("--features", f, known);
    if (!size.empty()) o.what.size = programs::parse_size(size);
    check(o);
    return o;
}

}  // namespace rdfc
