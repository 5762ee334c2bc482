// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "options.hpp"

#include <iostream>
#include <support/command_line.hpp>

#include "filters.hpp"
#include "prefilter.hpp"

namespace denoise {

namespace {

constexpr const char* about =
    "Denoises a Monte Carlo render.\n\n"
    "Several inputs are independent renders of the same frame (other seeds): two are its half buffers; of more, the "
    "even\n"
    "and the odd ones form the halves, and all give the variance.  One input may carry halves and variance itself, in "
    "the\n"
    "layers halfA, halfB, variance, and NAME.halfA, NAME.halfB, NAME.variance of a feature NAME.\n"
    "The alpha channel is averaged over the inputs; layers that are not asked for are those of the first.";

std::pair<std::string, std::string> split(const std::string& option, const std::string& said, const char* form) {
    const std::size_t at = said.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == said.size())
        winnow::fail(option + " " + said + ": expected " + form);
    return {said.substr(0, at), said.substr(at + 1)};
}

winnow::rectangle parse_crop(const std::string& said) {
    winnow::rectangle r;
    char end = 0;
    if (std::sscanf(said.c_str(), "%d,%d,%d,%d%c", &r.x0, &r.y0, &r.x1, &r.y1, &end) != 4)
        winnow::fail("--crop " + said + ": expected x0,y0,x1,y1");
    if (r.x0 >= r.x1 || r.y0 >= r.y1) winnow::fail("--crop " + said + ": is empty");
    return r;
}

bool ends_with(const std::string& name, const char* suffix) { return std::string_view(name).ends_with(suffix); }

void list_filters() {
    for (const filter_entry& f : filters()) {
        std::cout << f.name << std::string(f.name.size() < 18 ? 18 - f.name.size() : 1, ' ') << f.summary
                  << "\n    needs ";
        for (std::size_t i = 0; i < f.needs.size(); ++i) std::cout << (i ? ", " : "") << f.needs[i];
        for (std::size_t i = 0; i < f.uses.size(); ++i) std::cout << (i ? ", " : "; uses ") << f.uses[i];
        std::cout << '\n';
        for (const number& n : f.numbers)
            std::cout << "    --set " << n.name << "=" << n.shown(n.initial) << "  " << n.summary << " ("
                      << n.shown(n.lowest) << " to " << n.shown(n.highest) << ")\n";
    }
    std::cout << "\nBefore any of them, --prefilter cleans the features:\n";
    for (const prefilter_entry& f : prefilters())
        std::cout << "    " << f.name << std::string(14 - f.name.size(), ' ') << f.summary << '\n';
}

}  // namespace

std::optional<options> parse(int argc, const char* const* argv) {
    options o;
    std::vector<std::string> set, map;
    std::string crop;
    bool list = false;
    const std::map<std::string, bool> switches{{"on", true}, {"off", false}};
    CLI::App app(about, "denoise");
    app.add_option("INPUT.exr", o.inputs, "Renders");
    app.add_option("-o,--output", o.output, "The result: .exr, or .png, tone-mapped");
    app.add_option("--filter", o.filter, "One of those that --list names")->capture_default_str();
    app.add_option("--prefilter", o.prefilter,
                   "Cleans the features first: sure (needs positions, of several renders or with their covariance), "
                   "nlm or bilateral");
    app.add_flag("--list", list, "Names all filters, the layers that each needs and its numbers, and all pre-filters");
    app.add_option("--set", set, "key=value: a number of the filter")->allow_extra_args(false);
    app.add_option("--map", map, "NAME=LAYER: the layer of the file that holds NAME")->allow_extra_args(false);
    app.add_option("--outliers", o.outliers, "on or off (on): takes fireflies out first; needs halves")
        ->transform(CLI::CheckedTransformer(switches));
    app.add_option("--do-no-harm", o.do_no_harm,
                   "on or off (on): blends toward the input where the halves show that the filter made it worse")
        ->transform(CLI::CheckedTransformer(switches));
    app.add_option("--reference", o.reference, "A converged render: adds metrics of input and output");
    app.add_option("--error", o.error, "Writes the estimated error: .exr, or .png, relative to the brightness");
    app.add_option("--selection", o.selection,
                   "Writes which candidate counts where, as red, green and blue: .exr or .png (rdfc)");
    app.add_option("--layers", o.layers, "a,b or all: also filters these layers, with the weights of the colour")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--crop", crop, "x0,y0,x1,y1: filters only these pixels, with the result of the whole");
    app.add_option("--executor", o.executor, "serial, simd or openmp");
    app.add_option("--threads", o.threads, "Of openmp (default: one a core)")->check(CLI::Range(1, 1024));
    app.add_flag("--json", o.json, "Prints the result as one JSON object");
    app.add_flag("--progress", o.progress, "Says on stderr how far it is");
    app.add_flag("--diagnose", o.diagnose, "Says on stderr what looks wrong with the input; needs no output");
    if (!programs::parse(app, argc, argv)) return {};
    if (list) {
        list_filters();
        return {};
    }
    if (o.inputs.empty()) winnow::fail("no input; try denoise --help");
    if (o.output.empty() && !o.diagnose) winnow::fail("no output: say -o OUTPUT.exr");
    for (const std::string& name : {o.output, o.error, o.selection})
        if (!name.empty() && !ends_with(name, ".exr") && !ends_with(name, ".png"))
            winnow::fail(name + ": a result is written as .exr or .png");
    for (const std::string& s : set) o.set.push_back(split("--set", s, "key=value"));
    for (const std::string& m : map) o.map.push_back(split("--map", m, "NAME=LAYER"));
    if (!crop.empty()) o.crop = parse_crop(crop);
    return o;
}

}  // namespace denoise
