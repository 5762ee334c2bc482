// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How executors look into an expression.  A policy made of others has one member,
///     template <class F> constexpr auto decompose(F f) const { return f(make, operands...); }
/// where make(operands...) builds the same policy from other operands.  Everything else follows from it; a policy
/// without it is opaque, which costs speed where it hides a patch, never correctness, as long as it tells how far it
/// looks beyond its two pixels:  `int reach() const`.  Operands are evaluated at the policy's own pair of pixels; a
/// policy that evaluates them at shifted pairs is opaque.
#include <tuple>

namespace winnow {

namespace detail {
struct any_decomposition {
    template <class... Parts>
    constexpr void operator()(const Parts&...) const {}
};
}  // namespace detail

template <class Node>
concept composite = requires(const Node node) {
    node.decompose(detail::any_decomposition{});
};

/// Calls f(node) for every policy of the expression, operands before the policy that they belong to.
template <class Node, class F>
constexpr void visit(const Node& node, const F& f) {
    if constexpr (composite<Node>)
        node.decompose([&](const auto&, const auto&... operands) { (visit(operands, f), ...); });
    f(node);
}

/// The policies for which `Keep<Node>` is true, in the order of `visit`; what they contain is not searched.
template <template <class> class Keep, class Node>
constexpr auto collect(const Node& node) {
    if constexpr (Keep<Node>::value) return std::tuple<Node>(node);
    else if constexpr (composite<Node>)
        return node.decompose(
            [](const auto&, const auto&... operands) { return std::tuple_cat(collect<Keep>(operands)...); });
    else return std::tuple<>();
}

/// The expression with every policy for which `Replace<Node>` is true replaced by replace(node), from left to right.
template <template <class> class Replace, class Node, class F>
constexpr auto rewrite(const Node& node, F& replace) {
    if constexpr (Replace<Node>::value) return replace(node);
    else if constexpr (composite<Node>)
        return node.decompose([&](const auto& make, const auto&... operands) {
            // The braces fix the order from left to right.
            return std::apply(make, std::tuple<decltype(rewrite<Replace>(operands, replace))...>{
                                        rewrite<Replace>(operands, replace)...});
        });
    else return node;
}

}  // namespace winnow
