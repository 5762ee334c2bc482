// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// RDFC: three filters between trust in colour and trust in features, and an estimate of which is right where.
/// Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information", 2013.
#include <array>
#include <winnow/filter/candidates.hpp>
#include <winnow/filter/passes.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/paper/rdfc_2013_candidate.hpp>
#include <winnow/paper/rdfc_2013_cleaning.hpp>
#include <winnow/paper/rdfc_2013_selection.hpp>
#include <winnow/window/space_time.hpp>

namespace winnow::paper {

/// Features: the buffers beside the colour, in unit range (see unit_range), for instance
/// planes<albedo_t, normal_t, depth_t, visibility_t>.  Selection: binary_maps as in the paper, or convex_blend.
///
/// Reads the colour and its halves; as far as they are there, the variance of the colour's mean, which is scaled to
/// what the halves show, and the halves and the variance of each feature.  A feature without halves is taken for exact.
/// The estimated error, the derivative and the sum of weights that an output may ask for are those of the first pass.
template <class Features, class Selection = binary_maps>
struct rdfc_of;

template <guide... Feature, class Selection>
struct rdfc_of<planes<Feature...>, Selection> {
    using features = planes<Feature...>;
    using reads = planes<color_t, half_a<color_t>, half_b<color_t>, Feature...>;
    using optional =
        joined<planes<variance_of<color_t>>, planes<variance_of<Feature>, half_a<Feature>, half_b<Feature>>...>;

    rdfc_numbers numbers{};
    Selection selection{};

    template <frame_with<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }

    /// `selected`, where it is given, gets the shares of FIRST, SECOND and THIRD: three channels that add up to 1.
    template <frame_with<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory,
                    const target& selected = {}) const {
        const extent size = check(in, out, selected);
        scratch_images images(memory.images, size, scratch_planes(frames_around(in), further_channels(out)));
        const pass_runner passes(executor, memory);

        memory.progress.enter(0, 0.1f);
        const auto guides = cleaning()(passes, in, images);
        std::vector<std::remove_const_t<decltype(guides)>> others;
        if constexpr (is_frame_sequence<Frame>)
            in.for_each_other(numbers.frames,
                              [&](const auto& other) { others.push_back(cleaning()(passes, other, images)); });

        memory.progress.enter(0.1f, 0.8f);
        std::array<candidate_images, 3> candidate{take_candidate(images, out), take_candidate(images, out),
                                                  take_candidate(images, out)};
        run_candidates(around(in, guides, std::span(std::as_const(others))), candidate, out, executor, memory);

        memory.progress.enter(0.8f, 0.9f);
        const image_view<float> share = images.take(3), error = images.take(1);
        select(passes, guides, candidate, share, error, images);
        write_estimates(passes, candidate, share, error, out, selected);
        average(passes, candidate, share);
        memory.progress.enter(0.9f, 1);
        second_pass(passes, candidate, out);
    }
    bool operator==(const rdfc_of&) const = default;

    /// How far from a pixel its result can depend on the input, in pixels.
    friend int halo(const rdfc_of& f) {
        const int scaling = 11, blur = 3, features = scaling + halo(f.cleaning().feature_filter(albedo)) + blur;
        const int selecting = halo(f.smoothing(f.selection.error_radius)) + halo(f.smoothing(f.selection.map_radius));
        return features + std::max(halo(f.first()), halo(f.second())) + selecting + blur + halo(f.last());
    }

    // The filters that it is made of.
    auto cleaning() const { return rdfc_cleaning<Feature...>{numbers}; }
    auto first() const { return candidate_filter(1); }
    auto second() const { return candidate_filter(3); }
    auto third() const {
        return filter{rdfc_feature_weight(features{}, numbers.k_feature, numbers.tau_third),
                      window::space_time{numbers.radius, numbers.frames}}
            .with(estimator::sure{});
    }
    /// Of error maps and selection maps.
    auto smoothing(int radius) const {
        return filter{rdfc_color_weight(1, numbers.smoothing_patch, numbers.epsilon), window::square{.radius = radius}};
    }
    auto last() const {
        const int radius = static_cast<int>(static_cast<float>(numbers.radius) * numbers.last_share);
        return make_nlm({radius, numbers.last_patch, numbers.k_color, numbers.epsilon});
    }

    /// Planes of the workspace that a run takes.
    static int scratch_planes(int frames, int further) {
        const int guides = 3 + 2 * features::count, candidate = 3 * 4 + 1 + further;
        return (1 + frames) * guides + 3 * candidate + 4 + 2 * Selection::statistics + 3;
    }

private:
    /// What one candidate leaves; `further` are the further layers, side by side.
    struct candidate_images {
        image_view<float> mean, half_a, half_b, derivative, support, further;
    };

    auto candidate_filter(int patch_radius) const {
        return make_rdfc_candidate_of<features>(
                   {numbers.radius, patch_radius, numbers.k_color, numbers.k_feature, numbers.tau, numbers.epsilon})
            .with(window::space_time{numbers.radius, numbers.frames})
            .with(estimator::sure{});
    }

    static int further_channels(const output& out) {
        int channels = 0;
        for (const auto& layer : out.layers()) channels += layer.first.channels;
        return channels;
    }
    template <class Frame>
    int frames_around([[maybe_unused]] const Frame& in) const {
        int count = 0;
        if constexpr (is_frame_sequence<Frame>) in.for_each_other(numbers.frames, [&](const auto&) { ++count; });
        return count;
    }

    template <class Frame>
    extent check(const Frame& in, const output& out, const target& selected) const {
        const extent size = cleaning().check(in);
        if constexpr (is_frame_sequence<Frame>)
            in.for_each_other(numbers.frames, [&](const auto& other) {
                if (const extent found = cleaning().check(other); found != size)
                    fail("a frame of the sequence is " + to_string(found) + ", another is " + to_string(size));
            });
        detail::check_outputs(out, 3, size, color);
        if (selected) detail::check_layer("the output of the selection", source(selected), 3, size, color);
        for (const auto& layer : out.layers())
            detail::check_layer("a further layer", layer.first, layer.first.channels, size, color);
        return size;
    }

    /// The clean frame, or it and those around it.
    template <class Frame, class Guides>
    auto around([[maybe_unused]] const Frame& in, const Guides& guides, std::span<const Guides> others) const {
        if constexpr (is_frame_sequence<Frame>) {
            const std::size_t before = std::min(in.before.size(), static_cast<std::size_t>(numbers.frames));
            return frame_sequence<Guides>{guides, others.first(before), others.subspan(before)};
        } else {
            return guides;
        }
    }

    candidate_images take_candidate(scratch_images& images, const output& out) const {
        const auto mean = images.take(3), half_a = images.take(3), half_b = images.take(3), slope = images.take(3);
        const auto support = images.take(1);
        return {mean, half_a, half_b, slope, support, images.take(further_channels(out))};
    }

    /// Lines 9 to 14, in one sweep.
    template <class Guides, class Executor>
    void run_candidates(const Guides& guides, const std::array<candidate_images, 3>& candidate, const output& out,
                        const Executor& executor, workspace& memory) const {
        for (std::size_t k = 3; k-- > 0;) {
            const candidate_images& c = candidate[k];
            output& pass = memory.pass(c.mean, k).halves(c.half_a, c.half_b).derivative(c.derivative);
            pass.support(c.support);
            int channel = 0;
            for (const auto& layer : out.layers()) {
                pass.layer(layer.first, c.further.channel(channel, layer.first.channels));
                channel += layer.first.channels;
            }
        }
        candidates{first(), second(), third()}(guides, std::span<const output, 3>(memory.passes.data(), 3), executor,
                                               memory);
    }

    /// Lines 15 to 25: the share of each candidate in each pixel, and the estimated error of what they add up to.
    template <class Passes, class Guides>
    void select(const Passes& passes, const Guides& guides, const std::array<candidate_images, 3>& candidate,
                const image_view<float>& share, const image_view<float>& error, scratch_images images) const {
        constexpr int statistics = Selection::statistics;
        const extent size = share.size;
        const std::ptrdiff_t plane = size.pixels();
        const image_view<float> raw = images.take(statistics), smooth = images.take(statistics), map = images.take(3);
        const source u = guides.find(color), noise = guides.find(variance(color));
        const auto pixel = [&](std::ptrdiff_t i) {
            rdfc_candidates_pixel p;
            const int x = static_cast<int>(i % size.width), y = static_cast<int>(i / size.width);
            for (int c = 0; c < 3; ++c) {
                p.input[c] = contained(u.channel(c), x, y);
                p.variance[c] = contained(noise.channel(c), x, y);
                for (int k = 0; k < 3; ++k) {
                    p.filtered[k][c] = candidate[k].mean.data[i + c * plane];
                    p.derivative[k][c] = candidate[k].derivative.data[i + c * plane];
                }
            }
            return p;
        };
        passes.for_each_pixel(size, [&](std::ptrdiff_t i) {
            const auto s = Selection::gather(pixel(i));
            for (int j = 0; j < statistics; ++j) raw.data[i + j * plane] = s[j];
        });
        passes.apply(smoothing(selection.error_radius), guides, raw, smooth);
        const auto smoothed = [&](std::ptrdiff_t i) {
            std::array<float, statistics> s;
            for (int j = 0; j < statistics; ++j) s[j] = smooth.data[i + j * plane];
            return s;
        };
        passes.for_each_pixel(size, [&](std::ptrdiff_t i) {
            const auto s = Selection::decide(smoothed(i), pixel(i));
            for (int k = 0; k < 3; ++k) map.data[i + k * plane] = s[k];
        });
        passes.apply(smoothing(selection.map_radius), guides, map, share);
        passes.for_each_pixel(size, [&](std::ptrdiff_t i) {
            float* const s = share.data + i;
            const float sum = s[0] + s[plane] + s[2 * plane];  // 1 but for rounding
            for (int k = 0; k < 3; ++k) s[k * plane] /= sum;
            error.data[i] = Selection::error(smoothed(i), {s[0], s[plane], s[2 * plane]});
        });
    }

    /// sum_k share_k x_k at one value of the candidates' images.
    static float mixed(const image_view<float>& share, std::ptrdiff_t i, float first, float second, float third) {
        const std::ptrdiff_t plane = share.size.pixels(), pixel = i % plane;
        const float* s = share.data + pixel;
        return s[0] * first + s[plane] * second + s[2 * plane] * third;
    }

    template <class Passes>
    void write_estimates(const Passes& passes, const std::array<candidate_images, 3>& candidate,
                         const image_view<float>& share, const image_view<float>& error, const output& out,
                         const target& selected) const {
        const auto write = [&](const target& to, const auto& value) {
            if (to)
                for_each_row(passes.executor(), to.size, [&](int y) {
                    for (int c = 0; c < to.channels; ++c)
                        for (int x = 0; x < to.size.width; ++x)
                            to.channel(c).set(x, y, value(c, std::ptrdiff_t{y} * to.size.width + x));
                });
        };
        const std::ptrdiff_t plane = share.size.pixels();
        const auto of = [&](auto image, std::ptrdiff_t i) {
            return mixed(share, i, (candidate[0].*image).data[i], (candidate[1].*image).data[i],
                         (candidate[2].*image).data[i]);
        };
        write(out.error(), [&](int, std::ptrdiff_t i) { return error.data[i]; });
        write(out.derivative(),
              [&](int c, std::ptrdiff_t i) { return of(&candidate_images::derivative, i + c * plane); });
        write(out.support(), [&](int, std::ptrdiff_t i) { return of(&candidate_images::support, i); });
        write(selected, [&](int c, std::ptrdiff_t i) { return share.data[i + c * plane]; });
    }

    /// Line 26: the first candidate becomes the average of all.
    template <class Passes>
    static void average(const Passes& passes, const std::array<candidate_images, 3>& candidate,
                        const image_view<float>& share) {
        for (const auto image : {&candidate_images::mean, &candidate_images::half_a, &candidate_images::half_b,
                                 &candidate_images::further}) {
            const float *second = (candidate[1].*image).data, *third = (candidate[2].*image).data;
            float* const first = (candidate[0].*image).data;
            passes.for_each_value(candidate[0].*image,
                                  [&](std::ptrdiff_t i) { return mixed(share, i, first[i], second[i], third[i]); });
        }
    }

    /// Lines 27 to 29: what noise the halves still show is filtered away, by itself.
    template <class Passes>
    void second_pass(const Passes& passes, const std::array<candidate_images, 3>& candidate, const output& out) const {
        const candidate_images& averaged = candidate[0];
        const image_view<float> between = candidate[1].derivative, noise = candidate[2].derivative;
        passes.residual_variance(averaged.half_a, averaged.half_b, numbers.half_share, between, noise);
        output& pass = passes.memory().pass(out.mean()).halves(out.half_a(), out.half_b());
        int channel = 0;
        for (const auto& layer : out.layers()) {
            pass.layer(averaged.further.channel(channel, layer.first.channels), layer.second);
            channel += layer.first.channels;
        }
        last()(frame{color = averaged.mean, variance(color) = noise, first_half(color) = averaged.half_a,
                     second_half(color) = averaged.half_b},
               pass, passes.executor(), passes.memory());
    }
};

/// What a run over an image of this size will take; `further` counts the planes of further layers, `frames` those
/// around that a sequence has.
template <class Features, class Selection, executor_policy Executor>
run_plan plan(const rdfc_of<Features, Selection>& f, extent size, const Executor& executor, int further = 0,
              int frames = 0) {
    run_plan p = plan(candidates{f.first(), f.second(), f.third()}, size, executor, 9 + further);
    p.image_bytes = scratch_images::bytes(size, f.scratch_planes(frames, further));
    p.passes = 4 + 2 * rdfc_of<Features, Selection>::features::count;
    p.halo = halo(f);
    return p;
}

/// The features that renderers have, and the direct visibility of the lights that the paper introduces.
using rdfc = rdfc_of<planes<albedo_t, normal_t, depth_t, visibility_t>>;

}  // namespace winnow::paper
