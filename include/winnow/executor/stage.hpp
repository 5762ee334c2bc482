// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Staging: one tile of the frame, with its halo, as float planes in the executor's own memory.  Whatever the caller's
/// buffers are like (half, interleaved, bad pixels, a border nearby), a policy meets only such planes.
#include <cstddef>
#include <cstring>
#include <limits>
#include <winnow/executor/sweep.hpp>
#include <winnow/frame/pixel_pair.hpp>

namespace winnow {

/// A tile in staged memory.
struct staged_tile {
    rectangle region;  ///< the pixels that are staged: the tile and its halo
    float* origin;     ///< plane 0 (the coverage) at the region's upper left pixel
    pitch step;

    float* at(int plane, int x, int y) const {
        return origin + plane * step.plane + (y - region.y0) * step.row + (x - region.x0);
    }
};

namespace detail {

/// What a plane may hold; values beyond are cut.
struct value_range {
    float lowest = -std::numeric_limits<float>::max();
    float highest = std::numeric_limits<float>::max();

    float operator()(float value) const { return std::clamp(value, lowest, highest); }
};

/// Renderers write 1e30 for the depth of the sky.  Guides and variances are cut so that squared differences and sums of
/// variances stay finite: then no distance is NaN.
template <class G>
inline constexpr value_range range_of = is_variance<G> ? value_range{0.0f, 1e30f} : value_range{-1e15f, 1e15f};

inline void stage_plane(const source& from, const staged_tile& tile, int plane, border rule, value_range range) {
    const int width = from.size.width, height = from.size.height;
    const int inside0 = std::clamp(0, tile.region.x0, tile.region.x1);
    const int inside1 = std::clamp(width, inside0, tile.region.x1);
    for (int y = tile.region.y0; y < tile.region.y1; ++y) {
        float* row = tile.at(plane, tile.region.x0, y) - tile.region.x0;  // row[x] is the pixel at x
        // Batches read past the end of a row; what they find there must be a number.
        std::fill(row + tile.region.x1, row + tile.region.x0 + tile.step.plane, 0.0f);
        const int from_y = resolve(rule, y, height);
        if (from_y < 0) {
            std::fill(row + tile.region.x0, row + tile.region.x1, 0.0f);
            continue;
        }
        if (from.type == scalar::float32 && from.step.pixel == sizeof(float))
            std::memcpy(row + inside0, from.data + from_y * from.step.row + inside0 * from.step.pixel,
                        sizeof(float) * static_cast<std::size_t>(inside1 - inside0));
        else
            for (int x = inside0; x < inside1; ++x) row[x] = from.at(x, from_y);
        int bad = 0;  // no bool: compilers use lanes for the sum of numbers
        for (int x = inside0; x < inside1; ++x) bad += !is_finite(row[x]);
        if (bad > 0)
            for (int x = inside0; x < inside1; ++x)
                if (!is_finite(row[x])) row[x] = contained(from, x, from_y);
        for (int x = inside0; x < inside1; ++x) row[x] = range(row[x]);
        const auto outside = [&](int x) {
            const int from_x = resolve(rule, x, width);
            return from_x < 0 ? 0.0f : range(contained(from, from_x, from_y));
        };
        for (int x = tile.region.x0; x < inside0; ++x) row[x] = outside(x);
        for (int x = inside1; x < tile.region.x1; ++x) row[x] = outside(x);
    }
}

inline void stage_coverage(extent size, const staged_tile& tile, border rule) {
    for (int y = tile.region.y0; y < tile.region.y1; ++y)
        for (int x = tile.region.x0; x < tile.region.x1; ++x)
            *tile.at(0, x, y) = resolve(rule, x, size.width) >= 0 && resolve(rule, y, size.height) >= 0 ? 1.0f : 0.0f;
    for (int y = tile.region.y0; y < tile.region.y1; ++y)
        std::fill(tile.at(0, tile.region.x1, y), tile.at(0, tile.region.x0, y) + tile.step.plane, 0.0f);
}

/// See gradient_of.  On the rim of the region, where a neighbour is not staged, it is 0; no policy looks there.
inline void stage_gradient(extent size, const staged_tile& tile, int from, int to) {
    const auto& r = tile.region;
    const auto smaller = [](float before, float here, float after) {
        const float a = (here - before) / 2, b = (after - here) / 2;
        return std::min(a * a, b * b);
    };
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x) {
            float sum = 0;
            const float here = *tile.at(from, x, y);
            if (x > std::max(r.x0, 0) && x + 1 < std::min(r.x1, size.width))
                sum += smaller(*tile.at(from, x - 1, y), here, *tile.at(from, x + 1, y));
            if (y > std::max(r.y0, 0) && y + 1 < std::min(r.y1, size.height))
                sum += smaller(*tile.at(from, x, y - 1), here, *tile.at(from, x, y + 1));
            *tile.at(to, x, y) = sum;
        }
}

template <class G>
struct gradient_source;
template <class G>
struct gradient_source<gradient_of<G>> {
    using type = G;
};

}  // namespace detail

/// The number of planes that a sweep stages of one frame: coverage, guides, values.
template <class Sweep>
int planes_of_frame(const sweep_buffers& buffers) {
    return 1 + Sweep::reads::count + static_cast<int>(buffers.values.size());
}
/// The same of all frames.
template <class Sweep>
int staged_planes(const sweep_buffers& buffers) {
    return buffers.frames * planes_of_frame<Sweep>(buffers);
}

/// Fills the planes of a tile.  Value v lies in plane 1 + reads::count + v; further frames follow in the same order.
template <class Sweep>
void stage(const Sweep& sweep, const sweep_buffers& buffers, const staged_tile& tile) {
    using reads = typename Sweep::reads;
    // Between the planes of a row and the next row, too, there must be numbers.
    const std::ptrdiff_t used = staged_planes<Sweep>(buffers) * tile.step.plane;
    for (int y = tile.region.y0; y < tile.region.y1; ++y)
        std::fill(tile.at(0, tile.region.x0, y) + used, tile.at(0, tile.region.x0, y) + tile.step.row, 0.0f);
    for (int f = 0; f < buffers.frames; ++f) {
        const frame_planes& frame = f == 0 ? buffers : buffers.others[static_cast<std::size_t>(f - 1)];
        staged_tile part = tile;
        part.origin += f * planes_of_frame<Sweep>(buffers) * tile.step.plane;
        detail::stage_coverage(buffers.size, part, sweep.rule);
        reads::for_each([&]<class G>(G) {
            for (int c = 0; c < G::channels; ++c) {
                const int slot = slot_of<G>(reads{}) + c;
                if constexpr (!detail::is_gradient<G>)
                    detail::stage_plane(frame.guides[slot], part, 1 + slot, sweep.rule, detail::range_of<G>);
            }
        });
        reads::for_each([&]<class G>(G) {
            if constexpr (detail::is_gradient<G>)
                for (int c = 0; c < G::channels; ++c)
                    detail::stage_gradient(buffers.size, part,
                                           1 + slot_of<typename detail::gradient_source<G>::type>(reads{}) + c,
                                           1 + slot_of<G>(reads{}) + c);
        });
        for (int v = 0; v < static_cast<int>(frame.values.size()); ++v)
            detail::stage_plane(frame.values[v], part, 1 + reads::count + v, sweep.rule, {});
    }
}

}  // namespace winnow
