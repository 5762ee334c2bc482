// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Random dimensions: every number that a path can draw has a place of its own, whatever else is drawn.
#include <type_traits>

namespace winnow::simulate {

/// `Count` numbers in [0, 1) that are stratified together.  Slots are fixed: an effect that is not there leaves its
/// slots empty, so that all others draw the same numbers as before.
template <int Slot, int Count, bool AtVertex>
struct dimension {
    static constexpr int slot = Slot;
    static constexpr int count = Count;
    static constexpr bool at_vertex = AtVertex;  ///< drawn anew at every vertex of a path
};

/// Slots of the camera, and of each vertex after it; pairs begin at an even slot.
inline constexpr int slots_per_vertex = 8;

namespace draw {

struct image : dimension<0, 2, false> {};        ///< where in the pixel
struct lens : dimension<2, 2, false> {};         ///< where on the lens
struct time : dimension<4, 1, false> {};         ///< when in the shutter
struct light_choice : dimension<0, 1, true> {};  ///< which light
struct lobe : dimension<1, 1, true> {};          ///< diffuse or specular; reflected or refracted
struct light : dimension<2, 2, true> {};         ///< where on the light
struct direction : dimension<4, 2, true> {};     ///< where to
struct roulette : dimension<6, 1, true> {};      ///< whether the path goes on
struct free_flight : dimension<7, 1, true> {};   ///< how far the medium lets it

}  // namespace draw

/// A compile-time list of dimensions.
template <class... D>
struct dimensions {
    template <class X>
    static constexpr bool contain = (std::is_same_v<X, D> || ...);
};
using all_dimensions = dimensions<draw::image, draw::lens, draw::time, draw::light_choice, draw::lobe, draw::light,
                                  draw::direction, draw::roulette, draw::free_flight>;

}  // namespace winnow::simulate
