// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// WLR over a tile, as executors run it.
/// Moon, Carr, Yoon, "Adaptive Rendering based on Weighted Local Regression", 2014.
#include <winnow/executor/run.hpp>
#include <winnow/executor/stage.hpp>
#include <winnow/paper/wlr_2014_pixel.hpp>

namespace winnow::paper {

/// One tile: bandwidths of its pixels and of a rim around it, the blur of the bandwidths, then the final fits.
template <class Real, class Features>
struct wlr_kernel {
    const wlr_numbers& numbers;
    const wlr_selection& selection;
    extent wanted_tile;

    /// So wide that with its rim it fills whole batches.
    template <class Sweep>
    extent tile_size(const Sweep&, const sweep_buffers& buffers) const {
        const int width = std::min(wanted_tile.width, buffers.size.width) + 2 * rim();
        return {std::max(1, detail::ceil_div(width, lanes) * lanes - 2 * rim()),
                std::max(1, std::min(wanted_tile.height, buffers.size.height))};
    }
    template <class Sweep>
    std::size_t scratch_bytes(const Sweep& sweep, const sweep_buffers& buffers) const {
        return memory_of(sweep, buffers, nullptr).bytes;
    }

    template <class Sweep>
    void operator()(const Sweep& sweep, const sweep_buffers& buffers, rectangle tile, std::byte* scratch) const {
        const auto memory = memory_of(sweep, buffers, scratch);
        const int reach = window_reach(sweep, buffers.size);
        rectangle rimmed = tile.grown(rim());
        rimmed.x1 = rimmed.x0 + memory.columns * lanes;
        const staged_tile staged{rimmed.grown(reach), memory.planes, memory.step};
        stage(sweep, buffers, staged);

        int real = 0;
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) memory.neighbours[real++] = {dy * memory.step.row + dx, dx, dy};
        const int padded = padded_count(reach);
        for (int i = real; i < padded; ++i) memory.neighbours[i] = {0, 0, 0};
        using pixel = wlr_pixel<Real, Features, typename Sweep::reads>;
        pixel at(numbers, memory.neighbours, real, padded, memory.step, memory.work);

        const int rows = rimmed.size().height, width = memory.columns * lanes;
        for (int y = 0; y < rows; ++y)
            for (int b = 0; b < memory.columns; ++b)
                at.choose(staged.at(0, rimmed.x0 + b * lanes, rimmed.y0 + y), selection,
                          memory.models[y * memory.columns + b], memory.bandwidths + y * width + b * lanes);
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int b = 0; b < memory.columns; ++b) {
                const int x0 = rimmed.x0 + b * lanes;
                float smooth[lanes];
                for (int i = 0; i < lanes; ++i)
                    smooth[i] = blurred(memory.bandwidths, rimmed, width, buffers.size, tile, x0 + i, y);
                const auto& model = memory.models[(y - rimmed.y0) * memory.columns + b];
                const float* const p = staged.at(0, x0, y);
                at.fit(p, model, batch_of<Real>::load(smooth));
                write(sweep, buffers, tile, at, model, p, smooth, x0, y);
            }
    }

private:
    static constexpr int lanes = batch_of<Real>::size;
    using model = wlr_model<Real, wlr_regressors<Features>::count>;

    int rim() const { return static_cast<int>(3 * numbers.smoothing + 0.5f); }
    static int padded_count(int reach) {
        constexpr int group = 4;
        return detail::ceil_div((2 * reach + 1) * (2 * reach + 1), group) * group;
    }

    /// The parts of the scratch memory; nothing is read behind a null base.
    struct parts {
        int columns;  ///< batches in a row
        pitch step;
        float* planes;
        wlr_neighbour* neighbours;
        Real* work;
        model* models;
        float* bandwidths;
        std::size_t bytes;
    };
    template <class Sweep>
    parts memory_of(const Sweep& sweep, const sweep_buffers& buffers, std::byte* base) const {
        parts m;
        const extent tile = tile_size(sweep, buffers);
        const int reach = window_reach(sweep, buffers.size), rows = tile.height + 2 * rim();
        m.columns = detail::ceil_div(tile.width + 2 * rim(), lanes);
        m.step.plane = m.columns * lanes + 2 * reach;
        m.step.row = m.step.plane * staged_planes<Sweep>(buffers);
        std::size_t offset = 0;
        const auto take = [&]<class T>(T*& part, std::size_t count) {
            part = base ? reinterpret_cast<T*>(base + offset) : nullptr;
            offset += detail::aligned(sizeof(T) * count);
        };
        take(m.planes, static_cast<std::size_t>(m.step.row * (rows + 2 * reach)));
        take(m.neighbours, static_cast<std::size_t>(padded_count(reach)));
        take(m.work, wlr_pixel<Real, Features, typename Sweep::reads>::reals(padded_count(reach)));
        take(m.models, static_cast<std::size_t>(m.columns * rows));
        take(m.bandwidths, static_cast<std::size_t>(m.columns * lanes * rows));
        m.bytes = offset;
        return m;
    }

    /// The Gaussian mean of the bandwidths around a pixel of the tile, as far as the image goes.
    float blurred(const float* bandwidths, rectangle rimmed, int width, extent size, rectangle tile, int x,
                  int y) const {
        if (x < tile.x0 || x >= tile.x1) return 1;
        double sum = 0, total = 0;
        for (int j = std::max(0, y - rim()); j <= std::min(size.height - 1, y + rim()); ++j)
            for (int i = std::max(0, x - rim()); i <= std::min(size.width - 1, x + rim()); ++i) {
                const double distance = (i - x) * (i - x) + (j - y) * (j - y);
                const double w = distance == 0 ? 1 : std::exp(-distance / (2 * numbers.smoothing * numbers.smoothing));
                sum += w * bandwidths[(j - rimmed.y0) * width + (i - rimmed.x0)];
                total += w;
            }
        return static_cast<float>(sum / total);
    }

    template <class Sweep, class Pixel>
    static void write(const Sweep&, const sweep_buffers& buffers, rectangle tile, const Pixel& at, const model& m,
                      const float* p, const float* bandwidth, int x0, int y) {
        const auto put = [&](const target& to, const auto& value) {
            if (!to) return;
            float values[lanes];
            batch_of<Real>::store(value(), values);
            for (int i = std::max(0, tile.x0 - x0); i < std::min(lanes, tile.x1 - x0); ++i)
                to.set(x0 + i, y, values[i]);
        };
        const int values = static_cast<int>(buffers.values.size());
        for (int v = 0; v < values; ++v)
            put(buffers.results[static_cast<std::size_t>(v)],
                [&] { return at.apply(p, at.of().plane_of_value(v), false); });
        put(buffers.supports[0], [&] { return at.support(); });
        for (int c = 0; c < buffers.channels; ++c)
            put(buffers.errors[static_cast<std::size_t>(c)], [&] {
                const Real h = batch_of<Real>::load(bandwidth), squared = h * h;
                return math::fma(m.squared_bias[c] * squared, squared,
                                 at.apply(p, at.of().plane_of(variance(color), c), true));
            });
    }
};

}  // namespace winnow::paper
