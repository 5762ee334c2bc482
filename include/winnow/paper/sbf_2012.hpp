// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// SBF: of several cross bilateral filters, in each pixel the one whose estimated error is the least.
/// Li, Wu, Chuang, "SURE-based Optimization for Adaptive Sampling and Reconstruction", 2012.
#include <winnow/filter/passes.hpp>
#include <winnow/paper/sbf_2012_bank.hpp>

namespace winnow::paper {

/// Runs a bank in one sweep, smooths the estimated errors with a filter of the same kind, and takes in each pixel the
/// candidate with the least; at a tie the first.  Half buffers, further layers, the derivative and the sum of weights
/// are those of that candidate, the estimated error is its smoothed one, the same in all channels.
///
/// Reads the colour and the variance of its mean, and the features with the variance of theirs, in unit range (see
/// unit_range).  Stein's estimate is right as far as the noise of the features has nothing to do with that of the
/// colour: where a light is both seen and lit by, it is too low for what hardly filters.
template <class Bank>
struct least_error_of {
    using candidate_set = decltype(std::declval<const Bank&>().candidates());
    using reads =
        joined<typename candidate_set::reads, typename decltype(std::declval<const Bank&>().smoothing().weight)::reads>;
    static constexpr std::size_t count = Bank::count;

    Bank bank{};

    template <frame_to_filter<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }

    /// `chosen`, where it is given, gets the number of the candidate, one channel.
    template <frame_to_filter<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory,
                    const target& chosen = {}) const {
        const extent size = check(in, out, chosen);
        scratch_images images(memory.images, size, scratch_planes(out));
        const pass_runner passes(executor, memory);
        std::array<candidate_images, count> candidate;
        for (candidate_images& c : candidate) c = take(images, out);

        memory.progress.enter(0, 0.8f);
        run(in, candidate, out, executor, memory);
        memory.progress.enter(0.8f, 1);
        smooth(in, candidate, passes);
        choose(candidate, out, chosen, passes);
    }
    bool operator==(const least_error_of&) const = default;

    /// How far from a pixel its result can depend on the input, in pixels.
    friend int halo(const least_error_of& f) { return halo(f.bank.candidates().as_sweep()) + halo(f.bank.smoothing()); }

private:
    /// What one candidate leaves; views of no channels stand for what nobody asks for.
    struct candidate_images {
        image_view<float> mean, error, half_a, half_b, derivative, support, further;
    };

    /// Calls f(image, channels) for each of them.
    template <class F>
    static void each_image(const output& out, const F& f) {
        int further = 0;
        for (const auto& layer : out.layers()) further += layer.first.channels;
        const bool halves = out.half_a() || out.half_b();
        f(&candidate_images::mean, 3), f(&candidate_images::error, 3);
        f(&candidate_images::half_a, halves ? 3 : 0), f(&candidate_images::half_b, halves ? 3 : 0);
        f(&candidate_images::derivative, out.derivative() ? 3 : 0);
        f(&candidate_images::support, out.support() ? 1 : 0);
        f(&candidate_images::further, further);
    }
    static int scratch_planes(const output& out) {
        int planes = 0;
        each_image(out, [&](auto, int channels) { planes += channels; });
        return static_cast<int>(count) * planes;
    }
    static candidate_images take(scratch_images& images, const output& out) {
        candidate_images c;
        each_image(out, [&](auto image, int channels) { c.*image = images.take(channels); });
        return c;
    }

    template <class Frame>
    extent check(const Frame& in, const output& out, const target& chosen) const {
        bank.check();
        const extent size = detail::find_or_fail(in, color).size;
        detail::check_outputs(out, 3, size, color);
        if (chosen) detail::check_layer("the output of the choice", source(chosen), 1, size, color);
        for (const auto& layer : out.layers())
            detail::check_layer("a further layer", layer.first, layer.first.channels, size, color);
        return size;
    }

    template <class Frame, class Executor>
    void run(const Frame& in, const std::array<candidate_images, count>& candidate, const output& out,
             const Executor& executor, workspace& memory) const {
        for (std::size_t k = count; k-- > 0;) {
            const candidate_images& c = candidate[k];
            output& pass = memory.pass(c.mean, k).error(c.error);
            if (c.half_a.channels) pass.halves(c.half_a, c.half_b);
            if (c.derivative.channels) pass.derivative(c.derivative);
            if (c.support.channels) pass.support(c.support);
            int channel = 0;
            for (const auto& layer : out.layers()) {
                pass.layer(layer.first, c.further.channel(channel, layer.first.channels));
                channel += layer.first.channels;
            }
        }
        bank.candidates()(in, std::span<const output, count>(memory.passes.data(), count), executor, memory);
    }

    /// The mean of the estimated error over channels goes to its first channel, smoothed to its second.
    template <class Frame, class Passes>
    void smooth(const Frame& in, const std::array<candidate_images, count>& candidate, const Passes& passes) const {
        const std::ptrdiff_t plane = candidate[0].mean.size.pixels();
        passes.for_each_pixel(candidate[0].mean.size, [&](std::ptrdiff_t i) {
            for (const candidate_images& c : candidate) {
                float* const e = c.error.data + i;
                *e = (e[0] + e[plane] + e[2 * plane]) / 3;
            }
        });
        output& pass = passes.memory().pass({});
        for (const candidate_images& c : candidate) pass.layer(c.error.channel(0, 1), c.error.channel(1, 1));
        bank.smoothing()(in, pass, passes.executor(), passes.memory());
    }

    template <class Passes>
    void choose(const std::array<candidate_images, count>& candidate, const output& out, const target& chosen,
                const Passes& passes) const {
        const extent size = candidate[0].mean.size;
        const std::ptrdiff_t plane = size.pixels();
        for_each_row(passes.executor(), size, [&](int y) {
            for (int x = 0; x < size.width; ++x) {
                const std::ptrdiff_t i = std::ptrdiff_t{y} * size.width + x;
                std::size_t best = 0;
                const auto error = [&](std::size_t k) { return candidate[k].error.data[plane + i]; };
                for (std::size_t k = 1; k < count; ++k)
                    if (error(k) < error(best)) best = k;
                const candidate_images& c = candidate[best];
                const auto write = [&](const target& to, const image_view<float>& from) {
                    for (int v = 0; to && v < to.channels; ++v) to.channel(v).set(x, y, from.data[i + v * plane]);
                };
                write(out.mean(), c.mean);
                write(out.half_a(), c.half_a);
                write(out.half_b(), c.half_b);
                write(out.derivative(), c.derivative);
                write(out.support(), c.support);
                int channel = 0;
                for (const auto& layer : out.layers()) {
                    write(layer.second, c.further.channel(channel, layer.first.channels));
                    channel += layer.first.channels;
                }
                if (const target& to = out.error())
                    for (int v = 0; v < to.channels; ++v) to.channel(v).set(x, y, error(best));
                if (chosen) chosen.set(x, y, static_cast<float>(best));
            }
        });
    }
};

/// What a run over an image of this size will take; `values` counts the planes to filter: 3 for the colour, 6 more with
/// halves, and those of further layers.  The derivative and the sum of weights, where asked for, take 4 more images a
/// candidate.
template <class Bank, executor_policy Executor>
run_plan plan(const least_error_of<Bank>& f, extent size, const Executor& executor, int values = 3) {
    run_plan p = plan(f.bank.candidates(), size, executor, values);
    p.image_bytes = scratch_images::bytes(size, static_cast<int>(Bank::count) * (values + 3));
    p.passes = 2;
    p.halo = halo(f);
    return p;
}

using sbf_2012_features = planes<albedo_t, normal_t, depth_t>;

/// As in the paper and as its authors released it: cross bilateral filters of several scales.
template <class Features>
using sbf_of = least_error_of<cross_bilateral_bank<Features>>;
using sbf = sbf_of<sbf_2012_features>;

/// Its other kind: cross non-local means of several sensitivities.
using sbf_nlm = least_error_of<cross_nlm_bank<sbf_2012_features>>;

/// The paper's numbers for a render of so many samples a pixel.
constexpr sbf_features sbf_features_as_published(int samples) {
    return {.spread = static_cast<float>(samples), .floor = 1e-2f};
}

/// The paper leaves it open how much of the noise of features to forgive, and what is best differs from scene to scene
/// by half.  Two settings at every scale: the estimate that chooses the scale chooses between them as well.
template <class Features>
struct sbf_automatic_of : least_error_of<cross_bilateral_bank<Features, 2>> {
    sbf_automatic_of() {
        this->bank.like[0] = {.spread = 64, .floor = 1e-2f};
        this->bank.like[1] = {.spread = 256, .floor = 3e-3f};
    }
};
using sbf_automatic = sbf_automatic_of<sbf_2012_features>;

}  // namespace winnow::paper
