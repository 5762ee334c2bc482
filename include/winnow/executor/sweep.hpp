// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What an executor is asked to do: weights over one window, and the layers that they are applied to.
#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>
#include <winnow/core/expression.hpp>
#include <winnow/frame/planes.hpp>
#include <winnow/image/border.hpp>
#include <winnow/image/plane.hpp>

namespace winnow {

/// Several filters over one window, run together so that what they share is worked out once.
template <class Window, class Estimator, class... Weights>
struct sweep {
    using reads = joined<typename Weights::reads..., typename Estimator::reads>;
    static constexpr int count = sizeof...(Weights);

    Window window;
    Estimator estimator;
    border rule = border::clip;
    std::tuple<Weights...> weights;
};

/// The planes of one frame.
struct frame_planes {
    std::vector<source> guides;  ///< one a plane of `reads`; empty where the executor derives the plane
    std::vector<source> values;  ///< the planes to filter: colour, its halves, further layers, as far as asked for

    void clear() {
        guides.clear();
        values.clear();
    }
};

/// The memory of one sweep, type-erased; filled by the filter, used again from run to run.
struct sweep_buffers : frame_planes {
    extent size;
    std::vector<frame_planes> others;  ///< frames around, of a window over several
    int frames = 1;                    ///< how many there are, with this one
    int channels = 0;                  ///< of colour
    bool mean = false;                 ///< whether the values begin with the colour
    bool halves = false;               ///< whether its halves come next
    std::vector<target> results;       ///< [weight][value]; empty where nobody asked for it, as are the following
    std::vector<target> errors;        ///< [weight][channel of colour]
    std::vector<target> derivatives;   ///< [weight][channel of colour]
    std::vector<target> supports;      ///< [weight]
};

namespace detail {
/// How far beyond p and q an expression looks: a patch within a patch, as far as both together.
template <class Node>
int reach_of(const Node& node) {
    int reach = 0;
    if constexpr (composite<Node>)
        node.decompose(
            [&](const auto&, const auto&... operands) { ((reach = std::max(reach, reach_of(operands))), ...); });
    if constexpr (requires { node.reach(); }) reach += node.reach();
    return reach;
}

template <class G>
inline constexpr bool is_gradient = false;
template <class G>
inline constexpr bool is_gradient<gradient_of<G>> = true;
template <class G>
inline constexpr bool is_variance = false;
template <class G>
inline constexpr bool is_variance<variance_of<G>> = true;

template <class... G>
constexpr bool any_gradient(planes<G...>) {
    return (is_gradient<G> || ...);
}

/// The buffer with respect to which an estimator needs the derivative of the filter; void where it needs none.
template <class Estimator>
struct varied_by {
    using type = void;
};
template <class Estimator>
requires(Estimator::needs_derivative) struct varied_by<Estimator> {
    using type = typename Estimator::varies;
};

/// Whether an expression changes with buffer G.
template <class Node, class G>
inline constexpr bool varies_with = contains<G, typename Node::reads>;
template <class Node>
inline constexpr bool varies_with<Node, void> = false;

/// The number of an estimator's own sums over the neighbours.
template <class Estimator>
inline constexpr int sums_of = 0;
template <class Estimator>
requires(Estimator::sums > 0) inline constexpr int sums_of<Estimator> = Estimator::sums;

template <class G>
inline constexpr int channels_of = G::channels;
template <>
inline constexpr int channels_of<void> = 0;
}  // namespace detail

/// The buffer with respect to which a sweep needs derivatives, or void.
template <class Sweep>
using varied_in = typename detail::varied_by<decltype(Sweep::estimator)>::type;

/// The number of sums that its estimator has of its own.
template <class Sweep>
inline constexpr int sums_in = detail::sums_of<std::remove_const_t<decltype(Sweep::estimator)>>;

/// The window's reach and half width as far as an image of this size can feel them: clipped offsets add nothing.
template <class Sweep>
int window_reach(const Sweep& s, extent size) {
    return s.rule == border::clip ? std::min(s.window.reach(), std::max(size.width, size.height)) : s.window.reach();
}
template <class Sweep>
int window_half_width(const Sweep& s, extent size, int dy) {
    const int half = s.window.half_width(dy);
    return s.rule == border::clip ? std::min(half, std::max(size.width, size.height)) : half;
}

/// How far apart its offsets are.
template <class Sweep>
int window_step(const Sweep& s) {
    if constexpr (requires { s.window.step(); }) return s.window.step();
    else return 1;
}

/// The offsets of the window in one row: first, first + step, ..., as many as `count`.
struct window_row {
    int first, count, step;
};
template <class Sweep>
window_row row_of_window(const Sweep& s, extent size, int dy) {
    const int step = window_step(s), half = dy % step == 0 ? window_half_width(s, size, dy) : -1;
    return half < 0 ? window_row{0, 0, step} : window_row{-(half / step) * step, 2 * (half / step) + 1, step};
}

/// How far beyond a pixel its weights look, besides the window.
template <class Window, class Estimator, class... Weights>
int weight_reach(const sweep<Window, Estimator, Weights...>& s) {
    const int patches = std::apply([](const auto&... w) { return std::max({detail::reach_of(w)...}); }, s.weights);
    return patches + (detail::any_gradient(typename sweep<Window, Estimator, Weights...>::reads{}) ? 1 : 0);
}

/// The pixels around a tile that have to be staged with it.
template <class Sweep>
int margin(const Sweep& s, extent size) {
    return window_reach(s, size) + weight_reach(s);
}

/// How far from a pixel its result can depend on the input: filtering a crop that is larger by this on every side gives
/// the same bits inside.  One more pixel than the planes need, because a bad pixel is mended from its neighbours.
template <class Window, class Estimator, class... Weights>
int halo(const sweep<Window, Estimator, Weights...>& s) {
    return s.window.reach() + weight_reach(s) + 1;
}

}  // namespace winnow
