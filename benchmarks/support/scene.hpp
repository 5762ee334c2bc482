// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// One noisy frame for all benchmarks: random, because constant data would flatter branch predictors and denormals.
#include <random>
#include <winnow/frame/frame.hpp>
#include <winnow/image/image.hpp>

namespace winnow::benchmarks {

/// Colour with known noise, a checkered albedo, noisy normals, a ramp of depth, positions that spread as those of
/// things in motion do; halves whose mean is the colour.
struct scene {
    explicit scene(extent size)
        : color(size, 3),
          half_a(size, 3),
          half_b(size, 3),
          color_variance(size, 3),
          half_variance(size, 3),
          albedo(size, 3),
          normal(size, 3),
          depth(size, 1),
          feature_variance(size, 3),
          position(size, 3),
          spread(size, 6),
          result(size, 3),
          result_a(size, 3),
          result_b(size, 3) {
        std::mt19937 random(1);
        std::normal_distribution<float> noise(0, 0.3f);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const float checker = (x / 16 + y / 16) % 2 ? 0.8f : 0.2f;
                for (int c = 0; c < 3; ++c) {
                    half_a.at(x, y, c) = checker + 1.4f * noise(random);
                    half_b.at(x, y, c) = checker + 1.4f * noise(random);
                    color.at(x, y, c) = (half_a.at(x, y, c) + half_b.at(x, y, c)) / 2;
                    color_variance.at(x, y, c) = 0.09f;
                    half_variance.at(x, y, c) = 0.18f;
                    albedo.at(x, y, c) = checker;
                    normal.at(x, y, c) = 0.5f + 0.03f * noise(random);
                    feature_variance.at(x, y, c) = 1e-4f;
                }
                depth.at(x, y) = static_cast<float>(x) / static_cast<float>(size.width);
                position.at(x, y, 0) = 0.01f * (static_cast<float>(x) + 3 * noise(random));
                position.at(x, y, 1) = 0.01f * (static_cast<float>(y) + noise(random));
                spread.at(x, y, 0) = 1e-3f;
                spread.at(x, y, 3) = 1e-4f;
                spread.at(x, y, 5) = 1e-6f;
            }
    }

    /// The buffers of the pixels of r, under their names.
    auto frame(rectangle r) const {
        const auto part = [&r](const image<float>& i) { return i.view().crop(r); };
        return winnow::frame{winnow::color = part(color),
                             variance(winnow::color) = part(color_variance),
                             first_half(winnow::color) = part(half_a),
                             second_half(winnow::color) = part(half_b),
                             variance(first_half(winnow::color)) = part(half_variance),
                             variance(second_half(winnow::color)) = part(half_variance),
                             winnow::albedo = part(albedo),
                             variance(winnow::albedo) = part(feature_variance),
                             winnow::normal = part(normal),
                             variance(winnow::normal) = part(feature_variance),
                             winnow::depth = part(depth),
                             variance(winnow::depth) = part(feature_variance).channel(0),
                             first_half(winnow::albedo) = part(albedo),
                             second_half(winnow::albedo) = part(half_b),
                             first_half(winnow::normal) = part(normal),
                             second_half(winnow::normal) = part(half_a),
                             first_half(winnow::depth) = part(depth),
                             second_half(winnow::depth) = part(albedo).channel(0),
                             winnow::position = part(position),
                             first_half(winnow::position) = part(position),
                             second_half(winnow::position) = part(position),
                             covariance(winnow::position) = part(spread)};
    }
    auto frame() const { return frame({0, 0, color.size().width, color.size().height}); }

    image<float> color, half_a, half_b, color_variance, half_variance, albedo, normal, depth, feature_variance;
    image<float> position, spread;
    image<float> result, result_a, result_b;
};

}  // namespace winnow::benchmarks
