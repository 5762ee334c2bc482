// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a film must keep of each sample, worked out from the planes that shall come out of it.
#include <winnow/frame/planes.hpp>

namespace winnow::detail {

enum class statistic { mean, variance, covariance };

/// What plane G of a film is: which statistic, of which guide, over all samples (-1) or one half of them (0 or 1).
template <class G, statistic What = statistic::mean, int Half = -1>
struct film_plane {
    using base = G;
    static constexpr statistic what = What;
    static constexpr int half = Half;
};
template <class G>
struct plane_named : film_plane<G> {};
template <class G>
struct plane_named<half_a<G>> : film_plane<G, statistic::mean, 0> {};
template <class G>
struct plane_named<half_b<G>> : film_plane<G, statistic::mean, 1> {};
template <class G>
struct plane_named<variance_of<G>> : film_plane<G, statistic::variance> {};
template <class G>
struct plane_named<variance_of<half_a<G>>> : film_plane<G, statistic::variance, 0> {};
template <class G>
struct plane_named<variance_of<half_b<G>>> : film_plane<G, statistic::variance, 1> {};
template <class G>
struct plane_named<covariance_of<G>> : film_plane<G, statistic::covariance> {};

template <class G>
inline constexpr bool is_sampled = std::is_same_v<typename plane_named<G>::base, G>;

/// Executors derive gradients from the guide itself: nobody keeps them.
template <class G>
struct kept {
    using type = planes<G>;
};
template <class G>
struct kept<gradient_of<G>> {
    using type = planes<>;
};
template <class Planes>
struct kept_planes;
template <class... G>
struct kept_planes<planes<G...>> {
    using type = joined<typename kept<G>::type...>;
};

template <class Planes>
struct film_plan;

/// Five groups of guides; each guide of a sample is in one of them, or in one with halves and in the last.
///     halves and squares | halves | squares | means only | covariance
template <class... G>
struct film_plan<planes<G...>> {
    static_assert((is_sampled<typename plane_named<G>::base> && ...),
                  "a film gives means, their variances, halves, variances of halves, and covariances");

    template <class B>
    static constexpr bool needs(statistic what, bool half) {
        return ((std::is_same_v<B, typename plane_named<G>::base> && plane_named<G>::what == what &&
                 (plane_named<G>::half >= 0) == half) ||
                ...);
    }
    template <class B>
    static constexpr bool has_covariance = needs<B>(statistic::covariance, false);
    template <class B>
    static constexpr bool has_halves = needs<B>(statistic::mean, true) || needs<B>(statistic::variance, true);
    /// The squares of a covariance are on its diagonal.
    template <class B>
    static constexpr bool has_squares = needs<B>(statistic::variance, true) ||
                                        (needs<B>(statistic::variance, false) && !has_covariance<B>);
    template <class B>
    static constexpr int group() {
        if (has_halves<B>) return has_squares<B> ? 0 : 1;
        if (has_covariance<B>) return 4;
        return has_squares<B> ? 2 : 3;
    }
    template <int Group>
    using guides_of = joined<std::conditional_t<group<typename plane_named<G>::base>() == Group,
                                                planes<typename plane_named<G>::base>, planes<>>...>;

    using halved = joined<guides_of<0>, guides_of<1>>;
    using whole = joined<guides_of<2>, guides_of<3>>;
    using spread = joined<std::conditional_t<has_covariance<typename plane_named<G>::base>,
                                             planes<typename plane_named<G>::base>, planes<>>...>;
    /// What every sample must have: first what is halved, then the rest.
    using inputs = joined<halved, whole, spread>;

    static constexpr int halved_squares = guides_of<0>::count;
    static constexpr int whole_squares = guides_of<2>::count;
    static constexpr bool any_halves = halved::count > 0;

    /// Floats of one half: its means, then its squares.  Both halves are followed by the means and squares of the rest.
    static constexpr int half_floats = halved::count + halved_squares;
    static constexpr int floats = 2 * half_floats + whole::count + whole_squares;

    /// Doubles of a guide with covariance: its means, then the upper triangle of its comoments.
    template <class B>
    static constexpr int spread_doubles = B::channels + covariance_of<B>::channels;
    /// Where those of B begin, or, for an empty B, how many there are.
    template <class B, class... S>
    static constexpr int spread_slot(planes<S...>) {
        int slot = 0;
        [[maybe_unused]] bool found = false;
        ((found = found || std::is_same_v<B, S>, slot += found ? 0 : spread_doubles<S>), ...);
        return slot;
    }
    static constexpr int doubles = spread_slot<void>(spread{});
};

}  // namespace winnow::detail
