// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The film that feeds some filters from a scene: what they ask for, as far as the scene's effects can give it.
#include <winnow/frame/film.hpp>
#include <winnow/simulate/effect.hpp>

namespace winnow::simulate {

namespace detail {

/// What a filter uses where it is there:  `using optional = planes<visibility_t, variance_of<visibility_t>>;`.
template <class Filter>
struct optional_of {
    using type = planes<>;
};
template <class Filter>
requires requires { typename Filter::optional; }
struct optional_of<Filter> {
    using type = typename Filter::optional;
};

/// Those planes of a list whose guides are in another.
template <class List, class Given>
struct given_of;
template <class... G, class Given>
struct given_of<planes<G...>, Given> {
    using type = joined<std::conditional_t<gives_all<Given, typename film<planes<G>>::inputs>, planes<G>, planes<>>...>;
};

}  // namespace detail

/// A filter that reads what no effect of the scene can give does not compile, and the error names the guide; optional
/// planes that the scene cannot give are left out.
template <class Scene, class... Filters>
requires gives_all<typename Scene::effects::gives, typename winnow::film_for<Filters...>::inputs>
using film_for = film<joined<
    typename winnow::film_for<Filters...>::planes,
    typename detail::given_of<typename detail::optional_of<Filters>::type, typename Scene::effects::gives>::type...>>;

/// The film of everything that a scene can give: each guide with its variance and its halves, and how the positions in
/// a pixel spread.
template <class... G>
constexpr auto with_statistics(planes<G...>) {
    return joined<planes<G, variance_of<G>, half_a<G>, half_b<G>>...>{};
}
template <class Effects>
using complete_film =
    film<joined<decltype(with_statistics(typename Effects::gives{})), planes<covariance_of<rest_position_t>>>>;

}  // namespace winnow::simulate
