// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Denoises a render from the command line; see --help.
#include <cmath>
#include <iostream>
#include <support/progress.hpp>
#include <winnow/filter/do_no_harm.hpp>
#include <winnow/io/exr.hpp>
#include <winnow/io/png.hpp>

#include "filters.hpp"
#include "inputs.hpp"
#include "options.hpp"
#include "report.hpp"

namespace denoise {

namespace {

using namespace winnow;
using programs::stopwatch;

struct results {
    rectangle window;  ///< what was asked for, relative to the data window
    image<float> filtered, half_a, half_b;
    image<float> error;  ///< squared
    image<float> selection;
    std::vector<image<float>> layers;
};

/// How far around a pixel the estimate of harm looks.
constexpr int harm_reach = do_no_harm_numbers{}.wide;

/// The pixels that were asked for, relative to the data window.
rectangle window_of(const options& o, const io::exr_image& image) {
    const rectangle all = image.data_window();
    const rectangle r = o.crop.value_or(all);
    if (r.x0 < all.x0 || r.y0 < all.y0 || r.x1 > all.x1 || r.y1 > all.y1)
        fail("--crop " + std::to_string(r.x0) + "," + std::to_string(r.y0) + "," + std::to_string(r.x1) + "," +
             std::to_string(r.y1) + ": " + o.inputs[0] + " has the pixels " + std::to_string(all.x0) + "," +
             std::to_string(all.y0) + "," + std::to_string(all.x1) + "," + std::to_string(all.y1));
    return {r.x0 - all.x0, r.y0 - all.y0, r.x1 - all.x0, r.y1 - all.y0};
}

image<float> copy(const image_view<const float>& from) {
    image<float> to(from.size, from.channels);
    for (int c = 0; c < from.channels; ++c)
        for (int y = 0; y < from.size.height; ++y)
            for (int x = 0; x < from.size.width; ++x) to.at(x, y, c) = from.at(x, y, c);
    return to;
}

image<float> scaled(const image<float>& from, float by) {
    image<float> to = from;
    for (int c = 0; c < to.channels(); ++c)
        for (int y = 0; y < to.size().height; ++y)
            for (int x = 0; x < to.size().width; ++x) to.at(x, y, c) *= by;
    return to;
}

/// Filters the window with as much around it as its pixels depend on.
results run(const options& o, const prefilter_entry* prefilter, const ready_filter& filter, const scene& s,
            rectangle window, bool with_error) {
    const bool halves = o.do_no_harm && s.color().has_halves();
    const rectangle grown = window.grown(filter.halo + (prefilter ? prefilter->halo : 0) + (halves ? harm_reach : 0));
    const rectangle region{std::max(0, grown.x0), std::max(0, grown.y0), std::min(s.size().width, grown.x1),
                           std::min(s.size().height, grown.y1)};
    const auto part = [&](const image<float>& whole) {
        return whole.channels() ? source(whole.view().crop(region)) : source{};
    };
    named_layers frame;
    image<float> noise_a, noise_b;
    for (const auto& [name, b] : s.guides) {
        const auto bind = [&](const std::string& as, const image<float>& whole) {
            if (whole.channels()) frame.bind(as, part(whole));
        };
        bind(name, b.mean);
        bind(name + ".variance", b.variance);
        bind(name + ".halfA", b.half_a);
        bind(name + ".halfB", b.half_b);
        bind(name + ".covariance", b.covariance);
        if (name != "color" || !b.has_halves() || !b.variance.channels()) continue;
        // The variance of a half is that of the mean, times how many more samples the mean has.
        const auto renders = static_cast<float>(s.half_a_renders + s.half_b_renders);
        bind("color.halfA.variance", noise_a = scaled(b.variance, renders / static_cast<float>(s.half_a_renders)));
        bind("color.halfB.variance", noise_b = scaled(b.variance, renders / static_cast<float>(s.half_b_renders)));
    }

    results r;
    r.window = window;
    r.filtered = image<float>(region.size(), 3);
    if (with_error) r.error = image<float>(region.size(), 3);
    std::vector<further_layer> layers;
    for (const auto& [layer, b] : s.layers) r.layers.emplace_back(region.size(), b.mean.channels());
    for (std::size_t i = 0; i < s.layers.size(); ++i) {
        const buffer& b = s.layers[i].second;
        layers.push_back({s.layers[i].first.name, part(b.mean), part(b.half_a), part(b.half_b), r.layers[i].view()});
    }

    output out{r.filtered};
    if (with_error) out.error(r.error.view());
    if (halves) {
        r.half_a = r.half_b = image<float>(region.size(), 3);
        out.halves(r.half_a.view(), r.half_b.view());
    }
    if (!o.selection.empty()) r.selection = image<float>(region.size(), 3);
    workspace memory;
    {
        const programs::progress_line line(o.progress, "denoise", [&] { return memory.progress.share(); });
        if (prefilter) {
            memory.progress.enter_filter(0, 0.2f);
            prefilter->run(frame, s.samples, o.executor, o.threads, memory);
            memory.progress.enter_filter(0.2f, 1);
        }
        filter.run({frame, out, layers, o.executor, o.threads, memory,
                    r.selection.channels() ? target(r.selection.view()) : target{}});
    }
    if (halves) {
        image<float> lambda(region.size());
        do_no_harm({part(s.color().mean), part(s.color().half_a), part(s.color().half_b)},
                   {r.filtered.view(), r.half_a.view(), r.half_b.view()}, lambda.view());
        blend(part(s.color().mean), r.filtered.view(), lambda.view(), r.filtered.view());
        for (const further_layer& layer : layers) blend(layer.mean, layer.filtered, lambda.view(), layer.filtered);
    }
    const rectangle inner{window.x0 - region.x0, window.y0 - region.y0, window.x1 - region.x0, window.y1 - region.y0};
    const auto keep_window = [&](image<float>& i) {
        if (i.channels()) i = copy(image_view<const float>(i.view().crop(inner)));
    };
    keep_window(r.filtered);
    keep_window(r.error);
    keep_window(r.selection);
    for (image<float>& layer : r.layers) keep_window(layer);
    return r;
}

bool is_png(const std::string& name) { return std::string_view(name).ends_with(".png"); }

void set_channels(io::exr_image& file, const std::vector<std::string>& channels, const image<float>& values) {
    for (std::size_t c = 0; c < channels.size(); ++c)
        file.set(channels[c], source(values.view()).channel(static_cast<int>(c)));
}

rectangle in_file(const rectangle& window, const io::exr_image& file) {
    const rectangle all = file.data_window();
    return {window.x0 + all.x0, window.y0 + all.y0, window.x1 + all.x0, window.y1 + all.y0};
}

void write_output(const options& o, const scene& s, const results& r, const std::string& numbers) {
    if (is_png(o.output)) return io::write_png(o.output, source(r.filtered.view()));
    io::exr_image file = s.carried.cropped(in_file(r.window, s.carried));
    set_channels(file, s.color_layer.channels, r.filtered);
    for (std::size_t i = 0; i < s.layers.size(); ++i) set_channels(file, s.layers[i].first.channels, r.layers[i]);
    file.set_attribute("winnow:version", WINNOW_VERSION);
    file.set_attribute("winnow:filter", o.filter);
    file.set_attribute("winnow:numbers", numbers);
    if (!o.prefilter.empty()) file.set_attribute("winnow:prefilter", o.prefilter);
    io::write_exr(o.output, file);
}

/// The root of a squared error; an estimate below 0 counts as none.
image<float> root(const image<float>& squared) {
    image<float> r = squared;
    for (int c = 0; c < r.channels(); ++c)
        for (int y = 0; y < r.size().height; ++y)
            for (int x = 0; x < r.size().width; ++x) r.at(x, y, c) = std::sqrt(std::max(0.0f, r.at(x, y, c)));
    return r;
}

void write_selection(const options& o, const scene& s, const results& r) {
    if (is_png(o.selection)) return io::write_png(o.selection, source(r.selection.view()));
    io::exr_image file(in_file(r.window, s.carried));
    set_channels(file, {"R", "G", "B"}, r.selection);
    io::write_exr(o.selection, file);
}

void write_error(const options& o, const scene& s, const results& r) {
    image<float> error = root(r.error);
    if (!is_png(o.error)) {
        io::exr_image file(in_file(r.window, s.carried));
        set_channels(file, {"R", "G", "B"}, error);
        file.set_attribute("winnow:version", WINNOW_VERSION);
        file.set_attribute("winnow:filter", o.filter);
        return io::write_exr(o.error, file);
    }
    // As an eye would see it: against the brightness of its pixel, and full at a half of it.
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < error.size().height; ++y)
            for (int x = 0; x < error.size().width; ++x) error.at(x, y, c) /= std::abs(r.filtered.at(x, y, c)) + 0.1f;
    io::write_error_png(o.error, source(error.view()), 0.5f);
}

double mean(const image<float>& error) {
    double sum = 0;
    for (int c = 0; c < error.channels(); ++c)
        for (int y = 0; y < error.size().height; ++y)
            for (int x = 0; x < error.size().width; ++x) sum += error.at(x, y, c);
    return sum / static_cast<double>(error.size().pixels() * error.channels());
}

void denoise_files(options o) {
    const filter_entry& entry = find_filter(o.filter);
    const prefilter_entry* prefilter = o.prefilter.empty() ? nullptr : &find_prefilter(o.prefilter);
    const std::vector<double> values = entry.values(o.set);
    if (o.executor.empty()) o.executor = default_executor();
    const int threads = check_executor(o.executor, o.threads);
    for (const std::string& name : {o.output, o.error, o.selection})
        if (!name.empty()) io::atomic_file would_be_written(name);
    if (!o.selection.empty() && o.filter != "rdfc") fail("--selection: " + o.filter + " has no candidates to select");

    report said;
    said.filter = o.filter;
    said.executor = o.executor;
    said.threads = threads;
    const stopwatch reading;
    scene s = read_scene(o, entry, prefilter);
    said.read_seconds = reading.seconds();
    said.read = &s.read;
    said.outliers = s.outliers;
    const rectangle window = window_of(o, s.carried);
    said.size = window.size();
    if (!o.error.empty() && !s.color().has_halves())
        fail("--error: " + o.inputs[0] +
             " has no halves to tell the error from: give two renders with other seeds, or the layers halfA and halfB");
    image<float> reference;
    if (!o.reference.empty()) reference = read_reference(o.reference, s);

    if (o.diagnose) print_diagnosis({s.read, diagnose(s.frame()).warnings});
    else warn_of_bad_pixels(s.read);
    if (o.output.empty()) return;

    const stopwatch filtering;
    prepare(s, entry);
    scene_facts about{squared_mean(s.color().mean), s.half_share(), {}};
    for (const auto& guide : s.guides) about.has.insert(guide.first);
    const ready_filter filter = entry.make(values, about);
    const bool with_error = s.color().has_halves() && (o.json || !o.error.empty());
    const results r = run(o, prefilter, filter, s, window, with_error);
    said.filter_seconds = filtering.seconds();

    const stopwatch writing;
    if (!o.error.empty()) write_error(o, s, r);
    if (!o.selection.empty()) write_selection(o, s, r);
    write_output(o, s, r, entry.shown(values));
    said.write_seconds = writing.seconds();

    if (with_error) said.estimated_mse = mean(r.error);
    if (!o.reference.empty()) {
        const source truth(image_view<const float>(reference.view().crop(window)));
        said.input = compare(source(image_view<const float>(s.color_as_read.view()).crop(window)), truth);
        said.output = compare(source(r.filtered.view()), truth);
    }
    if (o.json) print_json(said);
    else print_text(said);
}

}  // namespace

}  // namespace denoise

int main(int argc, char** argv) {
    try {
        if (const auto options = denoise::parse(argc, argv)) denoise::denoise_files(*options);
        return 0;
    } catch (const winnow::invalid_input& e) {
        std::cerr << "denoise: " << e.what() << '\n';
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "denoise: " << e.what() << '\n';
        return 1;
    }
}
