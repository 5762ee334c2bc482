// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/frame/output.hpp>
#include <winnow/image/image.hpp>

using namespace winnow;

TEST_CASE("an output holds what was asked for, and nothing else") {
    image<> mean({3, 2}, 3), a({3, 2}, 3), b({3, 2}, 3), error({3, 2}, 3), from({3, 2}, 2), to({3, 2}, 2);
    const output plain{mean};
    CHECK(plain.mean() == target(mean.view()));
    CHECK((!plain.half_a() && !plain.half_b() && !plain.error() && plain.layers().empty()));

    const output all = output{mean.view()}.halves(a.view(), b.view()).error(error.view()).layer(from.view(), to.view());
    CHECK(all.half_a() == target(a.view()));
    CHECK(all.half_b() == target(b.view()));
    CHECK(all.error() == target(error.view()));
    REQUIRE(all.layers().size() == 1);
    CHECK(all.layers()[0].first == source(from.view()));
    CHECK(all.layers()[0].second == target(to.view()));
    CHECK(!output{}.mean());
}

TEST_CASE("an output that starts anew holds the new mean and nothing of the old") {
    image<> mean({3, 2}, 3), other({3, 2}, 3), support({3, 2});
    output out{mean};
    out.halves(other.view(), other.view()).error(other.view()).derivative(other.view()).support(support.view());
    out.layer(mean.view(), other.view());
    CHECK(out.derivative() == target(other.view()));
    CHECK(out.support() == target(support.view()));
    CHECK(out.reset(other.view()).mean() == target(other.view()));
    CHECK((!out.half_a() && !out.half_b() && !out.error() && !out.derivative() && !out.support()));
    CHECK(out.layers().empty());
}

// A result cannot be written to memory that is only read.
static_assert(std::is_convertible_v<image<>&, output> && !std::is_convertible_v<const image<>&, output>);
static_assert(std::is_convertible_v<image_view<half>, output>);
