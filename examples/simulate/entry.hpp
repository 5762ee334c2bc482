// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A built-in scene as the program sees it: its types erased.
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <winnow/image/image.hpp>
#include <winnow/simulate/random.hpp>
#include <winnow/simulate/render.hpp>

namespace simulator {

using winnow::extent;
using winnow::image;

/// One buffer of a render, under the names that its channels have in a file.
struct plane {
    std::string guide;
    std::vector<std::string> channels;
    image<float> values;
};

/// What to render.
struct job {
    extent size;
    int frame = 0;
    winnow::simulate::render_settings settings;
    int threads = 1;
    std::string deep;  ///< where all samples go, if anywhere
};

struct result {
    std::vector<plane> planes;
    std::int64_t rejected = 0;  ///< samples that were no number
    double seconds = 0;

    /// Keeps a guide's mean, its variance and its halves, in this order.
    void keep(const std::string& guide, std::string_view letters, const std::array<const image<float>*, 4>& images);
};

/// A render that goes on where each of its pixels has stopped.
class growing_render {
public:
    virtual ~growing_render() = default;

    /// So many samples more in each pixel.
    virtual void add(const winnow::sample_counts& more, winnow::simulate::render_progress& progress) = 0;
    /// All planes, of the samples so far; `seconds` are those that `add` has taken.
    virtual result developed() const = 0;
};

/// One scene with all that its effects can give.
class entry {
public:
    virtual ~entry() = default;

    virtual std::string name() const = 0;
    virtual std::string summary() const = 0;
    virtual std::vector<std::string> effects() const = 0;
    virtual std::vector<std::string> guides() const = 0;
    virtual int camera_numbers() const = 0;  ///< random numbers that a path takes at the camera
    virtual int vertex_numbers() const = 0;  ///< and at most at each vertex
    virtual std::size_t sample_bytes() const = 0;
    /// Memory that a render of this size takes at most, with that many samples kept.  Fails for a size that is none.
    virtual std::size_t bytes(extent size, int kept_samples) const = 0;
    /// Of a small picture of the first frame: changes whenever that does.
    virtual std::uint64_t fingerprint() const = 0;
    virtual result render(const job& j, winnow::simulate::render_progress& progress) const = 0;
    /// Without samples yet, of which none are kept; how many each pixel gets is told later.
    virtual std::unique_ptr<growing_render> begin(const job& j) const = 0;
};

/// What a file says about how it was made.
std::vector<std::pair<std::string, std::string>> attributes_of(const entry& scene, const job& j);

/// All scenes, in the order of their names.
const std::vector<std::unique_ptr<entry>>& scenes();
/// Fails for a name that is none.
const entry& find_scene(const std::string& name);

}  // namespace simulator
