// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "inputs.hpp"

#include <cmath>
#include <iostream>
#include <set>
#include <winnow/frame/covariance.hpp>
#include <winnow/frame/unit_range.hpp>
#include <winnow/frame/variance.hpp>

namespace denoise {

namespace {

using namespace winnow;

std::string shown(rectangle r) {
    return to_string(r.size()) + " at " + std::to_string(r.x0) + "," + std::to_string(r.y0);
}

/// One layer of all inputs.
struct stack {
    std::vector<image<float>> renders;
    std::vector<source> every(std::size_t step, std::size_t from = 0) const {
        std::vector<source> some;
        for (std::size_t i = from; i < renders.size(); i += step) some.emplace_back(renders[i].view());
        return some;
    }
};

image<float> mean_of(std::span<const source> renders) {
    image<float> mean(renders[0].size, renders[0].channels);
    mean_and_variance(renders, mean.view(), {});
    return mean;
}

/// Several renders: mean, halves and, of more than two, the variance.
buffer combine(const stack& s) {
    buffer b;
    const auto all = s.every(1);
    b.mean = mean_of(all);
    if (all.size() < 2) return b;
    b.half_a = mean_of(s.every(2));
    b.half_b = mean_of(s.every(2, 1));
    if (all.size() > 2) {
        image<float> raw(b.mean.size(), b.mean.channels());
        mean_and_variance(all, {}, raw.view());
        b.variance = raw;
        smooth_variance(raw.view(), b.variance.view());
    }
    return b;
}

/// Gathers the layers that are needed, file by file.
class gatherer {
public:
    gatherer(const options& o, const filter_entry& filter, const prefilter_entry* prefilter)
        : options_(o), filter_(filter), prefilter_(prefilter) {}

    void add(const std::string& file, const io::exr_image& image) {
        const layer_finder finder(file, image.names(), options_.map);
        for (const guide_entry& g : known_guides()) gather_guide(file, image, finder, g);
        if (first_.empty()) {
            if (options_.layers == names{"all"}) {
                further_ = finder.all_further();
            } else {
                for (const std::string& name : options_.layers) further_.push_back(finder.further(name));
            }
        }
        for (const file_layer& layer : further_) {
            for (const std::string& channel : layer.channels)
                if (!image.find(channel)) fail(file + ": there is no " + channel + ", but " + first_ + " has it");
            keep(file, layer.name, layer.name, image.read(layer.channels), false);
        }
        if (const auto alpha = finder.alpha()) keep(file, *alpha, "alpha", image.read({*alpha}), false);
        if (first_.empty()) first_ = file;
    }

    scene finish(io::exr_image carried) {
        scene s;
        s.carried = std::move(carried);
        const std::size_t renders = options_.inputs.size();
        s.half_a_renders = static_cast<int>((renders + 1) / 2);
        s.half_b_renders = static_cast<int>(std::max<std::size_t>(1, renders / 2));
        s.color_as_read = mean_of(stacks_["color"].every(1));
        if (options_.outliers) s.outliers = suppress_color_outliers();
        for (const guide_entry& g : known_guides())
            if (stacks_.contains(g.name)) s.guides[g.name] = finish_guide(g.name);
        for (const file_layer& layer : further_) {
            buffer b = combine(stacks_[layer.name]);
            b.variance = {};
            s.layers.emplace_back(layer, std::move(b));
        }
        if (renders > 1 && stacks_["alpha"].renders.size() == renders)
            s.carried.set(alpha_, source(combine(stacks_["alpha"]).mean.view()));
        s.color_layer = color_layer_;
        s.read = std::move(read_);
        return s;
    }

private:
    void gather_guide(const std::string& file, const io::exr_image& image, const layer_finder& finder,
                      const guide_entry& g) {
        const bool needed =
            filter_.needs_buffer(g.name) || (g.name == "rest_position" && prefilter_ && prefilter_->positions);
        const bool guides_prefilter = g.name == "rest_position" && prefilter_ && prefilter_->positions;
        if (!filter_.reads_buffer(g.name) && !guides_prefilter && !options_.diagnose) return;
        const auto mean = finder.guide(g), a = finder.companion(g, "halfA"), b = finder.companion(g, "halfB");
        const auto noise = finder.companion(g, "variance");
        if (!mean && !(a && b)) {
            if (needed)
                fail(file + ": " + filter_.name + " needs " + g.name + ", which is not there (layers: " +
                     finder.listing() + "); name it with --map " + g.name + "=LAYER");
            return;
        }
        const auto read = [&](const std::optional<file_layer>& layer, const std::string& name, bool is_variance) {
            if (layer)
                keep(file, layer->name.empty() ? name : layer->name, name, image.read(layer->channels), is_variance);
        };
        read(mean, g.name, false);
        if (g.name == "color" && first_.empty()) {
            color_layer_ = mean ? *mean : file_layer{"", {"R", "G", "B"}};
        }
        if (mean && options_.inputs.size() > 1) return;  // the inputs are the halves
        read(a, g.name + ".halfA", false);
        read(b, g.name + ".halfB", false);
        read(noise, g.name + ".variance", true);
        if (g.name == "rest_position") read(finder.companion(g, "covariance"), g.name + ".covariance", false);
        if (!mean) {
            const std::vector<source> halves{stacks_[g.name + ".halfA"].renders.back().view(),
                                             stacks_[g.name + ".halfB"].renders.back().view()};
            stacks_[g.name].renders.push_back(mean_of(halves));
        }
    }

    void keep(const std::string& file, const std::string& shown_name, const std::string& name, image<float> pixels,
              bool is_variance) {
        if (name == "alpha") alpha_ = shown_name;
        read_.push_back(diagnose(file + ": " + shown_name, source(pixels.view()), is_variance));
        stacks_[name].renders.push_back(std::move(pixels));
    }

    /// Of the renders, or of the halves of one; what they leave of the mean and of the variance follows.
    std::optional<outliers_found> suppress_color_outliers() {
        std::vector<image<float>>& renders = stacks_["color"].renders;
        std::vector<image<float>*> apart;
        for (image<float>& r : renders) apart.push_back(&r);
        if (apart.size() == 1) {
            if (!stacks_.contains("color.halfA") || !stacks_.contains("color.halfB")) return {};
            apart = {&stacks_["color.halfA"].renders[0], &stacks_["color.halfB"].renders[0]};
        }
        std::vector<source> from;
        std::vector<target> to;
        for (image<float>* i : apart) from.emplace_back(i->view()), to.emplace_back(i->view());
        const extent size = renders[0].size();
        image<float> removed(size, 3), count(size);
        const outliers_found found = suppress_outliers(from, to, {removed.view(), count.view()});
        if (apart[0] == &renders[0]) return found;
        const auto stated = stacks_.find("color.variance");
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    renders[0].at(x, y, c) -= removed.at(x, y, c);
                    if (stated != stacks_.end() && count.at(x, y) > 0) stated->second.renders[0].at(x, y, c) = NAN;
                }
        if (stated != stacks_.end() && found.count > 0) {
            image<float>& noise = stated->second.renders[0];
            const image<float> with_holes = noise;
            image<float> filled(size, 3);
            smooth_variance(with_holes.view(), filled.view());
            for (int c = 0; c < 3; ++c)
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        if (!is_finite(noise.at(x, y, c))) noise.at(x, y, c) = filled.at(x, y, c);
        }
        return found;
    }

    buffer finish_guide(const std::string& name) {
        buffer b = combine(stacks_[name]);
        if (options_.inputs.size() > 1) {
            if (name == "rest_position") {
                b.covariance = image<float>(b.mean.size(), 6);
                covariance_of_renders(stacks_[name].every(1), b.covariance.view());
            }
            return b;
        }
        const auto take = [&](const std::string& what, image<float>& to) {
            if (stacks_.contains(name + what)) to = std::move(stacks_[name + what].renders[0]);
        };
        take(".variance", b.variance);
        take(".covariance", b.covariance);
        if (stacks_.contains(name + ".halfA") && stacks_.contains(name + ".halfB")) {
            take(".halfA", b.half_a);
            take(".halfB", b.half_b);
        }
        return b;
    }

    const options& options_;
    const filter_entry& filter_;
    const prefilter_entry* prefilter_;
    std::string first_, alpha_;
    file_layer color_layer_;
    std::vector<file_layer> further_;
    std::map<std::string, stack> stacks_;
    std::vector<layer_diagnosis> read_;
};

/// Upwards to three bits: a bad pixel that holds the maximum changes a little of the scale, mostly nothing.
double rounded_up(double value) { return winnow::detail::rounded_up(static_cast<float>(value)); }

/// Unit range, as the distances between features expect it.
void normalise(const std::string& name, buffer& b) {
    const auto map = [&](auto guide) {
        if (name != guide.name()) return;
        const auto maps = unit_range(guide, b.mean.view());
        if (b.variance.channels()) map_variances(maps, b.mean.view(), b.variance.view(), b.variance.view());
        for (image<float>* i : {&b.mean, &b.half_a, &b.half_b})
            if (i->channels()) map_values(maps, i->view(), i->view());
    };
    map(albedo), map(normal), map(depth), map(position), map(caustic);
}

/// How many samples of a pixel the covariance of its positions is of.
float samples_behind(const options& o, const buffer& positions) {
    if (o.inputs.size() > 1) return static_cast<float>(o.inputs.size());
    if (!positions.covariance.channels() || !positions.variance.channels())
        fail(o.inputs[0] +
             ": the pre-filter sure needs the covariance of the positions in a pixel: give several renders " +
             "with other seeds, or the layers rest_position.covariance and rest_position.variance");
    // Of n samples the variance of the mean is the n-1-th part of that of the samples.
    std::vector<float> ratios;
    for (int y = 0; y < positions.mean.size().height; ++y)
        for (int x = 0; x < positions.mean.size().width; ++x) {
            const auto& s = positions.covariance;
            const auto& v = positions.variance;
            const float samples = s.at(x, y, 0) + s.at(x, y, 3) + s.at(x, y, 5);
            const float mean = v.at(x, y, 0) + v.at(x, y, 1) + v.at(x, y, 2);
            if (mean > 0 && is_finite(samples / mean)) ratios.push_back(samples / mean);
        }
    if (ratios.empty()) return 1;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return 1 + *middle;
}

}  // namespace

named_layers scene::frame() const {
    named_layers frame;
    for (const auto& [name, b] : guides) {
        const auto bind = [&](const std::string& as, const image<float>& pixels) {
            if (pixels.channels()) frame.bind(as, pixels.view());
        };
        bind(name, b.mean);
        bind(name + ".halfA", b.half_a);
        bind(name + ".halfB", b.half_b);
        bind(name + ".variance", b.variance);
        bind(name + ".covariance", b.covariance);
    }
    return frame;
}

scene read_scene(const options& o, const filter_entry& filter, const prefilter_entry* prefilter) {
    gatherer gathered(o, filter, prefilter);
    io::exr_image first;
    for (std::size_t i = 0; i < o.inputs.size(); ++i) {
        io::exr_image image = io::read_exr(o.inputs[i]);
        if (i > 0 && image.data_window() != first.data_window())
            fail(o.inputs[i] + " is " + shown(image.data_window()) + ", " + o.inputs[0] + " is " +
                 shown(first.data_window()));
        gathered.add(o.inputs[i], image);
        if (i == 0) first = std::move(image);
    }
    scene s = gathered.finish(std::move(first));
    if (filter.needs_buffer("halves") && !s.color().has_halves())
        fail(o.inputs[0] + ": " + filter.name +
             " needs two halves of the samples: give two renders with other seeds, or the layers halfA and halfB" +
             (s.color().variance.channels() ? "; with --filter nlm the variance is enough" : ""));
    for (const char* feature : {"albedo", "normal", "depth"}) {
        const bool other = feature == std::string("depth") && s.guides.contains("position");
        if (filter.reads_buffer(feature) && !s.guides.contains(feature) && !other)
            std::cerr << "denoise: " << o.inputs[0] << ": there is no " << feature << "; " << filter.name
                      << " does without\n";
    }
    if (prefilter && prefilter->positions) s.samples = samples_behind(o, s.guides.at("rest_position"));
    if (filter.needs_buffer("variance") && !s.color().has_halves() && !s.color().variance.channels())
        fail(o.inputs[0] + ": " + filter.name +
             " needs the variance of the colour: give two renders with other seeds, or the layer variance");
    return s;
}

image<float> read_reference(const std::string& path, const scene& s) {
    const io::exr_image file = io::read_exr(path);
    const layer_finder finder(path, file.names(), {});
    const auto color = finder.guide(known_guides()[0]);
    if (!color) fail(path + ": there is no colour (layers: " + finder.listing() + ")");
    if (file.data_window() != s.carried.data_window())
        fail(path + " is " + shown(file.data_window()) + ", the input is " + shown(s.carried.data_window()));
    return file.read(color->channels);
}

double squared_mean(const image<float>& mean) {
    double sum = 0;
    std::int64_t count = 0;
    for (int c = 0; c < mean.channels(); ++c)
        for (int y = 0; y < mean.size().height; ++y)
            for (int x = 0; x < mean.size().width; ++x)
                if (const float v = mean.at(x, y, c); is_finite(v)) sum += v, ++count;
    const double average = count ? sum / static_cast<double>(count) : 0;
    return average * average > 0 ? rounded_up(average * average) : 0;
}

void prepare(scene& s, const filter_entry& filter) {
    const float share = s.half_share();
    for (auto& [name, b] : s.guides) {
        const bool normalised = filter.unit_features && name != "color";
        if (filter.own_noise) {
            if (normalised) normalise(name, b);
            continue;
        }
        // Of one file, the variance is that of a renderer's samples, which may be stratified.
        if ((name == "color" || normalised) && s.half_a_renders + s.half_b_renders <= 2 && b.variance.channels() &&
            b.has_halves())
            scale_variance_to_halves(b.variance.view(), b.half_a.view(), b.half_b.view(), b.variance.view(), 10, share);
        if (!b.variance.channels() && (name == "color" || normalised)) {
            if (b.has_halves()) {
                b.variance = image<float>(b.mean.size(), b.mean.channels());
                variance_from_halves(b.half_a.view(), b.half_b.view(), b.variance.view(), 1, share);
            } else if (normalised) {
                b.variance = image<float>(b.mean.size(), b.mean.channels());  // taken for exact
            }
        }
        if (normalised) normalise(name, b);
    }
}

}  // namespace denoise
