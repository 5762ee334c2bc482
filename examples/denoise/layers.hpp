// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Which channels of a renderer's file are which buffer.
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace denoise {

using names = std::vector<std::string>;

/// A buffer that filters know by name, and what renderers call it, the likeliest first.
struct guide_entry {
    std::string name;
    int channels;
    names aliases;  ///< an empty one stands for channels without a layer: R G B
};
const std::vector<guide_entry>& known_guides();

/// Part of a file: its name there, and its channels in the order of the guide.
struct file_layer {
    std::string name;
    names channels;
};

/// Finds buffers in the channels of one file.
class layer_finder {
public:
    /// `map` overrides what a buffer is called: "albedo" -> "DiffCol", "albedo.halfA" -> "a".
    layer_finder(std::string file, names channels, std::vector<std::pair<std::string, std::string>> map);

    /// The layer that holds a guide, under any of its names, with or without a view layer's name in front.
    std::optional<file_layer> guide(const guide_entry& g) const;
    /// What belongs to a guide: `what` is halfA, halfB or variance.
    std::optional<file_layer> companion(const guide_entry& g, const std::string& what) const;
    /// A further layer, by the name that it has in the file, with all its channels; fails where there is none.
    file_layer further(const std::string& name) const;
    /// All layers of red, green and blue that are neither colour nor feature nor companion.
    std::vector<file_layer> all_further() const;
    /// The alpha channel that goes with the colour.
    std::optional<std::string> alpha() const;
    /// What there is, for messages: "R, albedo, normal".
    std::string listing() const;

private:
    std::optional<file_layer> find(const std::string& layer, int channels, bool exact) const;
    std::optional<file_layer> mapped(const std::string& buffer, int channels) const;
    std::optional<file_layer> with_channels(const std::string& layer, int channels) const;

    std::string file_;
    names channels_;
    names layers_;  ///< each once
    std::vector<std::pair<std::string, std::string>> map_;
};

}  // namespace denoise
