// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Which parts of an expression an executor works out ahead, and what stands in their place: patches, because their
/// sums cost less row by row; distances and shared weights that several weights of a sweep have in common; weights that
/// depend on the offset alone.
#include <array>
#include <winnow/executor/sweep.hpp>
#include <winnow/frame/differential.hpp>

namespace winnow {

/// The offsets (first, dy), (first + step, dy), ..., in this frame or another.
struct offset_group {
    static constexpr int largest = 8;  ///< each takes a register for its weight
    int first, count, step, dy;
    std::ptrdiff_t to_frame = 0;  ///< from the planes of p's frame to those of q's, in floats

    int size() const { return count; }
    int dx(int i) const { return first + i * step; }
    bool other_frame() const { return to_frame != 0; }
    /// Which of them is p itself; -1 for none.
    int centre() const {
        const bool within = !other_frame() && dy == 0 && first <= 0 && dx(count) > 0 && first % step == 0;
        return within ? -first / step : -1;
    }
    /// Where the first q lies.
    const float* q(const float* p, pitch of) const { return p + first + dy * of.row + to_frame; }
};

namespace detail {

/// A policy that says what it averages over a patch: distance::patch, weight::patch_mean.
template <class Node>
concept averages_over_patch = requires {
    typename Node::prepares;
};
template <class Node>
struct is_patch : std::bool_constant<averages_over_patch<Node>> {};

/// A policy that looks at other pairs of pixels than its own, or holds one that does.
template <class Node>
inline constexpr bool looks_around = requires(const Node& node) {
    node.reach();
}
|| std::tuple_size_v<decltype(collect<is_patch>(std::declval<Node>()))> > 0;

/// Stands in the expression where a policy stood; its slopes, if it has any, lie in the places after its value.
template <class Role, bool Slopes>
struct looked_up {
    using role = Role;
    using reads = planes<>;

    int index;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        if constexpr (Slopes) return pq.ahead_with_slopes(index);
        else return pq.ahead(index);
    }
};
template <class Node>
inline constexpr bool is_looked_up = false;
template <class Role, bool Slopes>
inline constexpr bool is_looked_up<looked_up<Role, Slopes>> = true;

template <class Node>
struct found : std::bool_constant<is_looked_up<Node>> {};

/// Stands where a weight stood that depends on the offset alone: its value, and behind it its exponent, if it has one.
/// Exponents of a product are added before they are cut, whoever works them out.
template <bool Exponential>
struct looked_up_by_offset {
    using role = winnow::role::weight;
    using reads = planes<>;

    int index;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return pq.of_offset(2 * index);
    }
    template <class Real, class Planes>
    WINNOW_HD Real exponent(const pixel_pair<Real, Planes>& pq) const requires Exponential {
        return pq.of_offset(2 * index + 1);
    }
};

/// A weight that reads no buffer, and holds nothing that was worked out ahead from one.
template <class Node>
struct depends_on_offset_alone : std::bool_constant<false> {};
template <class Node>
requires(plays<Node, role::weight>&& Node::reads::count == 0 && !looks_around<Node> &&
         std::tuple_size_v<decltype(collect<found>(std::declval<Node>()))> == 0) struct depends_on_offset_alone<Node>
    : std::bool_constant<true> {
};

/// Places that a policy takes: its value, and its slopes where Varied, the buffer of the derivative, is among what it
/// reads.
template <class Node, class Varied>
inline constexpr int places_of = 1 + (varies_with<Node, Varied> ? channels_of<Varied> : 0);

template <class A, class B>
bool same_policy(const A& a, const B& b) {
    if constexpr (std::is_same_v<A, B> && std::equality_comparable<A>) return a == b;
    else return false;
}

/// The policies of several expressions for which Keep holds, none inside another.
template <template <class> class Keep, class... Node>
constexpr auto collect_all(const std::tuple<Node...>& nodes) {
    return std::apply([](const auto&... node) { return std::tuple_cat(collect<Keep>(node)...); }, nodes);
}
/// The expressions with these looked up instead, from place `first` on.
template <template <class> class Keep, class Varied, class... Node>
constexpr auto look_up_all(const std::tuple<Node...>& nodes, int first = 0) {
    const auto replace = [&first]<class Found>(const Found&) {
        const int place = first;
        first += places_of<Found, Varied>;
        return looked_up<typename Found::role, varies_with<Found, Varied>>{place};
    };
    return std::apply(
        [&](const auto&... node) {
            return std::tuple<decltype(rewrite<Keep>(node, replace))...>{rewrite<Keep>(node, replace)...};
        },
        nodes);
}

/// Calls f(node, index) for each node of a tuple, with an index that the compiler knows.
template <class... Node, class F>
WINNOW_HD constexpr void for_each_node(const std::tuple<Node...>& nodes, const F& f) {
    [&]<int... I>(std::integer_sequence<int, I...>) WINNOW_HD_LAMBDA {
        (f(std::get<I>(nodes), std::integral_constant<int, I>{}), ...);
    }
    (std::make_integer_sequence<int, sizeof...(Node)>{});
}

/// The index of the first node that is the same policy as node `index`.
template <class... Node, class N>
int leader(const std::tuple<Node...>& nodes, const N& node, int index) {
    int first = index;
    for_each_node(nodes, [&](const auto& other, int i) {
        if (i < first && same_policy(other, node)) first = i;
    });
    return first;
}

/// A policy that says so itself: weight::shared.
template <class Node>
concept asks_to_be_shared = requires {
    typename Node::shares;
};

/// Distances and shared weights that more than one of these weights contain, and that do not change with the buffer of
/// the derivative.
template <class Varied, class... Weights>
struct repeated {
    template <class Node>
    struct same_as {
        template <class Other>
        struct test : std::is_same<Node, Other> {};
    };
    template <class Node>
    static constexpr std::size_t occurrences =
        (std::tuple_size_v<decltype(collect<same_as<Node>::template test>(std::declval<Weights>()))> + ... + 0);

    template <class Node>
    struct test : std::bool_constant<false> {};
    template <class Node>
    requires((plays<Node, role::distance> || asks_to_be_shared<Node>)&&Node::reads::count > 0 &&
             !varies_with<Node, Varied> &&
             std::tuple_size_v<decltype(collect<found>(std::declval<Node>()))> == 0) struct test<Node>
        : std::bool_constant<(occurrences<Node> > 1)> {
    };
};

}  // namespace detail

/// What the weights of a sweep, with their patches looked up already, have in common: evaluated once a pair of pixels.
template <class Varied, class Weights>
class shared_distances;

template <class Varied, class... Weights>
class shared_distances<Varied, std::tuple<Weights...>> {
    template <class Node>
    using repeated = typename detail::repeated<Varied, Weights...>::template test<Node>;

public:
    /// The values take the places from `first` on.
    shared_distances(const std::tuple<Weights...>& weights, int first)
        : nodes_(detail::collect_all<repeated>(weights)),
          weights_(detail::look_up_all<repeated, Varied>(weights, first)),
          first_(first) {
        // A place for each; those that are the same are read from the first of them.
        detail::for_each_node(nodes_, [&](const auto& node, int i) { leaders_[i] = detail::leader(nodes_, node, i); });
        const auto redirect = [&]<class Role, bool Slopes>(const detail::looked_up<Role, Slopes>& node) {
            const bool shared = !Slopes && node.index >= first_;
            return shared ? detail::looked_up<Role, Slopes>{first_ + leaders_[node.index - first_]} : node;
        };
        weights_ =
            std::apply([&](const auto&... w) { return std::tuple(rewrite<detail::found>(w, redirect)...); }, weights_);
    }

    static constexpr int count =
        std::tuple_size_v<decltype(detail::collect_all<repeated>(std::declval<std::tuple<Weights...>>()))>;

    /// The weights with the shared distances looked up.
    const auto& weights() const { return weights_; }

    /// f(place, distance) for each that has to be evaluated.
    template <class F>
    WINNOW_HD void for_each(const F& f) const {
        detail::for_each_node(nodes_, [&](const auto& node, int i) WINNOW_HD_LAMBDA {
            if (leaders_[i] == i) f(first_ + i, node);
        });
    }

private:
    decltype(detail::collect_all<repeated>(std::declval<std::tuple<Weights...>>())) nodes_;
    decltype(detail::look_up_all<repeated, Varied>(std::declval<std::tuple<Weights...>>())) weights_;
    int first_;
    int leaders_[count + 1] = {};
};

/// The weights that depend on the offset alone, in weights whose patches are looked up already: evaluated once an
/// offset.
template <class Weights>
class offset_weights {
public:
    explicit offset_weights(const Weights& weights)
        : nodes_(detail::collect_all<detail::depends_on_offset_alone>(weights)), weights_(looked_up(weights)) {}

    static constexpr int count =
        std::tuple_size_v<decltype(detail::collect_all<detail::depends_on_offset_alone>(std::declval<Weights>()))>;

    /// The weights with these looked up.
    const auto& weights() const { return weights_; }

    /// [offset][weight]: their values and exponents at each offset of a group, in the arithmetic of these lanes.
    template <class Lanes>
    auto table(const offset_group& offsets) const {
        std::array<std::array<float, 2 * count>, offset_group::largest> values;
        for (int i = 0; i < offsets.size(); ++i) {
            const pixel_pair<Lanes, planes<>> pq(nullptr, nullptr, {}, offsets.dx(i), offsets.dy);
            detail::for_each_node(nodes_, [&](const auto& node, std::size_t k) {
                const auto keep = [&](std::size_t place, const Lanes& value) {
                    float all[Lanes::size];
                    value.store(all);
                    values[static_cast<std::size_t>(i)][place] = all[0];
                };
                keep(2 * k, node(pq));
                if constexpr (requires { node.exponent(pq); }) keep(2 * k + 1, node.exponent(pq));
            });
        }
        return values;
    }

private:
    static auto looked_up(const Weights& weights) {
        int next = 0;
        const auto replace = [&next]<class Node>(const Node&) {
            using pair = pixel_pair<float, planes<>>;
            constexpr bool exponential = requires(const Node& node, const pair& pq) { node.exponent(pq); };
            return detail::looked_up_by_offset<exponential>{next++};
        };
        return std::apply(
            [&](const auto&... w) {
                return std::tuple<decltype(rewrite<detail::depends_on_offset_alone>(w, replace))...>{
                    rewrite<detail::depends_on_offset_alone>(w, replace)...};
            },
            weights);
    }

    decltype(detail::collect_all<detail::depends_on_offset_alone>(std::declval<Weights>())) nodes_;
    decltype(looked_up(std::declval<Weights>())) weights_;
};

}  // namespace winnow
