// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/scattered.hpp>
#include <winnow/frame/frame.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {
const image<> rgb = pattern({4, 3}, 3, 1), texture = pattern({4, 3}, 3, 2), a = pattern({4, 3}, 3, 3),
              b = pattern({4, 3}, 3, 4);
}

TEST_CASE("a frame knows at compile time what it has, and finds it") {
    const frame in{color = rgb.view(), albedo = texture.view(), variance(color) = a.view()};
    using type = decltype(in);
    static_assert(type::has(color) && type::has(albedo) && type::has(variance(color)));
    static_assert(!type::has(depth) && !type::has(variance(albedo)));
    CHECK(in.find(color) == source(rgb.view()));
    CHECK(in.find(albedo) == source(texture.view()));
    CHECK(in.find(variance(color)) == source(a.view()));
    CHECK(!in.find(depth));
}

TEST_CASE("named layers know when the program runs, and a name bound anew is bound anew") {
    named_layers in;
    in.bind("color", rgb.view());
    in.bind("color.variance", a.view());
    in.bind("color", texture.view());
    CHECK(in.find(color) == source(texture.view()));
    CHECK(in.find("color.variance") == source(a.view()));
    CHECK(in.find(variance(color)) == source(a.view()));
    CHECK(!in.find(albedo));
    CHECK(!in.find("colour"));
}

TEST_CASE("a crossed frame is guided by one half and filters the other") {
    const frame in{first_half(color) = a.view(), second_half(color) = b.view(), albedo = texture.view(),
                   variance(second_half(color)) = rgb.view()};
    const crossed_frame<std::remove_const_t<decltype(in)>, half_b, half_a> crossed{in};
    static_assert(decltype(crossed)::has(color) && decltype(crossed)::has(albedo));
    static_assert(decltype(crossed)::has(variance(color)) && !decltype(crossed)::has(depth));
    CHECK(crossed.find(color) == source(b.view()));
    CHECK(crossed.find(variance(color)) == source(rgb.view()));
    CHECK(crossed.find(albedo) == source(texture.view()));
    CHECK(crossed.find(crossed.filtered()) == source(a.view()));
}
