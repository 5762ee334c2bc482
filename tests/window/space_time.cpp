// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <winnow/executor/simd.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/window/space_time.hpp>
#include <winnow/winnow.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr extent size{19, 7};
using frame_of_color = frame<color_t, variance_of<color_t>>;

/// Six frames, each with its own noise.
struct animation {
    std::vector<buffers> in;
    std::vector<frame_of_color> frames;

    animation() {
        for (int f = 0; f < 6; ++f) {
            buffers b = make_buffers(size);
            for (int c = 0; c < 3; ++c)
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        b.color.at(x, y, c) += 0.1f * static_cast<float>((x * 7 + y * 3 + f * 5 + c) % 11);
            in.push_back(std::move(b));
        }
        for (const buffers& b : in)
            frames.push_back(frame_of_color{color = b.color.view(), variance(color) = b.color_variance.view()});
    }
};

template <class Filter, class Frame, class Executor>
image<> filtered(const Filter& f, const Frame& in, const Executor& executor) {
    image<> out(size, 3);
    f(in, output(out), executor);
    return out;
}

template <class Check>
void on_both(const Check& check) {
    check(executor::serial<double>{});
    check(executor::simd{.tile = {8, 3}});
}

const auto weight_of_color = exponential(patch(noise_normalized(color), {.radius = 1}));

}  // namespace

TEST_CASE("with nothing around it, a frame is filtered as by a square") {
    const animation a;
    const filter several{weight_of_color, window::space_time{.radius = 2, .frames = 3}};
    const filter one{weight_of_color, window::square{.radius = 2}};
    on_both([&](const auto& executor) {
        const image<> expected = filtered(one, a.frames[2], executor);
        CHECK(other_bits(filtered(several, a.frames[2], executor), expected) == "");
        const frame_sequence<frame_of_color> alone{a.frames[2], {}, {}};
        CHECK(other_bits(filtered(several, alone, executor), expected) == "");
        // A window over one frame does not look at the others.
        const frame_sequence<frame_of_color> all{a.frames[2], std::span(a.frames).first(2),
                                                 std::span(a.frames).last(3)};
        CHECK(other_bits(filtered(one, all, executor), expected) == "");
    });
}

TEST_CASE("frames around that are the frame itself change nothing but rounding") {
    const animation a;
    const std::vector<frame_of_color> same(2, a.frames[0]);
    const frame_sequence<frame_of_color> sequence{a.frames[0], same, same};
    const filter several{weight_of_color, window::space_time{.radius = 2, .frames = 2}};
    const filter one{weight_of_color, window::square{.radius = 2}};
    on_both([&](const auto& executor) {
        CHECK(beyond(1e-5, filtered(several, sequence, executor), filtered(one, a.frames[0], executor)) == "");
    });
}

TEST_CASE("every frame within reach counts, by weights from its own colour, and none beyond") {
    const animation a;
    const std::vector<frame_of_color> before{a.frames[2], a.frames[1], a.frames[0]};
    const frame_sequence<frame_of_color> in{a.frames[3], before, std::span(a.frames).last(2)};
    const filter several{gaussian(l2(color), 0.3f), window::space_time{.radius = 1, .frames = 2}};
    // F = sum over frames 1 to 5 and the square of w u / sum w, by hand.
    image<> expected(size, 3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            double sums[3] = {}, total = 0;
            for (int f = 1; f <= 5; ++f)
                for (int j = std::max(0, y - 1); j <= std::min(size.height - 1, y + 1); ++j)
                    for (int i = std::max(0, x - 1); i <= std::min(size.width - 1, x + 1); ++i) {
                        double d = 0;
                        for (int c = 0; c < 3; ++c) {
                            const double apart = double{a.in[3].color.at(x, y, c)} - a.in[f].color.at(i, j, c);
                            d += apart * apart;
                        }
                        const double w = std::exp(-d / (2 * 0.3 * 0.3));
                        total += w;
                        for (int c = 0; c < 3; ++c) sums[c] += w * a.in[f].color.at(i, j, c);
                    }
            for (int c = 0; c < 3; ++c) expected.at(x, y, c) = static_cast<float>(sums[c] / total);
        }
    on_both([&](const auto& executor) { CHECK(beyond(2e-5, filtered(several, in, executor), expected) == ""); });
}

TEST_CASE("the derivative over several frames: lanes as serial, and the other frames only dilute") {
    const animation a;
    const frame_sequence<frame_of_color> in{a.frames[0], {}, std::span(a.frames).subspan(1)};
    const auto f = filter{weight_of_color, window::space_time{.radius = 3, .frames = 2}}.with(estimator::sure{});
    image<> mean(size, 3), slope[2] = {image<>(size, 3), image<>(size, 3)};
    f(in, output(mean).derivative(slope[0].view()), executor::serial<double>{});
    f(in, output(mean).derivative(slope[1].view()), executor::simd{});
    CHECK(beyond(1e-4, slope[1], slope[0]) == "");
    CHECK(largest_magnitude(slope[0]) > 0.01);
}

TEST_CASE("frames of another size, and further layers over several frames, are refused") {
    const animation a;
    image<> small({5, 5}, 3), out(size, 3);
    const std::vector<frame_of_color> wrong{frame_of_color{color = small.view(), variance(color) = small.view()}};
    const filter several{weight_of_color, window::space_time{.radius = 1, .frames = 1}};
    const frame_sequence<frame_of_color> mixed{a.frames[0], wrong, {}};
    CHECK_THROWS_WITH(several(mixed, output(out)), Catch::Contains("5x5") && Catch::Contains("19x7"));
    const frame_sequence<frame_of_color> in{a.frames[0], {}, std::span(a.frames).last(1)};
    image<> depth_out(size);
    CHECK_THROWS_WITH(several(in, output(out).layer(a.in[0].depth.view(), depth_out.view())),
                      Catch::Contains("further layers"));
    CHECK_THROWS_WITH((window::space_time{.radius = 1, .frames = -1}.check()), Catch::Contains("-1 frames"));
}
