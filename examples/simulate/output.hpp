// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What is done with a render.
#include <winnow/io/exr.hpp>

#include "entry.hpp"

namespace simulator {

/// The planes that `wanted(name of the plane)` names, with what made them in the header.
template <class Wanted>
winnow::io::exr_image as_exr(const entry& scene, const job& j, const result& r, const Wanted& wanted) {
    winnow::io::exr_image file(winnow::rectangle{0, 0, j.size.width, j.size.height});
    for (const plane& p : r.planes)
        if (wanted(p.guide))
            for (std::size_t c = 0; c < p.channels.size(); ++c)
                file.set(p.channels[c], winnow::source(p.values.view()).channel(static_cast<int>(c)));
    for (const auto& [name, text] : attributes_of(scene, j)) file.set_attribute(name, text);
    return file;
}

/// The plane of that name; null where the scene does not give it.
const image<float>* find_plane(const result& r, const std::string& guide);
/// The plane of that name, which must be there.
const image<float>& plane_of(const result& r, const std::string& guide);

/// Fails, before anything is allocated, if the machine has not the memory.
void check_memory(const entry& scene, const job& j);

}  // namespace simulator
