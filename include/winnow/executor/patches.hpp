// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Means over patches worked out ahead, row by row: what is averaged once for each pixel pair, then sums along y and x,
/// so that the cost of a patch hardly depends on its size.
#include <algorithm>
#include <winnow/executor/lanes.hpp>
#include <winnow/executor/lookup.hpp>
#include <winnow/executor/run.hpp>
#include <winnow/executor/stage.hpp>

namespace winnow {

namespace detail {

/// row(0) + row(1) + ... + row(count - 1), added as a balanced tree: one order for each count, whatever the pixel.
template <int Count, class Row>
WINNOW_HD lanes tree_sum(const Row& row, int first = 0) {
    if constexpr (Count == 1) return row(first);
    else return tree_sum<Count / 2>(row, first) + tree_sum<Count - Count / 2>(row, first + Count / 2);
}

}  // namespace detail

/// Means over patches around the pixels of a tile, for a group of offsets, row by row.  Patches over the same policy
/// share its evaluation; what is inside a patch may hold patches itself.
///
/// With a buffer Varied the slopes of the means that change with it at p come along.  A patch around p and q meets the
/// pixel p twice: in its centre, and, where q is near, as the neighbour of the pixel as far on the other side.
template <class Reads, class Varied, class Patches>
class prepared_patches;

template <class Reads, class Varied>
class prepared_patches<Reads, Varied, std::tuple<>> {
    static constexpr int group = offset_group::largest;

public:
    static constexpr int places = 0;

    prepared_patches(const std::tuple<>&, extent, extent tile, border, int more = 0)
        : width_(detail::ceil_div(tile.width, lanes::size) * lanes::size), more_(more) {}

    int reach() const { return 0; }
    std::size_t floats() const { return std::size_t(group) * more_ * width_; }
    float* at(float* memory, int i, int x) const { return memory + std::ptrdiff_t{i} * more_ * width_ + x; }
    std::ptrdiff_t width() const { return width_; }
    void start(rectangle, offset_group, float*) const {}
    void row(const staged_tile&, rectangle, offset_group, int, float*) const {}

private:
    int width_, more_;
};

template <class Reads, class Varied, class... Patch>
class prepared_patches<Reads, Varied, std::tuple<Patch...>> {
    static constexpr int group = offset_group::largest;

public:
    /// Places of the means and their slopes.
    static constexpr int places = (0 + ... + detail::places_of<Patch, Varied>);

    /// For tiles up to this size; the caller may use `more` places of its own.
    prepared_patches(const std::tuple<Patch...>& patches, extent size, extent tile, border rule, int more = 0)
        : patches_(patches),
          evaluated_(detail::look_up_all<detail::is_patch, void>(inner_of(patches))),
          radius_(std::apply([](const auto&... p) { return std::max({p.radius...}); }, patches)),
          inner_(detail::collect_all<detail::is_patch>(inner_of(patches)), size,
                 rectangle{0, 0, tile.width, tile.height}.grown(radius_).size(), rule),
          size_(size),
          tile_(tile),
          rule_(rule),
          count_(places + more) {
        detail::for_each_node(inner_of(patches_), [&](const auto& node, int i) {
            leaders_[i] = detail::leader(inner_of(patches_), node, i);
        });
    }

    /// How far around a tile it looks: the largest patch of each level.
    int reach() const {
        // Also of a policy that looks around by itself, without being a patch.
        const int inner =
            std::apply([](const auto&... p) { return std::max({detail::reach_of(p.inner)...}); }, patches_);
        return radius_ + std::max(inner, inner_.reach());
    }

    /// Memory for a group of offsets: one row of pixels of each place, then what it takes to work them out.
    std::size_t floats() const { return own_floats() + inner_.floats(); }

    /// Place 0 of the x-th pixel of the row at the i-th offset of the group; the next place is width() floats on.
    float* at(float* memory, int i, int x) const { return memory + std::ptrdiff_t{i} * count_ * width() + x; }
    /// Room for a row of the tile with its patches, and for a last batch that sticks out.
    int width() const { return detail::ceil_div(tile_.width + 2 * radius_ + lanes::size, lanes::size) * lanes::size; }

    /// Starts a group of offsets.
    void start(rectangle tile, offset_group offsets, float* memory) const {
        detail::for_each_node(patches_, [&](const auto& patch, int index) {
            for (int i = 0; i < offsets.size(); ++i)
                for (int x = 0; x < tile.x1 - tile.x0; ++x)
                    share(memory, i, index)[x] = 1.0f / pairs(tile.x0 + x, offsets.dx(i), patch.radius, size_.width);
        });
        inner_.start(tile.grown(radius_), offsets, memory + own_floats());
    }

    /// Works out the means of row y of the tile; rows are asked for one after the other, from the first on.
    void row(const staged_tile& staged, rectangle tile, offset_group offsets, int y, float* memory) const {
        for (int k = y == tile.y0 ? y - radius_ : y + radius_; k <= y + radius_; ++k)
            add_row(staged, tile, offsets, k, memory);
        detail::for_each_node(patches_, [&](const auto& patch, auto index) {
            const int radius = patch.radius;
            if (radius == 1) sum_row<1, index>(radius, tile, offsets, y, memory);
            else if (radius == 2) sum_row<2, index>(radius, tile, offsets, y, memory);
            else if (radius == 3) sum_row<3, index>(radius, tile, offsets, y, memory);
            else sum_row<0, index>(radius, tile, offsets, y, memory);
            if constexpr (slopes < index >> 0)
                for (int i = 0; i < offsets.size(); ++i)
                    sum_slopes<index>(radius, tile, i, offsets.dx(i), offsets.dy, y, memory);
        });
    }

private:
    template <int Index>
    using patch_at = std::tuple_element_t<Index, std::tuple<Patch...>>;
    /// How many slopes patch Index has.
    template <int Index>
    static constexpr int slopes = detail::places_of<patch_at<Index>, Varied> - 1;
    /// The value of a patch comes before its slopes; the policy inside has slopes at p and slopes at q.
    static constexpr int place(int index) {
        int place = 0, i = 0;
        ((place += i++ < index ? detail::places_of<Patch, Varied> : 0), ...);
        return place;
    }
    static constexpr int ring_place(int index) { return 2 * place(index) - index; }
    static constexpr int ring_places = ring_place(sizeof...(Patch));

    static constexpr auto inner_of(const std::tuple<Patch...>& patches) {
        return std::apply([](const auto&... p) { return std::tuple<typename Patch::prepares...>(p.inner...); },
                          patches);
    }

    /// Evaluates what is inside the patches for row y, for the pixels of the tile and radius_ beyond.
    void add_row(const staged_tile& staged, rectangle tile, offset_group offsets, int y, float* memory) const {
        inner_.row(staged, tile.grown(radius_), offsets, y, memory + own_floats());
        const int pixels = tile.x1 - tile.x0 + 2 * radius_;
        const bool masked = rule_ == border::clip && !covered(tile, offsets, y);
        const std::ptrdiff_t next = ring_size(), plane = ring_plane();
        detail::for_each_node(evaluated_, [&](const auto& evaluated, auto index) {
            if (leaders_[index] != index) return;
            constexpr int n = slopes<index>;
            for (int x = 0; x < pixels; x += lanes::size) {
                const float* p = staged.at(0, tile.x0 - radius_ + x, y);
                const float* q = offsets.q(p, staged.step);
                float* to = ring(memory, 0, ring_place(index), y) + x;
                // Stored last: stores would keep what depends on p alone from being computed once.
                lanes value[group], slope[2 * n + 1][group];
                for (int i = 0; i < offsets.size(); ++i) {
                    const prepared ahead{inner_.at(memory + own_floats(), i, x), inner_.width()};
                    const int dx = offsets.dx(i);
                    if constexpr (n > 0) {
                        const pixel_pair<differential<lanes, Varied>, Reads> pq(p, q + i * offsets.step, staged.step,
                                                                                dx, offsets.dy);
                        const auto at_p = evaluated(pq.varying(true, false));
                        value[i] = at_p.value();
                        for (int c = 0; c < n; ++c) slope[c][i] = at_p.slope(c);
                    } else {
                        value[i] = evaluated(
                            pixel_pair<lanes, Reads>(p, q + i * offsets.step, staged.step, dx, offsets.dy, ahead));
                    }
                }
                if constexpr (n > 0)
                    for (int i = 0; i < offsets.size(); ++i) {
                        for (int c = 0; c < n; ++c) slope[n + c][i] = lanes(0.0f);
                        if (offsets.other_frame() || !near(offsets.dx(i), offsets.dy, radius_)) continue;
                        const pixel_pair<differential<lanes, Varied>, Reads> pq(p, q + i * offsets.step, staged.step,
                                                                                offsets.dx(i), offsets.dy);
                        const auto at_q = evaluated(pq.varying(false, true));
                        for (int c = 0; c < n; ++c) slope[n + c][i] = at_q.slope(c);
                    }
                for (int i = 0; i < offsets.size(); ++i) {
                    value[i].store(to + i * next);
                    for (int k = 0; k < 2 * n; ++k) slope[k][i].store(to + i * next + (1 + k) * plane);
                }
                if (masked)  // a pair that does not exist adds nothing
                    for (int i = 0; i < offsets.size(); ++i)
                        for (int k = 0; k <= 2 * n; ++k) {
                            float* const of_pair = to + i * next + k * plane;
                            (lanes::load(of_pair) * (lanes::load(p) * lanes::load(q + i * offsets.step)))
                                .store(of_pair);
                        }
            }
        });
    }

    /// Sums over the patches around row y, once all their rows are there; divides by the number of pairs that exist.
    /// Unrolled is the radius where it is one of the usual ones, else 0.
    template <int Unrolled, int Index>
    void sum_row(int radius, rectangle tile, offset_group offsets, int y, float* memory) const {
        const int pixels = tile.x1 - tile.x0;
        const lanes rows(1.0f / pairs(y, offsets.dy, radius, size_.height));
        const auto sum = [&](const auto& row) {
            lanes s = detail::tree_sum<2 * Unrolled + 1>(row);
            if constexpr (Unrolled == 0)
                for (int k = 1; k <= 2 * radius; ++k) s = s + row(k);
            return s;
        };
        for (int i = 0; i < offsets.size(); ++i) {
            float* const columns = memory + place_floats() + share_floats() + ring_floats();
            const float* row[2 * Unrolled + 1];
            const int from = ring_place(leaders_[Index]);
            for (int k = 0; k <= 2 * Unrolled; ++k) row[k] = ring(memory, i, from, y - radius + k);
            for (int x = radius_ - radius; x < pixels + radius_ + radius; x += lanes::size)
                sum([&](int k) {
                    return lanes::load((k <= 2 * Unrolled ? row[k] : ring(memory, i, from, y - radius + k)) + x);
                }).store(columns + x);
            const float* const first_column = columns + radius_ - radius;
            const float* const shares = share(memory, i, Index);
            float* const to = at(memory, i, 0) + place(Index) * width();
            for (int x = 0; x < pixels; x += lanes::size) {
                const lanes total = sum([&](int k) { return lanes::load(first_column + x + k); });
                (total * (lanes::load(shares + x) * rows)).store(to + x);
            }
        }
    }

    /// The slopes of the mean at offset (dx, dy): of the pair (p, q), and of the pair (p - offset, p).
    template <int Index>
    void sum_slopes(int radius, rectangle tile, int i, int dx, int dy, int y, float* memory) const {
        const lanes rows(1.0f / pairs(y, dy, radius, size_.height));
        const float* const shares = share(memory, i, Index);
        const int from = ring_place(leaders_[Index]);
        for (int c = 0; c < slopes<Index>; ++c) {
            const float* const centre = ring(memory, i, from + 1 + c, y) + radius_;
            const float* const opposite =
                near(dx, dy, radius) ? ring(memory, i, from + 1 + slopes<Index> + c, y - dy) + radius_ - dx : nullptr;
            float* const to = at(memory, i, 0) + (place(Index) + 1 + c) * width();
            for (int x = 0; x < tile.x1 - tile.x0; x += lanes::size) {
                lanes slope = lanes::load(centre + x);
                if (opposite) slope = slope + lanes::load(opposite + x);
                (slope * (lanes::load(shares + x) * rows)).store(to + x);
            }
        }
    }

    static bool near(int dx, int dy, int radius) { return std::abs(dx) <= radius && std::abs(dy) <= radius; }

    std::size_t place_floats() const { return std::size_t(group) * count_ * width(); }
    std::size_t share_floats() const { return std::size_t(group) * sizeof...(Patch) * width(); }
    std::size_t ring_floats() const { return std::size_t(group) * ring_size(); }
    std::ptrdiff_t ring_plane() const { return std::ptrdiff_t{2 * radius_ + 1} * width(); }
    std::ptrdiff_t ring_size() const { return ring_places * ring_plane(); }
    std::size_t own_floats() const { return place_floats() + share_floats() + ring_floats() + width(); }

    /// What the sums of a column of pixels are divided by: one over the number of pairs along x.
    float* share(float* memory, int i, int index) const {
        return memory + place_floats() + (i * std::ptrdiff_t{sizeof...(Patch)} + index) * width();
    }
    /// Row y of what is inside the patches, for the i-th offset; the last 2 radius + 1 rows are kept.
    float* ring(float* memory, int i, int ring_place, int y) const {
        const int rows = 2 * radius_ + 1;
        return memory + place_floats() + share_floats() + i * ring_size() + ring_place * ring_plane() +
               std::ptrdiff_t{(y % rows + rows) % rows} * width();
    }

    /// How many of the pairs (p + n, p + offset + n), |n| <= radius, exist along one axis; at least 1.
    float pairs(int p, int offset, int radius, int size) const {
        if (rule_ != border::clip) return static_cast<float>(2 * radius + 1);
        const int before = std::min(radius, std::min(p, p + offset));
        const int after = std::min(radius, size - 1 - std::max(p, p + offset));
        return static_cast<float>(std::max(1, before + after + 1));
    }

    /// Whether both ends of every pair that row y of the tile and its patches asks for are inside the image.
    bool covered(rectangle tile, offset_group offsets, int y) const {
        return std::min(y, y + offsets.dy) >= 0 && std::max(y, y + offsets.dy) < size_.height &&
               tile.x0 - radius_ + std::min(offsets.first, 0) >= 0 &&
               tile.x1 + radius_ + std::max(offsets.dx(offsets.size() - 1), 0) <= size_.width;
    }

    static_assert(((!detail::looks_around<typename Patch::prepares> || detail::places_of<Patch, Varied> == 1) && ...),
                  "the derivative of a patch within a patch is worked out by executor::serial alone");

    std::tuple<Patch...> patches_;
    decltype(detail::look_up_all<detail::is_patch, void>(inner_of(std::declval<std::tuple<Patch...>>()))) evaluated_;
    int leaders_[sizeof...(Patch)];
    int radius_;  ///< the largest of the patches
    prepared_patches<Reads, void,
                     decltype(detail::collect_all<detail::is_patch>(inner_of(std::declval<std::tuple<Patch...>>())))>
        inner_;
    extent size_, tile_;
    border rule_;
    int count_;  ///< places, with the caller's
};

/// The patches of a sweep.
template <class Sweep>
using prepared_patches_of =
    prepared_patches<typename Sweep::reads, varied_in<Sweep>,
                     decltype(detail::collect_all<detail::is_patch>(std::declval<const Sweep&>().weights))>;

}  // namespace winnow
