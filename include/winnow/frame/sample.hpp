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

namespace detail {
/// The first guide of a list that is not in Given, or else the first of all.
template <class Given, class First, class... G>
constexpr auto first_not_given(planes<First, G...>) {
    if constexpr (!contains<First, Given>) return First{};
    else if constexpr ((contains<G, Given> && ...)) return First{};
    else return first_not_given<Given>(planes<G...>{});
}
}  // namespace detail

/// There is a value for guide G in a list of those given.
template <class Given, class G>
concept gives = contains<G, Given>;

/// There is one for every guide in the list Needed; the error names the first that is missing.
template <class Given, class Needed>
concept gives_all = gives<Given, decltype(detail::first_not_given<Given>(Needed{}))>;

/// Those values of a sample that are in another list; a few moves, in whatever order.
template <class Planes, class P>
requires gives_all<P, Planes> sample<Planes> narrowed(const sample<P>& s) {
    sample<Planes> result;
    Planes::for_each([&]<class G>(G g) {
        for (int c = 0; c < G::channels; ++c) result.at(g, c) = s.at(g, c);
    });
    return result;
}

}  // namespace winnow
