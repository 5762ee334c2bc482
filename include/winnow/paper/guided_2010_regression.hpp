// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The linear regressions of the guided filter, and their definition: pixel by pixel, window by window.
#include <winnow/core/cholesky.hpp>
#include <winnow/executor/finish.hpp>
#include <winnow/filter/filter.hpp>

namespace winnow::paper {

/// In each window k the colour is taken for a linear function of the guides,  a_k . (g - mean_k g) + mean_k u,  with
///     a_k = (cov_k(g, g) + epsilon I)^-1 cov_k(g, u),
/// and a pixel becomes the mean of what all windows around it say.  Means are over the pixels that exist.
template <class Guides, class Estimator>
struct guided_regression {
    using reads = joined<Guides, typename Estimator::reads>;
    static constexpr int count = 1, guides = Guides::count;
    static constexpr border rule = border::clip;
    /// Beyond these a value is cut, so that its covariance with a guide is finite (see range_of).
    static constexpr detail::value_range values{-1e20f, 1e20f};

    window::square window;
    float epsilon;
    Estimator estimator;

    /// A window and the windows in it, and one pixel more, because a bad pixel is mended from its neighbours.
    friend int halo(const guided_regression& f) { return 2 * f.window.radius + 1; }

    /// The radius, as far as an image of this size can feel it.
    int radius_in(extent size) const { return std::min(window.radius, std::max(size.width, size.height)); }

    /// Stages the guides on a region, one plane after another, `plane` floats apart; rows are `row` floats apart.
    static void stage_guides(const sweep_buffers& buffers, rectangle region, float* to, std::ptrdiff_t row,
                             std::ptrdiff_t plane) {
        Guides::for_each([&]<class G>(G) {
            for (int c = 0; c < G::channels; ++c) {
                const int i = slot_of<G>(reads{}) + c;
                detail::stage_plane(buffers.guides[i], {region, to + i * plane, {row, row}}, 0, rule,
                                    detail::range_of<G>);
            }
        });
    }
    static void stage_value(const source& from, rectangle region, float* to, std::ptrdiff_t row) {
        detail::stage_plane(from, {region, to, {row, row}}, 0, rule, values);
    }
};

/// What write_row asks of a row of filtered pixels, where a filter has neither weights nor derivatives.
struct guided_row {
    const sweep_buffers& buffers;
    const float* results;
    std::ptrdiff_t plane;  ///< floats between one value's results and the next's
    int x0, y;

    float filtered(int v, int x) const { return results[v * plane + x - x0]; }
    float input(int v, int x) const { return contained(buffers.values[v], x, y); }
    float support(int) const { return 1; }
    float derivative(int, int) const { return 0; }
    float variance(int, int) const { return 0; }
};

/// Hands out parts of a tile's memory; of none at all, only their sizes.
class scratch_parts {
public:
    explicit scratch_parts(std::byte* base) : base_(base) {}

    template <class T>
    T* take(std::ptrdiff_t count) {
        T* const part = base_ ? reinterpret_cast<T*>(base_ + bytes_) : nullptr;
        bytes_ += winnow::detail::aligned(sizeof(T) * static_cast<std::size_t>(count));
        return part;
    }
    std::size_t bytes() const { return bytes_; }

private:
    std::byte* base_;
    std::size_t bytes_ = 0;
};

/// The definition, in Real arithmetic: means, and covariances about the means, as sums over each window.
template <class Real>
struct guided_pixel_by_pixel {
    int tile_rows = 16;

    template <class Regression>
    extent tile_size(const Regression&, const sweep_buffers& buffers) const {
        return {std::max(1, buffers.size.width), tile_rows};
    }
    template <class Regression>
    std::size_t scratch_bytes(const Regression& f, const sweep_buffers& buffers) const {
        const extent tile = tile_size(f, buffers);
        scratch_parts parts(nullptr);
        const work<Regression> all(f, buffers, {0, 0, tile.width, tile.height}, parts);
        return parts.bytes();
    }
    template <class Regression>
    void operator()(const Regression& f, const sweep_buffers& buffers, rectangle tile, std::byte* scratch) const {
        scratch_parts parts(scratch);
        work<Regression>(f, buffers, tile, parts).run();
    }

private:
    template <class Regression>
    struct work {
        static constexpr int guides = Regression::guides;

        const Regression& f;
        const sweep_buffers& buffers;
        rectangle tile;
        int radius = f.radius_in(buffers.size), values = static_cast<int>(buffers.values.size());
        rectangle region = tile.grown(2 * radius), windows = tile.grown(radius);
        std::ptrdiff_t plane = region.size().pixels();
        int fit_size = guides + values * (1 + guides);
        float *staged, *results;
        Real* fits;

        work(const Regression& f, const sweep_buffers& buffers, rectangle tile, scratch_parts& parts)
            : f(f),
              buffers(buffers),
              tile(tile),
              staged(parts.take<float>(plane * (guides + values))),
              results(parts.take<float>(std::ptrdiff_t{values} * tile.size().width)),
              fits(parts.take<Real>(windows.size().pixels() * fit_size)) {}

        void run() const {
            const int row = region.size().width;
            Regression::stage_guides(buffers, region, staged, row, plane);
            for (int v = 0; v < values; ++v)
                Regression::stage_value(buffers.values[v], region, staged + (guides + v) * plane, row);
            for (int y = std::max(0, windows.y0); y < std::min(buffers.size.height, windows.y1); ++y)
                for (int x = std::max(0, windows.x0); x < std::min(buffers.size.width, windows.x1); ++x) fit(x, y);
            for (int y = tile.y0; y < tile.y1; ++y) {
                for (int v = 0; v < values; ++v)
                    for (int x = tile.x0; x < tile.x1; ++x)
                        results[v * tile.size().width + x - tile.x0] = static_cast<float>(predicted(v, x, y));
                write_row(buffers, f.estimator, 0, tile, y,
                          guided_row{buffers, results, tile.size().width, tile.x0, y});
            }
        }

        /// Guide i, or value i - guides.
        Real at(int i, int x, int y) const {
            return Real(staged[i * plane + std::ptrdiff_t{y - region.y0} * region.size().width + x - region.x0]);
        }
        /// The means of the guides, then of each value its mean and its slopes.
        Real* fit_at(int x, int y) const {
            return fits + (std::ptrdiff_t{y - windows.y0} * windows.size().width + x - windows.x0) * fit_size;
        }
        /// The mean of value(i, j) over the pixels around (x, y) that exist.
        template <class Value>
        Real mean(int x, int y, const Value& value) const {
            Real sum = 0;
            int count = 0;
            for (int j = std::max(0, y - radius); j <= std::min(buffers.size.height - 1, y + radius); ++j)
                for (int i = std::max(0, x - radius); i <= std::min(buffers.size.width - 1, x + radius); ++i, ++count)
                    sum += value(i, j);
            return sum / Real(count);
        }

        void fit(int x, int y) const {
            Real* const means = fit_at(x, y);
            const auto mean_of = [&](int k) { return mean(x, y, [&](int i, int j) { return at(k, i, j); }); };
            const auto covariance = [&](int k, int l, Real mean_k, Real mean_l) {
                return mean(x, y, [&](int i, int j) { return (at(k, i, j) - mean_k) * (at(l, i, j) - mean_l); });
            };
            for (int g = 0; g < guides; ++g) means[g] = mean_of(g);
            symmetric<Real, guides> matrix;
            for (int g = 0; g < guides; ++g)
                for (int h = 0; h <= g; ++h)
                    matrix.at(g, h) = covariance(g, h, means[g], means[h]) + (g == h ? Real(f.epsilon) : 0);
            const cholesky<Real, guides> solver(matrix, Real(f.epsilon));
            for (int v = 0; v < values; ++v) {
                Real slopes[guides], *const of_value = means + guides + v * (1 + guides);
                of_value[0] = mean_of(guides + v);
                for (int g = 0; g < guides; ++g) slopes[g] = covariance(g, guides + v, means[g], of_value[0]);
                solver.solve(slopes);
                std::copy(slopes, slopes + guides, of_value + 1);
            }
        }
        Real predicted(int v, int x, int y) const {
            return mean(x, y, [&](int i, int j) {
                const Real *const means = fit_at(i, j), *const of_value = means + guides + v * (1 + guides);
                Real value = of_value[0];
                for (int g = 0; g < guides; ++g) value += of_value[1 + g] * (at(g, x, y) - means[g]);
                return value;
            });
        }
    };
};

}  // namespace winnow::paper
