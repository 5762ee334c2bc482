// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// Bad input: one message, before any work, that names the buffer and the sizes.
#include <string>
#include <vector>
#include <winnow/filter/bind.hpp>
#include "support/catch.hpp"
#include "support/filters.hpp"
#include "winnow/distance/spatial.hpp"
#include "winnow/distance/squared_difference.hpp"
#include "winnow/estimator/residual_variance.hpp"
#include "winnow/estimator/sure.hpp"
#include "winnow/filter/filter.hpp"
#include "winnow/weight/gaussian.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr extent size{12, 8};

/// What f complains about; empty if it does not.
template <class F>
std::string complaint(const F& f) {
    try {
        f();
    } catch (const invalid_input& e) {
        return e.what();
    }
    return "";
}

std::string complaint(const any_filter& f, const named_layers& in, const output& out) {
    return complaint([&] { f(in, out, {executor_kind::simd}); });
}

bool contains_all(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
        if (text.find(part) == std::string::npos) return false;
    return !text.empty();
}

struct fixture {
    buffers in = make_buffers(size);
    named_layers layers = in.layers();
    image<> result = fill(size, 3, [](int, int, int) { return -7.0f; });
    image<> other{size, 3};

    bool untouched() const {
        return other_bits(result, fill(size, 3, [](int, int, int) { return -7.0f; })) == "";
    }
};

}  // namespace

TEST_CASE_METHOD(fixture, "a missing buffer is named") {
    named_layers some;
    some.bind("color", in.color.view());
    some.bind("albedo", in.albedo.view());
    CHECK(contains_all(complaint(joint_bilateral(), some, result), {"needs normal"}));
    CHECK(contains_all(complaint(nlm(), some, result), {"needs color.variance"}));
    CHECK(contains_all(complaint(nlm_dual_buffer(), some, result), {"needs color.halfA"}));
    CHECK(contains_all(complaint(nlm(), named_layers{}, result), {"needs color"}));
    CHECK(untouched());
    CHECK(complaint(bilateral(), some, result) == "");
}

TEST_CASE_METHOD(fixture, "buffers that differ in size are named with both sizes") {
    const image<> small({11, 8}, 3), tall({12, 9}, 3), one({12, 9}, 1);
    layers.bind("albedo", small.view());
    CHECK(contains_all(complaint(joint_bilateral(), layers, result), {"albedo is 11x8", "color is 12x8"}));
    layers.bind("color.variance", tall.view());
    CHECK(contains_all(complaint(nlm(), layers, result), {"color.variance is 12x9", "color is 12x8"}));
    layers.bind("color.halfB", tall.view());
    CHECK(contains_all(complaint(nlm_dual_buffer(), layers, result), {"color.halfB is 12x9", "color.halfA is 12x8"}));
    CHECK(contains_all(complaint(bilateral(), layers, output{result}.halves(other.view(), {})),
                       {"color.halfB is 12x9", "color is 12x8"}));
    CHECK(
        contains_all(complaint(bilateral(), layers, output{result}.layer(one.view(), {})), {"12x9", "color is 12x8"}));
    CHECK(untouched());
}

TEST_CASE_METHOD(fixture, "buffers with other channels than their guide are named with both numbers") {
    layers.bind("albedo", in.depth.view());
    CHECK(contains_all(complaint(joint_bilateral(), layers, result), {"albedo has 1 channels", "needs 3"}));
    const image<> with_alpha(size, 4);
    layers.bind("albedo", with_alpha.view());
    CHECK(contains_all(complaint(joint_bilateral(), layers, result), {"albedo has 4 channels", "needs 3"}));
    layers.bind("color", in.depth.view());
    CHECK(contains_all(complaint(bilateral(), layers, result), {"color has 1 channels", "needs 3"}));
    CHECK(untouched());
}

TEST_CASE_METHOD(fixture, "an empty image is refused") {
    for (const extent none : {extent{0, 0}, extent{0, 8}, extent{12, 0}}) {
        const buffers empty = make_buffers(none);
        // An empty vector has no memory; a renderer's empty buffer may have.
        float somewhere = 0;
        named_layers all;
        buffers::each(empty, [&](const char* name, const image<>& i) {
            all.bind(name, source(planar(&somewhere, none, i.channels())));
        });
        const output out{planar(&somewhere, none, 3)};
        const std::string sizes = to_string(none);
        CHECK(contains_all(complaint(bilateral(), all, out), {"color is " + sizes}));
        CHECK(contains_all(complaint(nlm_dual_buffer(), all, out), {"color.half", sizes}));
    }
}

TEST_CASE_METHOD(fixture, "results of another size or number of channels are refused by name") {
    image<> small({11, 8}, 3), grey(size, 1);
    for (const any_filter& f : {nlm_with_error(), nlm_dual_buffer()}) {
        INFO(f.name);
        const auto refused = [&](const output& out, const std::string& name) {
            return contains_all(complaint(f, layers, out), {name, "12x8"}) ||
                   contains_all(complaint(f, layers, out), {name, "1 channels", "needs 3"});
        };
        CHECK(refused(output{small}, "the output is 11x8"));
        CHECK(refused(output{grey}, "the output has"));
        CHECK(refused(output{result}.halves(small.view(), other.view()), "first half is 11x8"));
        CHECK(refused(output{result}.halves(other.view(), small.view()), "second half is 11x8"));
        CHECK(refused(output{result}.halves(other.view(), grey.view()), "second half has"));
        CHECK(refused(output{result}.error(small.view()), "the error is 11x8"));
        CHECK(refused(output{result}.layer(in.albedo.view(), small.view()), "further layer is 11x8"));
        CHECK(refused(output{result}.layer(in.albedo.view(), grey.view()), "further layer has"));
        CHECK(untouched());
    }
}

TEST_CASE_METHOD(fixture, "an error image without an estimator is refused, and the way out told") {
    CHECK(contains_all(complaint(nlm(), layers, output{result}.error(other.view())),
                       {"no estimator", "filter.with(estimator::residual_variance{})"}));
    CHECK(untouched());
}

TEST_CASE_METHOD(fixture, "halves without half buffers are refused, and the way out told") {
    named_layers without;
    for (const char* name : {"color", "color.variance"}) without.bind(name, layers.find(std::string(name)));
    CHECK(contains_all(complaint(nlm(), without, output{result}.halves(other.view(), {})),
                       {"no color.halfA", "render the frame twice"}));
    CHECK(contains_all(complaint(nlm_with_error(), without, output{result}.error(other.view())), {"no color.halfA"}));
    without.bind("color.halfA", in.half_a.view());
    CHECK(contains_all(complaint(nlm(), without, output{result}.halves(other.view(), {})), {"no color.halfB"}));
    CHECK(untouched());
    CHECK(complaint(nlm_with_error(), without, result) == "");  // nobody asks for the error
}

TEST_CASE_METHOD(fixture, "a result over any input of the filter is refused") {
    const auto refused = [&](const output& out) {
        return contains_all(complaint(rdfc_candidate(), layers, out), {"overlaps the input"});
    };
    CHECK(refused(in.color.view()));
    CHECK(refused(in.color_variance.view()));
    CHECK(refused(in.normal.view()));
    CHECK(refused(output{result}.halves(in.color.view(), {})));
    CHECK(refused(output{result}.halves(in.half_b.view(), {})));
    CHECK(refused(output{result}.layer(other.view(), other.view())));
    CHECK(refused(output{result}.layer(other.view(), in.albedo.view())));
    CHECK(untouched());
    CHECK(complaint(bilateral(), layers, in.normal.view()) == "");  // it does not read normals
}

TEST_CASE("a result that meets an input in part is refused, one beside it is not") {
    std::vector<float> memory(4 * 3 * 12 * 8);
    const image_view<float> first = planar(memory.data(), size, 3);
    named_layers in;
    in.bind("color", first);
    const std::ptrdiff_t values = 12 * 8;
    const auto at = [&](std::ptrdiff_t offset) { return output{planar(memory.data() + offset, size, 3)}; };
    CHECK(contains_all(complaint(bilateral(), in, at(3 * values - 1)), {"overlaps"}));
    CHECK(contains_all(complaint(bilateral(), in, at(12)), {"overlaps"}));
    CHECK(complaint(bilateral(), in, at(3 * values)) == "");
}

TEST_CASE("a result may lie in the pixels of the renderer's own struct, beside the input") {
    struct pixel {
        float color[3];
        half alpha, padding;
        float result[3];
    };
    const buffers in = make_buffers(size);
    std::vector<pixel> film(12 * 8);
    const auto member = [&](auto* p) {
        return interleaved(p, size, 3, sizeof(pixel), static_cast<std::ptrdiff_t>(sizeof(pixel)) * size.width);
    };
    const image_view<float> noisy = member(film[0].color), clean = member(film[0].result);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 12; ++x) noisy.at(x, y, c) = in.color.at(x, y, c);
    named_layers layers;
    layers.bind("color", noisy);
    const image<> expected = bilateral().images(in.layers(), size, {executor_kind::simd})[0];
    CHECK(complaint(bilateral(), layers, clean) == "");
    CHECK(other_bits(clean, expected) == "");
    CHECK(other_bits(noisy, in.color) == "");
    // One float further on it would begin with the input's last channel.
    CHECK(contains_all(complaint(bilateral(), layers, member(film[0].color + 2)), {"overlaps"}));
    CHECK(contains_all(complaint(bilateral(), layers, member(film[0].color + 1)), {"overlaps"}));
}

TEST_CASE("a result that shares half a value with an input in the same pixels is refused") {
    // Pixels of 24 bytes: the input in half from byte 14 on, the result in float up to byte 12, or 16.
    alignas(4) static std::byte film[24 * 12 * 8 + 8] = {};
    const strides input_step{2, 24, 24 * 12}, result_step{4, 24, 24 * 12};
    const image_view<half> noisy{reinterpret_cast<half*>(film + 14), size, 3, input_step};
    named_layers layers;
    layers.bind("color", noisy);
    const auto result_at = [&](int byte) {
        return output{image_view<float>{reinterpret_cast<float*>(film + byte), size, 3, result_step}};
    };
    CHECK(complaint(bilateral(), layers, result_at(0)) == "");
    CHECK(contains_all(complaint(bilateral(), layers, result_at(4)), {"overlaps"}));
}

TEST_CASE_METHOD(fixture, "numbers out of range are refused before any work") {
    CHECK(contains_all(complaint(nlm({.radius = -1}), layers, result), {"radius is -1"}));
    CHECK(contains_all(complaint(nlm({.patch_radius = -2}), layers, result), {"patch", "radius is -2"}));
    CHECK(contains_all(complaint(test::disk({.radius = -3}), layers, result), {"radius is -3"}));
    CHECK(untouched());
}

TEST_CASE_METHOD(fixture, "after a refusal the workspace is as good as new") {
    workspace memory;
    const output good{result}, bad{in.color.view()};
    CHECK_THROWS_AS(nlm().run(layers, std::span(&bad, 1), {executor_kind::simd}, memory), invalid_input);
    nlm().run(layers, std::span(&good, 1), {executor_kind::simd}, memory);
    CHECK(other_bits(result, nlm().images(layers, size, {executor_kind::simd})[0]) == "");
}

namespace {
const filter by_color{gaussian(l2(color), 0.3f), window::square{.radius = 1}};
const auto with_sure = by_color.with(estimator::sure{});
const filter blur{gaussian(spatial, 1.0f), window::square{.radius = 1}};
}  // namespace

TEST_CASE_METHOD(fixture, "a derivative from an estimator that has none is refused, and the way out told") {
    const auto refused = [&](const auto& f) {
        return contains_all(complaint([&] { f(layers, output{result}.derivative(other.view())); }),
                            {"a derivative is asked for", "filter.with(estimator::sure{})"});
    };
    CHECK(refused(by_color));
    CHECK(refused(by_color.with(estimator::residual_variance{})));
    CHECK(untouched());
    CHECK(complaint([&] { with_sure(layers, output{result}.derivative(other.view())); }) == "");
}

TEST_CASE_METHOD(fixture, "a derivative or a sum of weights of another size or number of channels is refused by name") {
    image<> small({11, 8}, 3), grey(size, 1), small_grey({11, 8}, 1);
    const auto with = [&](const output& out) { return complaint([&] { with_sure(layers, out); }); };
    CHECK(contains_all(with(output{result}.derivative(small.view())),
                       {"the output of the derivative is 11x8", "color is 12x8"}));
    CHECK(contains_all(with(output{result}.derivative(grey.view())),
                       {"the output of the derivative has 1 channels, it needs 3"}));
    CHECK(contains_all(with(output{result}.support(small_grey.view())),
                       {"the output of the sum of weights is 11x8", "color is 12x8"}));
    CHECK(contains_all(with(output{result}.support(other.view())),
                       {"the output of the sum of weights has 3 channels, it needs 1"}));
    CHECK(contains_all(with(output{result}.derivative(in.color.view())), {"derivative overlaps the input"}));
    CHECK(contains_all(with(output{result}.support(in.color_variance.view().channel(1))),
                       {"sum of weights overlaps the input"}));
    CHECK(untouched());
    CHECK(with(output{result}.derivative(other.view()).support(grey.view())) == "");
    // The sum of weights needs no estimator.
    CHECK(complaint([&] { by_color(layers, output{}.support(grey.view())); }) == "");
    CHECK(grey.at(5, 5) > 1);
}

TEST_CASE_METHOD(fixture, "Stein's estimate needs the variance of what is filtered") {
    named_layers without;
    without.bind("color", in.color.view());
    CHECK(contains_all(complaint([&] { with_sure(without, output{result}.error(other.view())); }),
                       {"needs color.variance"}));
    CHECK(untouched());
}

TEST_CASE_METHOD(fixture, "layers alone need no frame where the weights read nothing") {
    image<> support(size), grey(size), of_other({11, 8}, 3);
    const image<> smaller({11, 8}, 3);
    CHECK(complaint([&] {
              blur(frame{}, output{}
                                .layer(in.color.view(), other.view())
                                .layer(in.depth.view(), grey.view())
                                .support(support.view()));
          }) == "");
    image<> expected(size, 3), expected_support(size);
    blur(layers, output{expected}.support(expected_support.view()));
    CHECK(other_bits(other, expected) == "");
    CHECK(other_bits(support, expected_support) == "");

    // Who asks for the colour needs one, and so does who asks for nothing.
    const auto refused = [&](const output& out) { return complaint([&] { blur(frame{}, out); }); };
    CHECK(contains_all(refused(result), {"needs color"}));
    CHECK(contains_all(refused(output{result}.layer(in.color.view(), other.view())), {"needs color"}));
    CHECK(contains_all(refused(output{}), {"needs color"}));
    CHECK(contains_all(refused(output{}.support(support.view())), {"needs color"}));
    // The layers are as large as the first.
    CHECK(contains_all(refused(output{}.layer(in.depth.view(), grey.view()).layer(smaller.view(), of_other.view())),
                       {"a further layer is 11x8", "12x8"}));
    CHECK(contains_all(refused(output{}.layer(in.depth.view(), of_other.view())), {"further layer is 11x8", "12x8"}));
    float somewhere = 0;
    CHECK(contains_all(refused(output{}.layer(planar(&somewhere, {0, 3}, 1), planar(&somewhere, {0, 3}, 1))),
                       {"0x3", "nothing to filter"}));
    CHECK(untouched());
}
