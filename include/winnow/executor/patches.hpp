// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Patch distances worked out ahead for a whole tile: the distance of each pixel pair once, then sums along y and x, so
/// that the cost of a patch hardly depends on its size.
#include <algorithm>
#include <winnow/executor/lanes.hpp>
#include <winnow/executor/run.hpp>
#include <winnow/executor/stage.hpp>

namespace winnow {

namespace detail {

/// A distance that says what it averages over a patch (see distance::patch).
template <class Node>
    struct is_patch : std::bool_constant < requires {
    typename Node::prepares;
} > {};

/// Stands in the expression where a patch stood.
struct looked_up {
    using role = role::distance;
    using reads = planes<>;

    int index;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return pq.ahead(index);
    }
};

template <class Inner>
bool same_distance(const Inner& a, const Inner& b) {
    if constexpr (std::equality_comparable<Inner>) return a == b;
    else return false;
}
template <class A, class B>
bool same_distance(const A&, const B&) {
    return false;
}

/// sum of n values `step` floats apart, always in the same order: v0 + v1, then one after the other.
WINNOW_HD lanes sum_of(const float* from, int n, std::ptrdiff_t step) {
    lanes sum = lanes::load(from);
    for (int i = 1; i < n; ++i) sum = sum + lanes::load(from + i * step);
    return sum;
}

}  // namespace detail

/// The patches of a sweep.  Those over the same distance share its evaluation.
template <class Reads, class... Patch>
class prepared_patches {
public:
    using reads = Reads;
    static constexpr int count = sizeof...(Patch);

    template <class Sweep>
    prepared_patches(const Sweep& sweep, extent size, extent tile, int group)
        : patches_(patches_of(sweep)), size_(size), tile_(tile), group_(group), rule_(sweep.rule) {
        std::apply([&](const auto&... p) { ((radius_ = std::max(radius_, p.radius)), ...); }, patches_);
    }

    /// Memory for one group of offsets: the distances, then what prepare() needs on the way.
    std::size_t floats() const {
        if constexpr (count == 0) return 0;
        return result_floats() + column_floats() + sums_floats() + row_floats();
    }

    /// The weights with every patch replaced by what prepare() worked out for it.
    template <class Weights>
    static auto rewritten(const Weights& weights) {
        int index = 0;
        const auto replace = [&index](const auto&) { return detail::looked_up{index++}; };
        return std::apply(
            [&](const auto&... w) {
                return std::tuple<decltype(rewrite<detail::is_patch>(w, replace))...>{
                    rewrite<detail::is_patch>(w, replace)...};
            },
            weights);
    }

    /// Where the distances of the i-th offset of the group lie for the pixel (x, y) of the tile.
    prepared at(const float* memory, int i, int x, int y) const {
        return {memory + ((std::ptrdiff_t{y} * group_ + i) * count) * tile_.width + x, tile_.width};
    }

    /// Works out the distances at offsets (first .. last - 1, dy) for every pixel of the tile.
    void prepare(const staged_tile& staged, rectangle tile, int first, int last, int dy, float* memory) const {
        if constexpr (count > 0)
            for (int dx = first; dx < last; ++dx) prepare_offset(staged, tile, dx, dy, dx - first, memory);
    }

private:
    std::size_t result_floats() const { return std::size_t(tile_.height) * group_ * count * tile_.width; }
    std::size_t column_floats() const { return std::size_t(tile_.height + 2 * radius_) * lanes::size; }
    int sums_width() const {
        return detail::ceil_div(tile_.width + 2 * radius_, lanes::size) * lanes::size + lanes::size;
    }
    std::size_t sums_floats() const { return std::size_t(count) * tile_.height * sums_width(); }
    std::size_t row_floats() const { return tile_.width; }

    template <class Sweep>
    static auto patches_of(const Sweep& sweep) {
        return std::apply([](const auto&... w) { return std::tuple_cat(collect<detail::is_patch>(w)...); },
                          sweep.weights);
    }

    void prepare_offset(const staged_tile& staged, rectangle tile, int dx, int dy, int i, float* memory) const {
        float* column = memory + result_floats();
        float* sums = column + column_floats();
        float* share = sums + sums_floats();
        std::apply(
            [&](const auto&... patch) {
                int index = 0;
                (along_y(patch, index++, staged, tile, dx, dy, column, sums), ...);
                index = 0;
                (along_x(patch.radius, index++, tile, dx, dy, i, sums, share, memory), ...);
            },
            patches_);
    }

    /// Index of the first patch over the same distance as patch `index`.
    template <class P>
    int leader(const P& patch, int index) const {
        int found = index, at = 0;
        std::apply(
            [&](const auto&... other) {
                ((found = at < found && detail::same_distance(other.inner, patch.inner) ? at : found, ++at), ...);
            },
            patches_);
        return found;
    }

    /// For the first patch over a distance: evaluates the distance column by column, and sums it along y for every
    /// patch over the same distance.
    template <class P>
    void along_y(const P& patch, int index, const staged_tile& staged, rectangle tile, int dx, int dy, float* column,
                 float* sums) const {
        if (leader(patch, index) != index) return;
        const int height = tile.y1 - tile.y0, width = tile.x1 - tile.x0;
        const bool all_covered = rule_ != border::clip || covered(tile, dx, dy);
        for (int x = 0; x < width + 2 * radius_; x += lanes::size) {
            const float* p = staged.at(0, tile.x0 + x - radius_, tile.y0 - radius_);
            const float* q = p + dx + dy * staged.step.row;
            for (int y = 0; y < height + 2 * radius_; ++y, p += staged.step.row, q += staged.step.row) {
                const pixel_pair<lanes, Reads> pq(p, q, staged.step, dx, dy);
                patch.inner(pq).store(column + y * lanes::size);
            }
            if (!all_covered) {
                p = staged.at(0, tile.x0 + x - radius_, tile.y0 - radius_);
                q = p + dx + dy * staged.step.row;
                for (int y = 0; y < height + 2 * radius_; ++y, p += staged.step.row, q += staged.step.row)
                    (lanes::load(column + y * lanes::size) * (lanes::load(p) * lanes::load(q)))
                        .store(column + y * lanes::size);
            }
            int other_index = 0;
            std::apply(
                [&](const auto&... other) {
                    ((detail::same_distance(other.inner, patch.inner)
                          ? sum_column(other.radius, column, sums + other_index * tile_.height * sums_width() + x,
                                       height)
                          : void(),
                      ++other_index),
                     ...);
                },
                patches_);
        }
    }

    void sum_column(int radius, const float* column, float* sums, int height) const {
        const float* from = column + (radius_ - radius) * lanes::size;
        for (int y = 0; y < height; ++y)
            detail::sum_of(from + y * lanes::size, 2 * radius + 1, lanes::size).store(sums + y * sums_width());
    }

    /// Sums along x and divides by the number of pairs that exist.
    void along_x(int radius, int index, rectangle tile, int dx, int dy, int i, const float* sums, float* share,
                 float* memory) const {
        const int width = tile.x1 - tile.x0, height = tile.y1 - tile.y0;
        for (int x = 0; x < tile_.width; ++x) share[x] = 1.0f / pairs(tile.x0 + x, dx, radius, size_.width);
        for (int y = 0; y < height; ++y) {
            const lanes rows(1.0f / pairs(tile.y0 + y, dy, radius, size_.height));
            const float* from = sums + (index * tile_.height + y) * sums_width() + radius_ - radius;
            float* to = memory + ((std::ptrdiff_t{y} * group_ + i) * count + index) * tile_.width;
            for (int x = 0; x < width; x += lanes::size)
                (detail::sum_of(from + x, 2 * radius + 1, 1) * (lanes::load(share + x) * rows)).store(to + x);
        }
    }

    /// How many of the pairs (p + n, p + offset + n), |n| <= radius, exist along one axis; at least 1.
    float pairs(int p, int offset, int radius, int size) const {
        if (rule_ != border::clip) return static_cast<float>(2 * radius + 1);
        const int before = std::min(radius, std::min(p, p + offset));
        const int after = std::min(radius, size - 1 - std::max(p, p + offset));
        return static_cast<float>(std::max(1, before + after + 1));
    }

    /// Both ends of every pair of the tile and its patches are inside the image.
    bool covered(rectangle tile, int dx, int dy) const {
        const rectangle r = tile.grown(radius_);
        return r.x0 + std::min(dx, 0) >= 0 && r.y0 + std::min(dy, 0) >= 0 && r.x1 + std::max(dx, 0) <= size_.width &&
               r.y1 + std::max(dy, 0) <= size_.height;
    }

    std::tuple<Patch...> patches_;
    extent size_, tile_;
    int group_;
    border rule_;
    int radius_ = 0;  ///< the largest of the patches
};

namespace detail {
template <class Reads, class Patches>
struct prepared_for;
template <class Reads, class... Patch>
struct prepared_for<Reads, std::tuple<Patch...>> {
    using type = prepared_patches<Reads, Patch...>;
};
}  // namespace detail

template <class Sweep>
using prepared_patches_of =
    typename detail::prepared_for<typename Sweep::reads,
                                  decltype(std::apply(
                                      [](const auto&... w) { return std::tuple_cat(collect<detail::is_patch>(w)...); },
                                      std::declval<const Sweep&>().weights))>::type;

}  // namespace winnow
