// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/sample.hpp>

#include <support/catch.hpp>

using namespace winnow;
using some = planes<color_t, depth_t, normal_t>;

static_assert(sizeof(sample<some>) == 4 * some::count);
static_assert(sample<some>::has(depth) && !sample<some>::has(albedo));
static_assert(gives_all<some, planes<normal_t, color_t>> && gives_all<some, some>);
static_assert(!gives_all<some, planes<normal_t, albedo_t>> && !gives_all<planes<>, some>);

TEST_CASE("a sample holds its planes side by side, in the order of the list") {
    sample<some> s;
    CHECK(s.at(normal, 2) == 0);
    s.at(color, 1) = 2;
    s.at(depth) = 4;
    s.at(normal, 2) = 7;
    CHECK(s.values == std::array<float, 7>{0, 2, 0, 4, 0, 0, 7});
}

TEST_CASE("a value is kept where its plane is asked for, in whatever form the renderer has it") {
    sample<some> s;
    const double n[3] = {1, 2, 3};
    s.set(normal = n);
    s.set(depth = 5);
    s.set(color = 0.5);  // grey
    s.set(albedo = n);   // nobody asked
    CHECK(s.values == std::array<float, 7>{0.5f, 0.5f, 0.5f, 5, 1, 2, 3});
}

TEST_CASE("a narrowed sample has fewer planes, in another order") {
    sample<some> s;
    for (int i = 0; i < some::count; ++i) s.values[i] = static_cast<float>(i);
    CHECK(narrowed<planes<normal_t, depth_t>>(s).values == std::array<float, 4>{4, 5, 6, 3});
    CHECK(narrowed<some>(s).values == s.values);
}
