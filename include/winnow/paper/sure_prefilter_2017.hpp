// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A pre-filter for the features that depth of field and motion blur make noisy: along each pixel's own distribution of
/// world positions, as far as Stein's estimate of the error of a position says.
/// Moon, Iglesias-Guitian, McDonagh, Mitchell, "Noise Reduction on G-Buffers for Monte Carlo Filtering", 2017.
#include <winnow/filter/clean_feature.hpp>
#include <winnow/filter/restraint.hpp>
#include <winnow/paper/sure_prefilter_2017_bandwidth.hpp>
#include <winnow/weight/local_gaussian.hpp>

namespace winnow::paper {

/// Features: the buffers to clean.  Position: where the samples of a pixel lie; rest_position_t is the paper's, which
/// stays with moving objects, position_t where a renderer has no other.  Noise: which of two estimates finds the
/// bandwidth.
///
/// Reads the mean of the positions and their covariance; as far as they are there, how many samples a pixel has, and
/// the halves of positions and features.  What noise is left in a feature is known only where there are halves.
template <class Features, guide Position = position_t, estimator::noise Noise = estimator::noise::isotropic>
struct sure_prefilter_of;

template <guide... Feature, guide Position, estimator::noise Noise>
struct sure_prefilter_of<planes<Feature...>, Position, Noise> {
    using features = planes<Feature...>;
    using reads = planes<Position, covariance_of<Position>, Feature...>;
    using optional = planes<sample_count_t, half_a<Position>, half_b<Position>, half_a<Feature>..., half_b<Feature>...>;

    sure_prefilter_numbers numbers{};

    /// The cleaned features, in images of memory.clean.  `chosen`, where it is given, gets the bandwidth of each pixel,
    /// in units of the spread of its samples.
    template <frame_with<reads> Frame, executor_policy Executor>
    std::array<cleaned_feature, sizeof...(Feature)> operator()(const Frame& in, const Executor& executor,
                                                               workspace& memory, const target& chosen = {}) const {
        const extent size = check(in, chosen);
        scratch_images kept(memory.clean, size, 4 * features::count), images(memory.images, size, scratch_planes);
        const pass_runner passes(executor, memory);
        const image_view<float> precisions = images.take(6), map = images.take(1);
        scratch_images between = images;
        memory.progress.enter(0, 0.4f);
        bandwidth_search().find(passes, in, precisions, map, between);
        if (chosen)
            for_each_row(executor, size, [&](int y) {
                for (int x = 0; x < size.width; ++x) chosen.set(x, y, map.at(x, y));
            });

        const std::array results{take_results(in, Feature{}, kept)...};
        const image_view<float> smooth = images.take(3);
        // Filters some images of each feature, all with the same weights.
        const auto filter_along = [&](source positions, float smoothing, const auto&... pairs) {
            if (smoothing > 0) {
                passes.blur(positions, smooth, smoothing);
                positions = smooth;
            }
            output& pass = memory.pass({});
            int index = 0;
            const auto add = [&](auto g) {
                const result_images& r = results[static_cast<std::size_t>(index++)];
                const auto add_one = [&](const auto& from, auto to) {
                    if ((r.*to).data) pass.layer(from(g), r.*to);
                };
                (add_one(pairs.first, pairs.second), ...);
            };
            (add(Feature{}), ...);
            if (pass.layers().empty()) return;
            const frame guides{Position{} = positions, precision(Position{}) = precisions, bandwidth = map};
            along_positions()(filtering(Position{}, guides), pass, executor, memory);
        };
        const auto whole = [&](auto g) { return in.find(g); };
        const auto first = [&](auto g) { return in.find(first_half(g)); };
        const auto second = [&](auto g) { return in.find(second_half(g)); };
        const source positions = in.find(Position{});
        memory.progress.enter(0.4f, 0.6f);
        if (numbers.noise == noise_left::by_whole) {
            filter_along(positions, numbers.guide_smoothing, std::pair(whole, &result_images::mean),
                         std::pair(first, &result_images::half_a), std::pair(second, &result_images::half_b));
        } else {
            filter_along(positions, numbers.guide_smoothing, std::pair(whole, &result_images::mean));
            const auto filter_half = [&](const auto& half, auto to) {
                const source along = half(Position{}) ? half(Position{}) : positions;
                if (numbers.noise == noise_left::by_halves)
                    filter_along(along, numbers.half_smoothing, std::pair(half, to));
                else filter_along(along, numbers.half_smoothing, std::pair(whole, to));
            };
            memory.progress.enter(0.6f, 0.8f);
            filter_half(first, &result_images::half_a);
            memory.progress.enter(0.8f, 1);
            filter_half(second, &result_images::half_b);
        }

        const float share = numbers.noise == noise_left::by_positions ? 1 : share_of_halves();
        const image_view<float> squared = images.take(largest_feature);
        std::array<cleaned_feature, sizeof...(Feature)> cleaned;
        for (std::size_t i = 0; i < results.size(); ++i) {
            const result_images& r = results[i];
            cleaned[i].mean = r.mean;
            if (!r.half_a.data) continue;
            if (numbers.restraint > 0) restrain_feature(passes, in, i, r, images);
            passes.residual_variance(r.half_a, r.half_b, share, squared.channel(0, r.mean.channels), r.variance);
            cleaned[i] = {r.mean, r.variance, r.half_a, r.half_b};
        }
        return cleaned;
    }
    bool operator==(const sure_prefilter_of&) const = default;

    /// How far from a pixel its result can depend on the input, in pixels.
    friend int halo(const sure_prefilter_of& f) {
        const auto blur = [](float sigma) { return static_cast<int>(std::ceil(3 * sigma)) + 1; };
        const int guides = std::max(blur(f.numbers.guide_smoothing), blur(f.numbers.half_smoothing));
        return std::max(halo(f.bandwidth_search()), guides) + halo(f.along_positions()) + blur(0.5f);
    }

    // What it is made of.
    auto bandwidth_search() const { return position_bandwidth<Position, Noise>{numbers}; }
    auto along_positions() const {
        return filter{gaussian(mahalanobis(Position{}), bandwidth), window::square{.radius = numbers.radius}};
    }

    static constexpr int largest_feature = std::max({Feature::channels...});
    /// Planes of the workspace that a run takes, beside those of its results.
    static constexpr int scratch_planes =
        6 + 1 + std::max(position_bandwidth<Position, Noise>::scratch_planes, 3 + largest_feature + 4);

private:
    /// The halves and the variance are empty where they are not known.
    struct result_images {
        image_view<float> mean, half_a, half_b, variance;
    };
    template <class Frame, guide G>
    result_images take_results(const Frame& in, G g, scratch_images& kept) const {
        result_images r;
        r.mean = kept.take(G::channels);
        if (!(numbers.noise == noise_left::by_positions ? has_halves(in, Position{}) : has_halves(in, g))) return r;
        r.half_a = kept.take(G::channels);
        r.half_b = kept.take(G::channels);
        r.variance = kept.take(G::channels);
        return r;
    }

    /// Of the index-th feature.
    template <class Passes, class Frame>
    void restrain_feature(const Passes& passes, const Frame& in, std::size_t index, const result_images& r,
                          const scratch_images& images) const {
        std::size_t i = 0;
        const auto restrain_one = [&](auto g) {
            if (i++ == index && has_halves(in, g))
                restrain(passes, in.find(g), in.find(first_half(g)), in.find(second_half(g)), r.mean, r.half_a,
                         r.half_b, numbers.restraint, images);
        };
        (restrain_one(Feature{}), ...);
    }

    template <class Frame>
    extent check(const Frame& in, const target& chosen) const {
        const extent size = bandwidth_search().check(in);
        const auto check_one = [&](auto g, const source& layer) {
            if (layer) detail::check_layer(g, layer, g.channels, size, Position{});
        };
        const auto check_feature = [&](auto g) {
            check_one(g, detail::find_or_fail(in, g));
            check_one(first_half(g), in.find(first_half(g)));
            check_one(second_half(g), in.find(second_half(g)));
        };
        check_feature(Position{});
        (check_feature(Feature{}), ...);
        if (chosen) detail::check_layer("the output of the bandwidths", source(chosen), 1, size, Position{});
        return size;
    }
};

/// What a run over an image of this size will take.
template <class Features, class Position, estimator::noise Noise, executor_policy Executor>
run_plan plan(const sure_prefilter_of<Features, Position, Noise>& f, extent size, const Executor& executor) {
    run_plan p = plan(f.bandwidth_search().all_candidates(), size, executor, 0);
    const run_plan filtering = plan(f.along_positions(), size, executor, Features::count);
    p.scratch_bytes = std::max(p.scratch_bytes, filtering.scratch_bytes);
    p.image_bytes = scratch_images::bytes(size, f.scratch_planes + 4 * Features::count);
    p.passes = 4;
    p.halo = halo(f);
    return p;
}

/// The features that renderers have.
using sure_prefilter = sure_prefilter_of<planes<albedo_t, normal_t, depth_t>>;

}  // namespace winnow::paper
