// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Compile-time lists of buffers: which ones a policy reads, and where an executor puts their planes.
#include <type_traits>
#include <winnow/frame/guide.hpp>

namespace winnow {

/// What a policy reads:  `using reads = planes<color_t, variance_of<color_t>>;`.
template <guide... G>
struct planes {
    static constexpr int count = (0 + ... + G::channels);

    template <class F>
    static constexpr void for_each([[maybe_unused]] F f) {
        (f(G{}), ...);
    }
};

template <class G, class List>
inline constexpr bool contains = false;
template <class G, class... In>
inline constexpr bool contains<G, planes<In...>> = (std::is_same_v<G, In> || ...);

namespace detail {
template <class Done, class... Lists>
struct join {
    using type = Done;
};
template <class... Done, class G, class... More, class... Lists>
struct join<planes<Done...>, planes<G, More...>, Lists...> {
    using grown = std::conditional_t<contains<G, planes<Done...>>, planes<Done...>, planes<Done..., G>>;
    using type = typename join<grown, planes<More...>, Lists...>::type;
};
template <class... Done, class... Lists>
struct join<planes<Done...>, planes<>, Lists...> : join<planes<Done...>, Lists...> {};
}  // namespace detail

/// The union of several lists, in order of first mention.
template <class... Lists>
using joined = typename detail::join<planes<>, Lists...>::type;

/// The index of the first plane of G in the list.
template <class G, class... In>
constexpr int slot_of(planes<In...>) {
    int slot = 0;
    bool found = false;
    ((found = found || std::is_same_v<G, In>, slot += found ? 0 : In::channels), ...);
    return slot;
}

}  // namespace winnow
