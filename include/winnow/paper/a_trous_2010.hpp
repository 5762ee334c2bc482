// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Edge-avoiding A-Trous wavelets: a wide cross bilateral filter as a few passes of five by five taps.
/// Dammertz, Sewtz, Hanika, Lensch, "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering",
/// 2010.
#include <winnow/distance/squared_difference.hpp>
#include <winnow/estimator/residual_variance.hpp>
#include <winnow/filter/passes.hpp>
#include <winnow/weight/b3_spline.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/gaussian.hpp>
#include <winnow/window/a_trous.hpp>

namespace winnow::paper {

/// A difference as large as a sigma is worth 1 / e.
struct a_trous_numbers {
    int levels = 5;               ///< passes, with taps 1, 2, 4, ... pixels apart
    float sigma_color = 4;        ///< of the first level, halved at each; in units of radiance
    float sigma_normal = 0.3f;    ///< of neighbouring pixels: a difference is divided by the distance of the taps
    float sigma_position = 0.2f;  ///< in world units
    float sigma_other = 0.1f;     ///< of depth, and whatever else is named
    bool demodulate = false;      ///< filters colour over albedo, so that texture is not blurred
    float least_albedo = 1e-2f;   ///< what is darker counts as this

    void check() const {
        if (levels < 1 || levels > 12)
            fail("a_trous: levels is " + std::to_string(levels) + ", it must be between 1 and 12");
        for (const float sigma : {sigma_color, sigma_normal, sigma_position, sigma_other})
            if (!(sigma >= 0)) fail("a_trous: a sigma is " + std::to_string(sigma) + ", it must be 0 or more");
        if (!(least_albedo > 0))
            fail("a_trous: least_albedo is " + std::to_string(least_albedo) + ", it must be above 0");
    }
    bool operator==(const a_trous_numbers&) const = default;
};

/// Each level averages over 5x5 taps, 2^level apart,
///     w = h(tap) exp(-|c_p - c_q|^2 / sc_i^2) exp(-|n_p - n_q|^2 / (step^2 sn^2)) exp(-|x_p - x_q|^2 / sx^2),
/// where h is a B3 spline, c what the level before has made of the colour, and sc_i = sc_0 / 2^i.  Half buffers and
/// further layers go through all levels with the same weights; the estimated error is the variance that the filtered
/// halves show.
template <class Features>
struct a_trous_of;

template <guide... Feature>
struct a_trous_of<planes<Feature...>> {
    using reads = planes<color_t, Feature...>;

    a_trous_numbers numbers{};

    template <frame_with<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }
    template <frame_with<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory) const {
        const extent size = check(in, out);
        scratch_images images(memory.images, size, 2 * planes_of(out));
        const pass_runner passes(executor, memory);
        level_images from = take(images, out), to = take(images, out);
        if (numbers.demodulate) divide(in, out, from, passes);
        for (int i = 0; i < numbers.levels; ++i) {
            memory.progress.enter(static_cast<float>(i) / static_cast<float>(numbers.levels),
                                  static_cast<float>(i + 1) / static_cast<float>(numbers.levels));
            const bool as_read = i == 0 && !numbers.demodulate, last = i + 1 == numbers.levels && !numbers.demodulate;
            const auto input = [&](auto g, const image_view<float>& image) {
                return as_read ? in.find(g) : source(image);
            };
            const frame guides{
                color = input(color, from.mean),
                first_half(color) = from.half_a.channels ? input(first_half(color), from.half_a) : source{},
                second_half(color) = from.half_b.channels ? input(second_half(color), from.half_b) : source{},
                (Feature{} = in.find(Feature{}))...};
            output& pass = memory.pass(last ? out.mean() : target(to.mean));
            if (last) pass.halves(out.half_a(), out.half_b()).error(out.error());
            else if (to.half_a.channels) pass.halves(to.half_a, to.half_b);
            int channel = 0;
            for (const auto& layer : out.layers()) {
                const int channels = layer.first.channels;
                pass.layer(as_read ? layer.first : source(from.further.channel(channel, channels)),
                           last ? layer.second : target(to.further.channel(channel, channels)));
                channel += channels;
            }
            level(i)(guides, pass, executor, memory);
            std::swap(from, to);
        }
        if (numbers.demodulate) multiply(in, out, from, passes);
    }
    bool operator==(const a_trous_of&) const = default;

    /// One pass, as a filter by itself.
    auto level(int i) const {
        const float step = static_cast<float>(1 << i);
        return filter{(weight::b3_spline{1 << i} * ... * feature(Feature{}, step)) *
                          decaying(l2(color), numbers.sigma_color / step),
                      window::a_trous{.level = i}, estimator::residual_variance{}};
    }

    /// How far from a pixel its result can depend on the input, in pixels.
    friend int halo(const a_trous_of& f) {
        int reach = 0;
        for (int i = 0; i < f.numbers.levels; ++i) reach += halo(f.level(i));
        return reach;
    }

private:
    /// What lies between two levels; views of no channels stand for what nobody asks for.
    struct level_images {
        image_view<float> mean, half_a, half_b, further;
    };

    /// exp(-d / sigma^2).
    template <class D>
    static auto decaying(D d, float sigma) {
        return gaussian(d, 0.70710678f * sigma);
    }
    auto feature(normal_t g, float step) const { return decaying(l2(g), numbers.sigma_normal * step); }
    auto feature(position_t g, float) const { return decaying(l2(g), numbers.sigma_position); }
    template <guide G>
    auto feature(G g, float) const {
        return decaying(l2(g), numbers.sigma_other);
    }

    static bool halves_of(const output& out) { return out.half_a() || out.half_b() || out.error(); }
    static int further_of(const output& out) {
        int channels = 0;
        for (const auto& layer : out.layers()) channels += layer.first.channels;
        return channels;
    }
    static int planes_of(const output& out) { return 3 + (halves_of(out) ? 6 : 0) + further_of(out); }
    static level_images take(scratch_images& images, const output& out) {
        const int half = halves_of(out) ? 3 : 0;
        const auto mean = images.take(3), half_a = images.take(half), half_b = images.take(half);
        return {mean, half_a, half_b, images.take(further_of(out))};
    }

    template <class Frame>
    extent check(const Frame& in, const output& out) const {
        numbers.check();
        const extent size = detail::find_or_fail(in, color).size;
        if (size.width < 1 || size.height < 1) fail("color is " + to_string(size) + ": there is nothing to filter");
        const auto check_guide = [&](auto g) {
            detail::check_layer(g, detail::find_or_fail(in, g), g.channels, size, color);
        };
        check_guide(color);
        (check_guide(Feature{}), ...);
        if (numbers.demodulate) check_guide(albedo);
        if (halves_of(out)) check_guide(first_half(color)), check_guide(second_half(color));
        detail::check_outputs(out, 3, size, color);
        if (out.derivative() || out.support())
            fail("a_trous: there is no derivative and no sum of weights of all levels");
        for (const auto& layer : out.layers())
            detail::check_layer("a further layer", layer.first, layer.first.channels, size, color);
        return size;
    }

    /// The albedo by which channel c of a layer is divided: of one that is not in colour, its mean.
    float reflectance(const source& of, int x, int y, int c, int channels) const {
        const auto at = [&](int k) {
            const float a = of.channel(k).at(x, y);
            return a > numbers.least_albedo ? a : numbers.least_albedo;  // also for a NaN
        };
        return channels == 3 ? at(c) : (at(0) + at(1) + at(2)) / 3;
    }
    /// to(x, y, c) = from(x, y, c) times or over the albedo.
    template <class Passes, class Combine>
    void map(const Passes& passes, const source& of, const source& from, const target& to, const Combine& f) const {
        if (to)
            for_each_row(passes.executor(), to.size, [&](int y) {
                for (int c = 0; c < to.channels; ++c)
                    for (int x = 0; x < to.size.width; ++x)
                        to.channel(c).set(x, y, f(from.channel(c).at(x, y), reflectance(of, x, y, c, to.channels)));
            });
    }
    template <class Frame, class Passes>
    void divide(const Frame& in, const output& out, const level_images& to, const Passes& passes) const {
        const auto over = [](float u, float albedo) { return u / albedo; };
        const source of = in.find(albedo);
        map(passes, of, in.find(color), to.mean, over);
        if (to.half_a.channels) map(passes, of, in.find(first_half(color)), to.half_a, over);
        if (to.half_b.channels) map(passes, of, in.find(second_half(color)), to.half_b, over);
        int channel = 0;
        for (const auto& layer : out.layers()) {
            map(passes, of, layer.first, to.further.channel(channel, layer.first.channels), over);
            channel += layer.first.channels;
        }
    }
    template <class Frame, class Passes>
    void multiply(const Frame& in, const output& out, const level_images& from, const Passes& passes) const {
        const auto times = [](float u, float albedo) { return u * albedo; };
        const source of = in.find(albedo);
        map(passes, of, from.mean, out.mean(), times);
        int channel = 0;
        for (const auto& layer : out.layers()) {
            map(passes, of, from.further.channel(channel, layer.first.channels), layer.second, times);
            channel += layer.first.channels;
        }
        if (!from.half_a.channels) return;
        map(passes, of, from.half_a, out.half_a(), times);
        map(passes, of, from.half_b, out.half_b(), times);
        // (A - B)^2 / 4
        passes.for_each_value(from.half_a, [&](std::ptrdiff_t i) {
            const float half_difference = (from.half_a.data[i] - from.half_b.data[i]) / 2;
            return half_difference * half_difference;
        });
        map(passes, of, from.half_a, out.error(), [](float e, float albedo) { return e * albedo * albedo; });
    }
};

/// What a run over an image of this size will take; `values` counts the planes to filter: 3 for the colour, 6 more with
/// halves, and those of further layers.
template <class Features, executor_policy Executor>
run_plan plan(const a_trous_of<Features>& f, extent size, const Executor& executor, int values = 3) {
    run_plan p = plan(f.level(f.numbers.levels - 1), size, executor, values);
    p.image_bytes = scratch_images::bytes(size, 2 * values);
    p.passes = f.numbers.levels;
    p.halo = halo(f);
    return p;
}

/// With the guides of the paper; where there are no positions, a_trous_of<planes<normal_t, depth_t>>.
using a_trous = a_trous_of<planes<normal_t, position_t>>;

}  // namespace winnow::paper
