// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <string>
#include <support/catch.hpp>
#include <type_traits>
#include <winnow/core/expression.hpp>

using namespace winnow;

namespace {

struct leaf {
    int number;
};
template <class A>
struct marked {  // what the tests look for
    A inner;
    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto a) { return marked<decltype(a)>{a}; }, inner);
    }
};
template <class A, class B>
struct both {
    A a;
    B b;
    template <class F>
    constexpr auto decompose(F f) const {
        return f([](auto x, auto y) { return both<decltype(x), decltype(y)>{x, y}; }, a, b);
    }
};
template <class A>
struct opaque {  // holds another policy and does not say so
    A hidden;
};

template <class Node>
struct is_marked : std::false_type {};
template <class A>
struct is_marked<marked<A>> : std::true_type {};
template <class Node>
struct is_leaf : std::is_same<Node, leaf> {};

template <class A>
marked<A> mark(A a) {
    return {a};
}
template <class A, class B>
both<A, B> pair(A a, B b) {
    return {a, b};
}

struct namer {
    std::string& names;
    void operator()(const leaf& l) const { names += std::to_string(l.number); }
    template <class A>
    void operator()(const marked<A>&) const {
        names += 'm';
    }
    template <class A, class B>
    void operator()(const both<A, B>&) const {
        names += 'b';
    }
    template <class A>
    void operator()(const opaque<A>&) const {
        names += 'o';
    }
};

const auto nested = pair(mark(mark(leaf{1})), pair(leaf{2}, pair(mark(leaf{3}), opaque<marked<leaf>>{{{4}}})));

}  // namespace

static_assert(composite<marked<leaf>> && composite<both<leaf, leaf>>);
static_assert(!composite<leaf> && !composite<opaque<marked<leaf>>> && !composite<int>);

TEST_CASE("visit meets operands before what they belong to, from left to right, and nothing that is hidden") {
    std::string names;
    visit(nested, namer{names});
    CHECK(names == "1mm23mobbb");
}

TEST_CASE("collect finds from left to right, and does not search in what it has found") {
    const auto found = collect<is_marked>(nested);
    static_assert(std::is_same_v<decltype(found), const std::tuple<marked<marked<leaf>>, marked<leaf>>>);
    CHECK(std::get<0>(found).inner.inner.number == 1);
    CHECK(std::get<1>(found).inner.number == 3);
    static_assert(std::is_same_v<decltype(collect<is_marked>(leaf{1})), std::tuple<>>);
    static_assert(std::is_same_v<decltype(collect<is_marked>(mark(leaf{1}))), std::tuple<marked<leaf>>>);
}

TEST_CASE("rewrite replaces from left to right, and keeps the rest and its numbers") {
    int next = 10;
    auto replace = [&next](const auto&) { return leaf{next++}; };
    const auto rewritten = rewrite<is_marked>(nested, replace);
    static_assert(std::is_same_v<decltype(rewritten), const both<leaf, both<leaf, both<leaf, opaque<marked<leaf>>>>>>);
    CHECK(rewritten.a.number == 10);
    CHECK(rewritten.b.a.number == 2);
    CHECK(rewritten.b.b.a.number == 11);
    CHECK(rewritten.b.b.b.hidden.inner.number == 4);
}

TEST_CASE("rewrite can change the type of an operand, within the policies around it") {
    auto replace = [](const leaf& l) { return l.number * 0.5; };
    const auto rewritten = rewrite<is_leaf>(mark(pair(leaf{3}, mark(leaf{5}))), replace);
    static_assert(std::is_same_v<decltype(rewritten), const marked<both<double, marked<double>>>>);
    CHECK(rewritten.inner.a == 1.5);
    CHECK(rewritten.inner.b.inner == 2.5);
}
