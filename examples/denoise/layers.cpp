// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "layers.hpp"

#include <algorithm>
#include <support/nearest.hpp>
#include <winnow/core/error.hpp>

namespace denoise {

namespace {

bool contains(const names& all, const std::string& name) {
    return std::find(all.begin(), all.end(), name) != all.end();
}

/// "ViewLayer.Combined.R" is channel R of layer ViewLayer.Combined.
std::string layer_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}
std::string component_of(const std::string& channel) { return channel.substr(channel.rfind('.') + 1); }

std::string joined_name(const std::string& layer, const std::string& component) {
    return layer.empty() ? component : layer + "." + component;
}

bool is_feature(const std::string& layer) {
    const auto& guides = known_guides();
    return std::any_of(guides.begin() + 1, guides.end(), [&](const auto& g) { return contains(g.aliases, layer); });
}

/// A layer's name, or the same behind the name of a view layer.
bool is_called(const std::string& layer, const std::string& name, bool exact) {
    return layer == name || (!exact && !name.empty() && std::string_view(layer).ends_with("." + name));
}

}  // namespace

const std::vector<guide_entry>& known_guides() {
    static const std::vector<guide_entry> all = {
        {"color", 3, {"", "Combined", "rgba", "RGBA", "color"}},
        {"albedo", 3, {"albedo", "Albedo", "Denoising Albedo", "DiffCol", "diffcol"}},
        {"normal", 3, {"normal", "Normal", "N", "Ns", "Denoising Normal", "sh_normal"}},
        {"depth", 1, {"depth", "Depth", "Z", "Denoising Depth"}},
        {"position", 3, {"position", "Position", "P"}},
        {"rest_position", 3, {"rest_position", "position", "Position", "P"}},
        {"visibility", 1, {"visibility", "shadow"}},
        {"caustic", 1, {"caustic", "caustics"}},
        {"roughness", 1, {"roughness", "Roughness"}},
    };
    return all;
}

layer_finder::layer_finder(std::string file, names channels, std::vector<std::pair<std::string, std::string>> map)
    : file_(std::move(file)), channels_(std::move(channels)), map_(std::move(map)) {
    for (const std::string& channel : channels_)
        if (const std::string layer = layer_of(channel); !contains(layers_, layer)) layers_.push_back(layer);
    names buffers;
    for (const guide_entry& g : known_guides())
        for (const char* what : {"", ".halfA", ".halfB", ".variance", ".covariance"}) buffers.push_back(g.name + what);
    for (const auto& [buffer, layer] : map_)
        if (!contains(buffers, buffer))
            winnow::fail("--map " + buffer + "=" + layer + ": there is no buffer " + buffer +
                         programs::did_you_mean(buffer, buffers));
}

std::optional<file_layer> layer_finder::with_channels(const std::string& layer, int channels) const {
    static const std::vector<names> triples = {{"R", "G", "B"}, {"X", "Y", "Z"}, {"r", "g", "b"}, {"x", "y", "z"}};
    static const names singles = {"Z", "Y", "V", "R", "X", "z", "y", "v", "r", "x"};
    file_layer found{layer, {}};
    static const std::vector<names> pairs = {{"XX", "XY", "XZ", "YY", "YZ", "ZZ"}};
    if (channels > 1) {
        for (const names& letters : channels == 3 ? triples : pairs) {
            found.channels.clear();
            for (const std::string& c : letters)
                if (const std::string name = joined_name(layer, c); contains(channels_, name))
                    found.channels.push_back(name);
            if (found.channels.size() == letters.size()) return found;
        }
    } else {
        for (const std::string& c : singles)
            if (const std::string name = layer + "." + c; contains(channels_, name)) return file_layer{layer, {name}};
    }
    return {};
}

std::optional<file_layer> layer_finder::find(const std::string& layer, int channels, bool exact) const {
    std::vector<file_layer> found;
    if (channels == 1)
        for (const std::string& channel : channels_)
            if (is_called(channel, layer, exact) && !with_channels(layer_of(channel), 3))  // not a part of a vector
                found.push_back({channel, {channel}});
    for (const std::string& candidate : layers_)
        if (is_called(candidate, layer, exact))
            if (auto whole = with_channels(candidate, channels)) found.push_back(*whole);
    if (found.empty()) return {};
    for (const file_layer& f : found)
        if (f.name == layer) return f;
    // Blender's compositor writes the picture of a view layer once more.
    if (found.size() > 1) std::erase_if(found, [](const auto& f) { return f.name.starts_with("Composite."); });
    if (found.size() > 1)
        winnow::fail(file_ + ": " + found[0].name + " and " + found[1].name + " are both called " + layer +
                     "; choose with --map");
    return found[0];
}

std::optional<file_layer> layer_finder::mapped(const std::string& buffer, int channels) const {
    for (const auto& [name, layer] : map_) {
        if (name != buffer) continue;
        if (auto found = find(layer, channels, true)) return found;
        if (contains(layers_, layer) || contains(channels_, layer))
            winnow::fail(file_ + ": --map " + name + "=" + layer + ": " + name + " needs " + std::to_string(channels) +
                         (channels == 1 ? " channel" : " channels"));
        names there = layers_;
        there.insert(there.end(), channels_.begin(), channels_.end());
        winnow::fail(file_ + ": --map " + name + "=" + layer + ": there is no such layer" +
                     programs::did_you_mean(layer, there));
    }
    return {};
}

std::optional<file_layer> layer_finder::guide(const guide_entry& g) const {
    if (auto found = mapped(g.name, g.channels)) return found;
    for (const std::string& alias : g.aliases)
        if (auto found = find(alias, g.channels, false)) return found;
    return {};
}

std::optional<file_layer> layer_finder::companion(const guide_entry& g, const std::string& what) const {
    const int channels = what == "covariance" ? g.channels * (g.channels + 1) / 2 : g.channels;
    if (auto found = mapped(g.name + "." + what, channels)) return found;
    const auto main = guide(g);
    names candidates = {joined_name(main ? layer_of(main->channels[0]) : "", what), g.name + "." + what};
    // The colour's may stand in a view layer, but "albedo.variance" is not the colour's.
    if (g.name == "color")
        for (const std::string& layer : layers_)
            if (is_called(layer, what, false) && !is_feature(component_of(layer_of(layer))))
                candidates.push_back(layer);
    for (const std::string& name : candidates)
        if (auto found = find(name, channels, true)) return found;
    return {};
}

file_layer layer_finder::further(const std::string& name) const {
    names matching;
    for (const std::string& layer : layers_)
        if (!layer.empty() && is_called(layer, name, false)) matching.push_back(layer);
    if (matching.size() > 1 && !contains(matching, name))
        winnow::fail(file_ + ": " + matching[0] + " and " + matching[1] + " are both called " + name);
    if (!matching.empty()) {
        file_layer all{contains(matching, name) ? name : matching[0], {}};
        for (const std::string& channel : channels_)
            if (layer_of(channel) == all.name) all.channels.push_back(channel);
        // Files list B before G before R.
        const auto rgb = with_channels(all.name, 3);
        return rgb && all.channels.size() == 3 ? *rgb : all;
    }
    if (contains(channels_, name)) return {name, {name}};
    winnow::fail(file_ + ": there is no layer " + name + programs::did_you_mean(name, layers_));
}

std::vector<file_layer> layer_finder::all_further() const {
    names taken;
    for (const guide_entry& g : known_guides()) {
        for (const std::string& layer : layers_)
            for (const std::string& alias : g.aliases)
                if (is_called(layer, alias, false)) taken.push_back(layer);
        if (const auto main = guide(g)) taken.push_back(main->name);
    }
    std::vector<file_layer> found;
    for (const std::string& layer : layers_) {
        const std::string last = component_of(layer);
        if (contains(taken, layer) || last == "halfA" || last == "halfB" || last == "variance" || last == "covariance")
            continue;
        if (auto rgb = with_channels(layer, 3); rgb && component_of(rgb->channels[0]) == "R") found.push_back(*rgb);
    }
    return found;
}

std::optional<std::string> layer_finder::alpha() const {
    const auto color = guide(known_guides()[0]);
    const std::string name = joined_name(color ? color->name : "", "A");
    return contains(channels_, name) ? std::optional(name) : std::nullopt;
}

std::string layer_finder::listing() const {
    std::string all;
    for (const std::string& layer : layers_) {
        if (!layer.empty()) {
            all += (all.empty() ? "" : ", ") + layer;
            continue;
        }
        for (const std::string& channel : channels_)
            if (layer_of(channel).empty()) all += (all.empty() ? "" : ", ") + channel;
    }
    return all.empty() ? "none" : all;
}

}  // namespace denoise
