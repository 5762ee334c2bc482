// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <utility>
#include <winnow/filter/dual_buffer.hpp>
#include "support/catch.hpp"
#include "support/filters.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {
constexpr extent size{37, 22};
constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::simd};
}  // namespace

TEST_CASE("with equal halves the dual buffer is the plain filter with the variance of a half") {
    buffers in = make_buffers(size);
    in.half_a = in.half_b = in.color;
    in.half_a_variance = in.half_b_variance = in.color_variance;
    for (const executor_kind kind : kinds)
        CHECK(other_bits(nlm_dual_buffer().images(in.layers(), size, {kind})[0],
                         nlm().images(in.layers(), size, {kind})[0]) == "");
}

TEST_CASE("swapping the halves changes no bit") {
    const buffers in = make_buffers(size);
    buffers swapped = in;
    std::swap(swapped.half_a, swapped.half_b);
    std::swap(swapped.half_a_variance, swapped.half_b_variance);
    for (const executor_kind kind : kinds) {
        const auto f = nlm_dual_buffer();
        image<> a(size, 3), b(size, 3), other_a(size, 3), other_b(size, 3), mean(size, 3), other_mean(size, 3);
        f(in.layers(), output{mean}.halves(a.view(), b.view()), {kind});
        f(swapped.layers(), output{other_mean}.halves(other_a.view(), other_b.view()), {kind});
        CHECK(other_bits(mean, other_mean) == "");
        CHECK(other_bits(a, other_b) == "");
        CHECK(other_bits(b, other_a) == "");
        CHECK(other_bits(a, b) != "");
    }
}

TEST_CASE("the first half is filtered with weights that the second half alone decides") {
    const buffers in = make_buffers(size);
    // Twice the first half, the same second half: the weights for the first half stay, so its result doubles.
    buffers doubled = in;
    doubled.half_a = fill(size, 3, [&](int x, int y, int c) { return 2 * in.half_a.at(x, y, c); });
    for (const executor_kind kind : kinds) {
        image<> mean(size, 3), a(size, 3), b(size, 3), doubled_a(size, 3), other_b(size, 3);
        nlm_dual_buffer()(in.layers(), output{mean}.halves(a.view(), b.view()), {kind});
        nlm_dual_buffer()(doubled.layers(), output{mean}.halves(doubled_a.view(), other_b.view()), {kind});
        const image<> twice = fill(size, 3, [&](int x, int y, int c) { return 2 * a.at(x, y, c); });
        CHECK(other_bits(doubled_a, twice) == "");
        CHECK(other_bits(b, other_b) != "");
    }
}

TEST_CASE("mean, error and further layers of the dual buffer follow from its two filterings") {
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds) {
        image<> mean(size, 3), a(size, 3), b(size, 3), error(size, 3), layer(size, 3), filtered_depth(size, 1);
        nlm_dual_buffer()(in.layers(),
                          output{mean}
                              .halves(a.view(), b.view())
                              .error(error.view())
                              .layer(in.half_a.view(), layer.view())
                              .layer(in.depth.view(), filtered_depth.view()),
                          {kind});
        CHECK(other_bits(
                  mean, fill(size, 3, [&](int x, int y, int c) { return (a.at(x, y, c) + b.at(x, y, c)) / 2; })) == "");
        CHECK(other_bits(error, fill(size, 3, [&](int x, int y, int c) {
                             const float difference = a.at(x, y, c) - b.at(x, y, c);
                             return difference * difference / 4;
                         })) == "");
        // The layer is filtered with the weights of either half; half A as a layer with those of B is a itself.
        buffers a_guides = in;
        a_guides.half_b = in.half_a, a_guides.half_b_variance = in.half_a_variance;
        image<> a_by_a(size, 3);
        nlm_dual_buffer()(a_guides.layers(), output{}.halves(a_by_a.view(), {}), {kind});
        CHECK(other_bits(layer, fill(size, 3, [&](int x, int y, int c) {
                             return (a.at(x, y, c) + a_by_a.at(x, y, c)) / 2;
                         })) == "");
        CHECK(largest_magnitude(filtered_depth) > 0);
        CHECK(other_bits(filtered_depth, in.depth) != "");
    }
}
