// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Which buffers a filter needs, and whether a frame has them.
#include <type_traits>
#include <utility>
#include <winnow/executor/sweep.hpp>
#include <winnow/frame/frame.hpp>

namespace winnow {

namespace detail {

/// What the frame filters: its colour, unless it says otherwise.
template <class Frame>
constexpr auto filtered_guide(const Frame& in) {
    if constexpr (requires { in.filtered(); }) return in.filtered();
    else return color;
}
template <class Frame>
using filtered_of = decltype(filtered_guide(std::declval<const Frame&>()));

/// The first buffer of a list that the frame does not have, or else the first of all.
template <class Frame, class First, class... G>
constexpr auto first_missing(planes<First, G...>) {
    if constexpr (!Frame::has(First{})) return First{};
    else if constexpr ((Frame::has(G{}) && ...)) return First{};
    else return first_missing<Frame>(planes<G...>{});
}

/// Every frame has what an empty list asks for.
template <class Frame>
constexpr planes<> first_missing(planes<>) {
    return {};
}

/// Executors derive gradients from their buffers: no frame has them.
template <class... G>
constexpr auto without_gradients(planes<G...>) {
    return joined<std::conditional_t<is_gradient<G>, planes<>, planes<G>>...>{};
}

}  // namespace detail

/// The frame has buffer G, or learns when it runs whether it has.
template <class Frame, class G>
concept has_layer = Frame::has(G{});

/// The frame has every buffer in the list Reads.
template <class Frame, class Reads>
concept frame_with = has_layer<Frame, decltype(detail::first_missing<Frame>(detail::without_gradients(Reads{})))>;

namespace detail {
/// What a filter that reads these needs of a frame.  Of an empty one nothing, if it reads nothing: it may be applied to
/// further layers alone.
template <class Frame, class Reads>
struct needed {
    using type = joined<planes<filtered_of<Frame>>, Reads>;
};
template <>
struct needed<frame<>, planes<>> {
    using type = planes<>;
};
}  // namespace detail

/// The frame has what is filtered and every buffer in the list Reads.
template <class Frame, class Reads>
concept frame_to_filter = frame_with<Frame, typename detail::needed<Frame, Reads>::type>;

}  // namespace winnow
