// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// Whatever the caller's memory looks like, and whatever is wrong with it, the filters see the same planes.
#include <cstring>
#include <limits>
#include <vector>
#include <winnow/executor/stage.hpp>
#include "executor/agreement.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr executor_kind both[] = {executor_kind::simd, executor_kind::serial_double};

/// An image in memory of its own, laid out with any strides; the bytes between its values are 0x5a.
struct relaid {
    std::vector<std::byte> memory;
    image_view<float> view;
};

relaid lay_out(const image<>& from, strides step) {
    const extent size = from.size();
    const std::ptrdiff_t ends[] = {step.channel * (from.channels() - 1), step.pixel * (size.width - 1),
                                   step.row * (size.height - 1)};
    std::ptrdiff_t before = 16, after = 16 + 4;
    for (const std::ptrdiff_t end : ends) (end < 0 ? before : after) += std::abs(end);
    relaid to{std::vector<std::byte>(static_cast<std::size_t>(before + after), std::byte{0x5a}), {}};
    to.view = {reinterpret_cast<float*>(to.memory.data() + before), size, from.channels(), step};
    for (int c = 0; c < from.channels(); ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) to.view.at(x, y, c) = from.at(x, y, c);
    return to;
}

/// Binds every buffer through lay_out and compares with planar float, input and output.
template <class StridesOf>
void check_layout(const std::string& name, const StridesOf& strides_of) {
    const extent size{35, 18};
    const buffers in = make_buffers(size);
    std::vector<relaid> kept;
    named_layers other;
    buffers::each(in, [&](const char* layer, const image<>& i) {
        kept.push_back(lay_out(i, strides_of(i)));
        other.bind(layer, source(kept.back().view));
    });
    for (const any_filter& f : {joint_bilateral({.border = border::mirror}), rdfc_candidate(), nlm_dual_buffer()})
        for (const executor_kind kind : both) {
            CAPTURE(name, f.name, static_cast<int>(kind));
            const image<> expected = f.images(in.layers(), size, {kind})[0];
            relaid found = lay_out(image<>(size, 3), strides_of(expected));
            f(other, output{found.view}, {kind});
            // Every value is written, and nothing beside them.
            CHECK(found.memory == lay_out(expected, strides_of(expected)).memory);
        }
}

}  // namespace

TEST_CASE("any strides give the bits of planar float, and nothing but the values is written") {
    check_layout("interleaved", [](const image<>& i) {
        const std::ptrdiff_t pixel = 4 * i.channels();
        return strides{4, pixel, pixel * i.size().width};
    });
    check_layout("a member of a pixel of 44 bytes, rows padded", [](const image<>& i) {
        return strides{4, 44, 44 * i.size().width + 12};
    });
    check_layout("channels in reverse order", [](const image<>& i) { return strides{-4, 12, 12 * i.size().width}; });
    check_layout("planar, rows padded and bottom up", [](const image<>& i) {
        const std::ptrdiff_t row = 4 * i.size().width + 28;
        return strides{row * i.size().height, 4, -row};
    });
    check_layout("RGBA, bottom up", [](const image<>& i) { return strides{4, 16, -16 * i.size().width}; });
    check_layout("from right to left", [](const image<>& i) { return strides{4, -12, 12 * i.size().width}; });
    check_layout("columns before rows", [](const image<>& i) { return strides{4, 12 * i.size().height, 12}; });
    check_layout("scan lines of channels", [](const image<>& i) {
        return strides{4 * i.size().width, 4, 4 * i.size().width * i.channels()};
    });
}

TEST_CASE("half gives the bits of float that holds the same numbers") {
    const extent size{35, 18};
    buffers rounded = make_buffers(size);
    std::vector<image<half>> kept;
    kept.reserve(12);
    named_layers halves;
    const auto exact_in_half = [&](const char* name, image<>& i) {
        kept.push_back(fill<half>(size, i.channels(), [&](int x, int y, int c) { return i.at(x, y, c); }));
        i = fill(size, i.channels(), [&](int x, int y, int c) { return float(kept.back().at(x, y, c)); });
        halves.bind(name, source(kept.back().view()));
    };
    buffers::each(rounded, exact_in_half);
    for (const any_filter& f : {bilateral({.border = border::clamp}), rdfc_candidate(), nlm_dual_buffer()})
        for (const executor_kind kind : both) {
            CAPTURE(f.name, static_cast<int>(kind));
            const image<> expected = f.images(rounded.layers(), size, {kind})[0];
            CHECK(other_bits(f.images(halves, size, {kind})[0], expected) == "");
            // A result in half is the result, rounded once.
            image<half> found(size, 3);
            f(halves, output{found.view()}, {kind});
            const auto as_float = [&](const image<half>& i) {
                return fill(size, 3, [&](int x, int y, int c) { return float(i.at(x, y, c)); });
            };
            const auto once = fill<half>(size, 3, [&](int x, int y, int c) { return expected.at(x, y, c); });
            CHECK(other_bits(as_float(found), as_float(once)) == "");
        }
}

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

/// The results of a clean and of a spoilt frame: finite, and alike farther than `reach` from (x, y).
void check_contained(const std::vector<image<>>& expected, const std::vector<image<>>& found, int x, int y, int reach) {
    const extent size = expected[0].size();
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(all_finite(found[i]));
        // Everything within the reach is made alike before the comparison.
        const auto outside = [&](const image<>& of) {
            return fill(size, 3, [&](int px, int py, int c) {
                return std::max(std::abs(px - x), std::abs(py - y)) > reach ? of.at(px, py, c) : 0.0f;
            });
        };
        CHECK(other_bits(outside(found[i]), outside(expected[i])) == "");
    }
}

}  // namespace

TEST_CASE("a bad value is contained: finite results, and the same bits farther away than the halo") {
    const extent size{33, 21};
    const buffers clean = make_buffers(size);
    std::vector<std::string> names;
    buffers::each(clean, [&](const std::string& name, const image<>&) { names.push_back(name); });
    for (const executor_kind kind : both)
        for (const border rule : all_borders)
            for (const any_filter& f : all_filters({.radius = 2, .patch_radius = 1, .border = rule})) {
                // The definition stages as the lanes do: one filter will do.
                if (kind == executor_kind::serial_double && f.name != "rdfc candidate") continue;
                const auto expected = f.images(clean.layers(), size, {kind});
                int which = 0;
                for (const std::string& bad : names) {
                    // A NaN, an infinity or a negative variance, inside, at an edge or in a corner.
                    const float values[] = {not_a_number, infinite, -infinite, -1.0f};
                    const bool is_variance = bad.find("variance") != std::string::npos;
                    const float value = values[which % (is_variance ? 4 : 3)];
                    const int x = which % 3 == 0 ? 16 : which % 3 == 1 ? 0 : size.width - 1;
                    const int y = which % 2 == 0 ? 10 : size.height - 1;
                    ++which;
                    buffers spoilt = clean;
                    buffers::each(spoilt, [&](const std::string& name, image<>& i) {
                        if (name == bad) i.at(x, y, i.channels() - 1) = value;
                    });
                    CAPTURE(f.name, static_cast<int>(kind), static_cast<int>(rule), bad, value, x, y);
                    check_contained(expected, f.images(spoilt.layers(), size, {kind}), x, y, f.halo);
                }
            }
}

TEST_CASE("a bad pixel is replaced by the mean of its finite neighbours") {
    const extent size{19, 11};
    buffers spoilt = make_buffers(size);
    spoilt.color.at(7, 5, 1) = not_a_number;
    spoilt.color.at(8, 5, 1) = infinite;
    buffers mended = spoilt;
    const auto mean_around = [&](int x) {
        double sum = 0;
        for (int j = 4; j <= 6; ++j)
            for (int i = x - 1; i <= x + 1; ++i)
                if (is_finite(spoilt.color.at(i, j, 1))) sum += double{spoilt.color.at(i, j, 1)};
        return static_cast<float>(sum / 7);
    };
    mended.color.at(7, 5, 1) = mean_around(7);
    mended.color.at(8, 5, 1) = mean_around(8);
    for (const executor_kind kind : both)
        for (const border rule : all_borders) {
            const any_filter f = rdfc_candidate({.border = rule});
            CHECK(other_bits(f.images(spoilt.layers(), size, {kind})[0], f.images(mended.layers(), size, {kind})[0]) ==
                  "");
        }
}

TEST_CASE("negative variance counts as none") {
    const extent size{19, 11};
    buffers negative = make_buffers(size);
    negative.color_variance.at(9, 6, 0) = -0.5f;
    negative.albedo_variance.at(3, 2, 1) = -1e-3f;
    buffers zero = negative;
    zero.color_variance.at(9, 6, 0) = 0;
    zero.albedo_variance.at(3, 2, 1) = 0;
    for (const executor_kind kind : both)
        CHECK(other_bits(rdfc_candidate().images(negative.layers(), size, {kind})[0],
                         rdfc_candidate().images(zero.layers(), size, {kind})[0]) == "");
}

TEST_CASE("frames of nothing but NaN, infinities or zeros come out finite") {
    const extent size{19, 11};
    for (const float value : {not_a_number, infinite, 0.0f, -1.0f}) {
        buffers in = make_buffers(size);
        buffers::each(
            in, [&](const char*, image<>& i) { i = fill(size, i.channels(), [&](int, int, int) { return value; }); });
        for (const executor_kind kind : both)
            for (const any_filter& f : all_filters({.radius = 2})) {
                CAPTURE(f.name, value, static_cast<int>(kind));
                for (const auto& found : f.images(in.layers(), size, {kind})) {
                    CHECK(all_finite(found));
                    if (value == 0) CHECK(largest_magnitude(found) == 0);
                }
            }
    }
}

TEST_CASE("a frame with a few good pixels left comes out finite") {
    const extent size{33, 21};
    buffers in = make_buffers(size);
    buffers::each(in, [&](const char*, image<>& i) {
        for (int c = 0; c < i.channels(); ++c)
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    if (uniform(77, x, y, c) < 0.9)
                        i.at(x, y, c) = uniform(78, x, y, c) < 0.5 ? not_a_number : infinite;
    });
    for (const executor_kind kind : both)
        for (const any_filter& f : all_filters({.radius = 2}))
            for (const auto& found : f.images(in.layers(), size, {kind})) CHECK(all_finite(found));
}

TEST_CASE("huge values come out finite, and lanes agree with the definition about them") {
    // Renderers write 1e30 for the depth of the sky; a firefly can be as bright.
    const extent size{33, 21};
    for (const std::string bad : {"color", "color.variance", "albedo", "albedo.variance", "depth", "depth.variance"}) {
        buffers in = make_buffers(size);
        buffers::each(in, [&](const std::string& name, image<>& i) {
            if (name != bad) return;
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x)
                    if (uniform(79, x, y) < 0.1) i.at(x, y) = 1e30f;
        });
        for (const filter_numbers n :
             {filter_numbers{.radius = 2}, filter_numbers{.radius = 2, .border = border::mirror}})
            for (const any_filter& f : all_filters(n)) {
                CAPTURE(f.name, bad, static_cast<int>(n.border));
                const auto expected = f.images(in.layers(), size);
                const auto found = f.images(in.layers(), size, {executor_kind::simd});
                for (std::size_t i = 0; i < found.size(); ++i) {
                    CHECK(all_finite(expected[i]));
                    CHECK(all_finite(found[i]));
                    if (f.name != "nlm dual buffer")
                        CHECK(beyond_relative(3 * rounding_bound(n), found[i], expected[i]) == "");
                }
            }
    }
}
