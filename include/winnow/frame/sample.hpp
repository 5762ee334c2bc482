// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// One sample of a pixel: a value for each plane of a list, and nothing else.
#include <array>
#include <winnow/frame/planes.hpp>

namespace winnow {

/// `sample<planes<color_t, depth_t>>` is four floats.  Points of the world are relative to the camera.
template <class Planes>
struct sample {
    using planes = Planes;
    std::array<float, Planes::count> values{};

    template <guide G>
    static constexpr bool has(G) {
        return contains<G, Planes>;
    }
    template <guide G>
    requires contains<G, Planes>
    float& at(G, int c = 0) { return values[slot_of<G>(Planes{}) + c]; }
    template <guide G>
    requires contains<G, Planes>
    float at(G, int c = 0) const { return values[slot_of<G>(Planes{}) + c]; }

    /// Keeps the value if its plane is in the list; what nobody asked for is not kept.
    template <class G, class V>
    void set([[maybe_unused]] const valued<G, V>& value) {
        if constexpr (contains<G, Planes>)
            for (int c = 0; c < G::channels; ++c) at(G{}, c) = static_cast<float>(value[c]);
    }
};

}  // namespace winnow
