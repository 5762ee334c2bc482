// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "options.hpp"

#include <support/command_line.hpp>
#include <support/size.hpp>
#include <thread>

namespace sure_prefilter {

namespace {

constexpr const char* about =
    "Renders a built-in scene and denoises it by a filter, without and with its features cleaned first: what lens and\n"
    "motion make noisy in them is averaged along the positions that a pixel's samples have in the world.\n\n"
    "    sure_prefilter --scene cars --spp 8 -o out --reference-spp 256\n\n"
    "render.png                      what was rendered\n"
    "without.png, with.png           what the filter makes of it\n"
    "albedo_before.png, albedo_after.png, normal_before.png, normal_after.png\n"
    "bandwidth.png                   how far each pixel was averaged: black not at all, yellow by 2 spreads\n"
    "reference.png                   with --reference-spp: the first of both";

}  // namespace

std::optional<options> parse(int argc, const char* const* argv) {
    options o;
    o.what.size = {256, 192};
    o.what.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    o.what.settings.samples = 8;
    std::vector<std::string> set;
    std::string size, how = cleaning_names[static_cast<std::size_t>(o.how)];
    CLI::App app(about, "sure_prefilter");
    app.add_option("--scene", o.scene, "One of those that simulate --list names");
    app.add_option("-o,--output", o.folder, "The folder for the pictures; it is made where it is not there");
    app.add_option("--filter", o.filter.name, "One of those that denoise --list names")->capture_default_str();
    app.add_option("--set", set, "key=value: a number of the filter")->allow_extra_args(false);
    app.add_option("--prefilter", how,
                   "sure, paper (Stein's estimate as published), one_spread (no covariances), nlm or bilateral")
        ->capture_default_str();
    app.add_option("--spp", o.what.settings.samples, "Samples per pixel")->capture_default_str();
    app.add_option("--seed", o.what.settings.seed, "Renders with other seeds are independent")->capture_default_str();
    app.add_option("--size", size, "WIDTHxHEIGHT (default: 256x192)");
    app.add_option("--frame", o.what.frame, "Number of the frame, of scenes that show frames")->capture_default_str();
    app.add_option("--reference-spp", o.reference_samples, "Renders two references of so many samples per pixel")
        ->check(CLI::Range(1, 1 << 24));
    app.add_option("--threads", o.what.threads, "(default: one a core)")->check(CLI::Range(1, 1024));
    app.add_flag("--json", o.json, "Prints the result as one JSON object");
    if (!programs::parse(app, argc, argv)) return {};

    const std::vector<std::string> known(cleaning_names.begin(), cleaning_names.end());
    const auto found = std::find(known.begin(), known.end(), how);
    if (found == known.end()) winnow::fail("--prefilter: there is no " + how + programs::did_you_mean(how, known));
    o.how = static_cast<cleaning>(found - known.begin());
    if (!size.empty()) o.what.size = programs::parse_size(size);
    if (o.scene.empty()) winnow::fail("no scene: say --scene NAME; simulate --list names them");
    if (o.folder.empty()) winnow::fail("no output: say -o FOLDER");
    if (o.what.settings.samples < 2)
        winnow::fail("--spp " + std::to_string(o.what.settings.samples) +
                     ": there must be at least two samples, one for each half");
    for (const std::string& s : set) {
        const std::size_t at = s.find('=');
        if (at == std::string::npos) winnow::fail("--set " + s + ": expected key=value");
        o.filter.set.emplace_back(s.substr(0, at), s.substr(at + 1));
    }
    denoise::find_filter(o.filter.name).values(o.filter.set);
    return o;
}

}  // namespace sure_prefilter
