// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The guided filter by box sums, tile by tile, at a cost that hardly depends on the radius.
#include <winnow/executor/window_sums.hpp>
#include <winnow/paper/guided_2010_regression.hpp>

namespace winnow::paper {

/// For a tile in the cache, with the windows around it and the pixels in these:
///     the means of the guides, their covariances, and the factors of these;
///     for each value: its mean, its covariances with the guides, slopes and offsets; and their means, applied.
/// Covariances are differences of large numbers: up to them everything is in double, from them on in float.
template <class Lanes>
struct guided_by_tiles {
    extent largest_tile;

    /// A tile is staged with two radii on every side: it is several radii large, whatever the executor's tiles are.
    template <class Regression>
    extent tile_size(const Regression& f, const sweep_buffers& buffers) const {
        const int radius = f.radius_in(buffers.size);
        const auto side = [](int wanted, int least, int all) {
            return std::max(1, std::min(std::max(wanted, least), all));
        };
        return {side(largest_tile.width, 16 * radius, buffers.size.width),
                side(largest_tile.height, 8 * radius, buffers.size.height)};
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
    using wide = typename Lanes::wide;

    /// Planes over some region, each row padded so that lanes may begin anywhere in it.
    template <class T>
    struct padded {
        std::ptrdiff_t row, plane;
        T* data;

        padded(extent size, int planes, scratch_parts& parts)
            : row(box_sums<Lanes>::pitch(size.width)), plane(row * size.height), data(parts.take<T>(plane * planes)) {}
        T* at(int i, int x, int y) const { return data + i * plane + y * row + x; }
    };

    /// One tile.  Pixels count from the upper left of the plane that they are in: a pixel of the tile lies `radius`
    /// further in `windows`, and as much again in `region`.
    template <class Regression>
    struct work {
        static constexpr int guides = Regression::guides;
        /// The plane of the value that is worked on, behind those of the guides.
        static constexpr int current = guides;

        const Regression& f;
        const sweep_buffers& buffers;
        rectangle tile;
        int radius = f.radius_in(buffers.size), values = static_cast<int>(buffers.values.size());
        rectangle region = tile.grown(2 * radius), windows = tile.grown(radius);
        padded<float> staged;
        padded<double> means;
        padded<float> rounded_means, factors, slopes, results;
        padded<double> share_x, share_y;
        padded<float> rounded_share_x;
        box_sums<wide> over_windows{windows.size(), radius};
        box_sums<Lanes> over_fits{tile.size(), radius};
        double* sums;
        float* sums_of_fits;

        work(const Regression& f, const sweep_buffers& buffers, rectangle tile, scratch_parts& parts)
            : f(f),
              buffers(buffers),
              tile(tile),
              staged(region.size(), guides + 1, parts),
              means(windows.size(), guides + 1, parts),
              rounded_means(windows.size(), guides + 1, parts),
              factors(windows.size(), symmetric<Lanes, guides>::count, parts),
              slopes(windows.size(), guides, parts),
              results(tile.size(), values, parts),
              share_x({windows.size().width, 1}, 1, parts),
              share_y({windows.size().height, 1}, 1, parts),
              rounded_share_x({windows.size().width, 1}, 1, parts),
              sums(parts.take<double>(over_windows.reals())),
              sums_of_fits(parts.take<float>(over_fits.reals())) {}

        void run() const {
            share(share_x, windows.x0, windows.x1, buffers.size.width);
            share(share_y, windows.y0, windows.y1, buffers.size.height);
            std::copy(share_x.data, share_x.data + share_x.row, rounded_share_x.data);
            Regression::stage_guides(buffers, region, staged.data, staged.row, staged.plane);
            for (int g = 0; g < guides; ++g) average(g);
            for (int g = 0; g < guides; ++g)
                for (int h = 0; h <= g; ++h) covary(g, h, factors, symmetric<Lanes, guides>::place(g, h));
            factorize();
            for (int v = 0; v < values; ++v) {
                Regression::stage_value(buffers.values[v], region, staged.at(current, 0, 0), staged.row);
                average(current);
                for (int g = 0; g < guides; ++g) covary(current, g, slopes, g);
                fit();
                predict(v);
            }
            for (int y = tile.y0; y < tile.y1; ++y)
                write_row(buffers, f.estimator, 0, tile, y,
                          guided_row{buffers, results.at(0, 0, y - tile.y0), results.plane, tile.x0, y});
        }

        /// 1 / the number of pixels in reach along one axis; 0 outside the image, so that all sums there become 0.
        void share(const padded<double>& to, int first, int last, int size) const {
            std::fill(to.data, to.data + to.row, 0.0);
            for (int i = std::max(0, first); i < std::min(size, last); ++i)
                to.data[i - first] = 1.0 / (std::min(i + radius, size - 1) - std::max(i - radius, 0) + 1);
        }
        /// to(x, y, mean) gets, lanes at a time, the means of value(a, b) over all windows, for neighbours a and b in
        /// two staged planes.
        template <class Value, class To>
        void average_of(int i, int j, const Value& value, const To& to) const {
            over_windows(
                sums,
                [&](int x, int y, double* into) {
                    const float *const a = staged.at(i, x, y), *const b = staged.at(j, x, y);
                    for (int lane = 0; lane < wide::size; ++lane) into[lane] = value(double{a[lane]}, double{b[lane]});
                },
                [&](int y, const double* row) {
                    const wide share(share_y.data[y]);
                    for (int x = 0; x < windows.size().width; x += wide::size)
                        to(x, y, wide::load(row + x) * (wide::load(share_x.data + x) * share));
                });
        }
        void average(int i) const {
            average_of(
                i, i, [](double a, double) { return a; },
                [&](int x, int y, wide mean) {
                    mean.store(means.at(i, x, y));
                    mean.store(rounded_means.at(i, x, y));
                });
        }
        void covary(int i, int j, const padded<float>& to, int plane) const {
            average_of(
                i, j, [](double a, double b) { return a * b; },
                [&](int x, int y, wide mean) {
                    (mean - wide::load(means.at(i, x, y)) * wide::load(means.at(j, x, y))).store(to.at(plane, x, y));
                });
        }

        template <class F>
        static void for_each_lanes(extent size, const F& of) {
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; x += Lanes::size) of(x, y);
        }
        void factorize() const {
            const Lanes ridge(f.epsilon);
            for_each_lanes(windows.size(), [&](int x, int y) {
                symmetric<Lanes, guides> matrix;
                for (int k = 0; k < matrix.count; ++k) matrix.lower[k] = Lanes::load(factors.at(k, x, y));
                for (int g = 0; g < guides; ++g) matrix.at(g, g) = matrix.at(g, g) + ridge;
                const cholesky<Lanes, guides> solver(matrix, ridge);
                for (int k = 0; k < matrix.count; ++k) solver.factors.lower[k].store(factors.at(k, x, y));
            });
        }
        /// Covariances become slopes, and the mean of the value becomes what is left of it where the guides are 0.
        void fit() const {
            for_each_lanes(windows.size(), [&](int x, int y) {
                symmetric<Lanes, guides> known;
                for (int k = 0; k < known.count; ++k) known.lower[k] = Lanes::load(factors.at(k, x, y));
                Lanes slope[guides], offset = Lanes::load(rounded_means.at(current, x, y));
                for (int g = 0; g < guides; ++g) slope[g] = Lanes::load(slopes.at(g, x, y));
                cholesky<Lanes, guides>(known).solve(slope);
                for (int g = 0; g < guides; ++g) {
                    slope[g].store(slopes.at(g, x, y));
                    offset = offset - slope[g] * Lanes::load(rounded_means.at(g, x, y));
                }
                offset.store(rounded_means.at(current, x, y));
            });
        }
        void predict(int v) const {
            average_fits(rounded_means.at(current, 0, 0),
                         [&](int x, int y, Lanes mean) { mean.store(results.at(v, x, y)); });
            for (int g = 0; g < guides; ++g)
                average_fits(slopes.at(g, 0, 0), [&](int x, int y, Lanes mean) {
                    const Lanes guide = Lanes::load(staged.at(g, x + 2 * radius, y + 2 * radius));
                    Lanes::fma(mean, guide, Lanes::load(results.at(v, x, y))).store(results.at(v, x, y));
                });
        }
        /// to(x, y, mean) gets the means of a plane of fits over the windows around each pixel of the tile.
        template <class To>
        void average_fits(const float* plane, const To& to) const {
            over_fits(
                sums_of_fits, [&](int x, int y, float* into) { Lanes::load(plane + y * slopes.row + x).store(into); },
                [&](int y, const float* row) {
                    const Lanes share(static_cast<float>(share_y.data[y + radius]));
                    for (int x = 0; x < tile.size().width; x += Lanes::size)
                        to(x, y, Lanes::load(row + x) * (Lanes::load(rounded_share_x.data + x + radius) * share));
                });
        }
    };
};

}  // namespace winnow::paper
