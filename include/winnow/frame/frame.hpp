// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A frame: the renderer's buffers under their names, without a copy.
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <winnow/core/error.hpp>
#include <winnow/frame/planes.hpp>

namespace winnow {

/// Buffers known when the program is compiled:  frame{color = rgb, albedo = texture, variance(color) = noise}.
/// A filter that reads a buffer which is not in the list does not compile.
template <class... G>
class frame {
public:
    frame(bound<G>... layers) : layers_(layers...) {}

    template <guide H>
    static constexpr bool has(H) {
        return (std::is_same_v<H, G> || ...);
    }
    static constexpr bool has(planes<>) { return true; }
    template <guide H>
    source find(H) const {
        if constexpr (has(H{})) return std::get<bound<H>>(layers_).layer;
        else return {};
    }

private:
    std::tuple<bound<G>...> layers_;
};
template <class... G>
frame(bound<G>...) -> frame<G...>;

/// Buffers known only when the program runs, from a file for instance.  A filter that reads one which is not there
/// throws invalid_input and names it.
class named_layers {
public:
    /// Binds a name, as guides spell it ("albedo", "color.variance"); a name bound before is bound anew.
    void bind(const std::string& name, source layer) {
        for (auto& known : layers_)
            if (known.first == name) {
                known.second = layer;
                return;
            }
        layers_.emplace_back(name, layer);
    }

    template <guide H>
    static constexpr bool has(H) {
        return true;
    }
    template <guide H>
    source find(H) const {
        static const std::string name = H::name();
        return find(name);
    }
    source find(const std::string& name) const {
        for (const auto& known : layers_)
            if (known.first == name) return known.second;
        return {};
    }

private:
    std::vector<std::pair<std::string, source>> layers_;
};

/// The same frame, of which G is filtered in place of the colour.
template <guide G, class Frame>
struct filtering_frame {
    const Frame& in;

    template <guide H>
    static constexpr bool has(H) {
        return Frame::has(H{});
    }
    template <guide H>
    source find(H) const {
        return in.find(H{});
    }
    G filtered() const { return {}; }
};
/// `in` must outlive it.
template <guide G, class Frame>
constexpr filtering_frame<G, Frame> filtering(G, const Frame& in) {
    return {in};
}

/// A frame of an animation with those around it, all of one type and size.  A filter whose window spans several frames
/// (window::space_time) asks for neighbours in them too; to all others it is the current frame.
template <class Frame>
struct frame_sequence {
    const Frame& current;
    std::span<const Frame> before;  ///< the nearest first
    std::span<const Frame> after;   ///< likewise

    template <guide H>
    static constexpr bool has(H) {
        return Frame::has(H{});
    }
    template <guide H>
    source find(H) const {
        return current.find(H{});
    }
    /// f(frame) for each frame but the current one, up to `count` on either side.
    template <class F>
    void for_each_other(int count, const F& f) const {
        for (const auto& side : {before, after})
            for (std::size_t i = 0; i < side.size() && i < static_cast<std::size_t>(count); ++i) f(side[i]);
    }
};

template <class Frame>
inline constexpr bool is_frame_sequence = false;
template <class Frame>
inline constexpr bool is_frame_sequence<frame_sequence<Frame>> = true;

/// The frame with one half of the samples as what is filtered and the other half as what guides:
/// `color` is Guide<color>, its variance that of Guide<color>, and the filter is applied to Value<color>.
template <class Frame, template <class> class Guide, template <class> class Value>
struct crossed_frame {
    const Frame& in;

    template <guide H>
    static constexpr bool has(H) {
        return Frame::has(substitute(H{}));
    }
    template <guide H>
    source find(H) const {
        return in.find(substitute(H{}));
    }
    auto filtered() const { return Value<color_t>{}; }

    template <guide H>
    static constexpr auto substitute(H) {
        if constexpr (std::is_same_v<H, color_t>) return Guide<color_t>{};
        else if constexpr (std::is_same_v<H, variance_of<color_t>>) return variance_of<Guide<color_t>>{};
        else return H{};
    }
};

}  // namespace winnow
