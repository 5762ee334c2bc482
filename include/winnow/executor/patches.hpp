// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Patch distances worked out ahead, row by row: the distance of each pixel pair once, then sums along y and x, so that
/// the cost of a patch hardly depends on its size.
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

/// row(0) + row(1) + ... + row(count - 1), added as a balanced tree: one order for each count, whatever the pixel.
template <int Count, class Row>
WINNOW_HD lanes tree_sum(const Row& row, int first = 0) {
    if constexpr (Count == 1) return row(first);
    else return tree_sum<Count / 2>(row, first) + tree_sum<Count - Count / 2>(row, first + Count / 2);
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

    /// The largest radius of a patch.
    int radius() const { return radius_; }

    /// Memory for a group of offsets: the distances of one row of pixels, then what it takes to work them out.
    std::size_t floats() const {
        if constexpr (count == 0) return 0;
        return 2 * result_floats() + ring_floats() + width();
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

    /// Where the distances of the i-th offset of the group lie for the x-th pixel of the row.
    prepared at(const float* memory, int i, int x) const {
        return {memory + std::ptrdiff_t{i} * count * width() + x, width()};
    }

    /// Starts a group of offsets (first .. last - 1, dy).
    void start(rectangle tile, int first, int last, float* memory) const {
        for_each([&](const auto& patch, int index) {
            for (int dx = first; dx < last; ++dx)
                for (int x = 0; x < tile.x1 - tile.x0; ++x)
                    share(memory, dx - first, index)[x] = 1.0f / pairs(tile.x0 + x, dx, patch.radius, size_.width);
        });
    }

    /// Evaluates the inner distances of row y of the image; rows come one by one, from radius() above the tile to
    /// radius() below it.
    void add_row(const staged_tile& staged, rectangle tile, int first, int last, int dy, int y, float* memory) const {
        for_leaders([&](const auto& patch, int index) {
            const int pixels = tile.x1 - tile.x0 + 2 * radius_;
            const bool masked = rule_ == border::clip && !covered(tile, first, last, dy, y);
            const std::ptrdiff_t next = ring_size();
            for (int x = 0; x < pixels; x += lanes::size) {
                const float* p = staged.at(0, tile.x0 - radius_ + x, y);
                const float* q = p + dy * staged.step.row;
                float* to = ring(memory, 0, index, y) + x;
                for (int i = 0; i < last - first; ++i)
                    patch.inner(pixel_pair<lanes, Reads>(p, q + first + i, staged.step, first + i, dy))
                        .store(to + i * next);
                if (masked)  // a pair that does not exist adds nothing
                    for (int i = 0; i < last - first; ++i)
                        (lanes::load(to + i * next) * (lanes::load(p) * lanes::load(q + first + i)))
                            .store(to + i * next);
            }
        });
    }

    /// Sums over the patches around row y, once all their rows are there; divides by the number of pairs that exist.
    void sum_row(rectangle tile, int first, int last, int dy, int y, float* memory) const {
        for_each([&](const auto& patch, int index) {
            switch (patch.radius) {
                case 1:
                    return sum_row_of<1>(1, index, leader(patch, index), tile, last - first, dy, y, memory);
                case 2:
                    return sum_row_of<2>(2, index, leader(patch, index), tile, last - first, dy, y, memory);
                case 3:
                    return sum_row_of<3>(3, index, leader(patch, index), tile, last - first, dy, y, memory);
                default:
                    return sum_row_of<0>(patch.radius, index, leader(patch, index), tile, last - first, dy, y, memory);
            }
        });
    }

private:
    /// Unrolled is the radius where it is one of the usual ones, else 0.
    template <int Unrolled>
    void sum_row_of(int radius, int index, int from, rectangle tile, int offsets, int dy, int y, float* memory) const {
        const int pixels = tile.x1 - tile.x0;
        const lanes rows(1.0f / pairs(y, dy, radius, size_.height));
        const auto sum = [&](const auto& row) {
            lanes s = detail::tree_sum<2 * Unrolled + 1>(row);
            if constexpr (Unrolled == 0)
                for (int k = 1; k <= 2 * radius; ++k) s = s + row(k);
            return s;
        };
        for (int i = 0; i < offsets; ++i) {
            float* const columns = memory + 2 * result_floats() + ring_floats();
            const float* row[2 * Unrolled + 1];
            for (int k = 0; k <= 2 * Unrolled; ++k) row[k] = ring(memory, i, from, y - radius + k);
            for (int x = radius_ - radius; x < pixels + radius_ + radius; x += lanes::size)
                sum([&](int k) {
                    return lanes::load((k <= 2 * Unrolled ? row[k] : ring(memory, i, from, y - radius + k)) + x);
                }).store(columns + x);
            const float* const first_column = columns + radius_ - radius;
            const float* const shares = share(memory, i, index);
            float* const to = result(memory, i, index);
            for (int x = 0; x < pixels; x += lanes::size) {
                const lanes total = sum([&](int k) { return lanes::load(first_column + x + k); });
                (total * (lanes::load(shares + x) * rows)).store(to + x);
            }
        }
    }

    /// Room for a row of the tile with its patches, and for a last batch that sticks out.
    int width() const { return detail::ceil_div(tile_.width + 2 * radius_ + lanes::size, lanes::size) * lanes::size; }
    std::size_t result_floats() const { return std::size_t(group_) * count * width(); }
    std::size_t ring_floats() const { return std::size_t(group_) * ring_size(); }
    std::ptrdiff_t ring_size() const { return std::ptrdiff_t{count} * (2 * radius_ + 1) * width(); }

    /// The distances of a row for the i-th offset of the group.
    float* result(float* memory, int i, int index) const {
        return memory + (std::ptrdiff_t{i} * count + index) * width();
    }
    /// What the sums of a column of pixels are divided by: one over the number of pairs along x.
    float* share(float* memory, int i, int index) const { return result(memory + result_floats(), i, index); }
    /// Row y of the inner distances of the i-th offset; the last 2 radius + 1 rows are kept.
    float* ring(float* memory, int i, int index, int y) const {
        const int rows = 2 * radius_ + 1;
        const int place = (y % rows + rows) % rows;
        return memory + 2 * result_floats() + i * ring_size() + (std::ptrdiff_t{index} * rows + place) * width();
    }

    template <class Sweep>
    static auto patches_of(const Sweep& sweep) {
        return std::apply([](const auto&... w) { return std::tuple_cat(collect<detail::is_patch>(w)...); },
                          sweep.weights);
    }

    template <class F>
    void for_each(const F& f) const {
        std::apply(
            [&](const auto&... patch) {
                [[maybe_unused]] int index = 0;
                (f(patch, index++), ...);
            },
            patches_);
    }
    /// The first of the patches over each distance.
    template <class F>
    void for_leaders(const F& f) const {
        for_each([&](const auto& patch, int index) {
            if (leader(patch, index) == index) f(patch, index);
        });
    }
    /// Index of the first patch over the same distance as patch `index`.
    template <class P>
    int leader(const P& patch, int index) const {
        int found = index;
        for_each([&](const auto& other, int i) {
            if (i < found && detail::same_distance(other.inner, patch.inner)) found = i;
        });
        return found;
    }

    /// How many of the pairs (p + n, p + offset + n), |n| <= radius, exist along one axis; at least 1.
    float pairs(int p, int offset, int radius, int size) const {
        if (rule_ != border::clip) return static_cast<float>(2 * radius + 1);
        const int before = std::min(radius, std::min(p, p + offset));
        const int after = std::min(radius, size - 1 - std::max(p, p + offset));
        return static_cast<float>(std::max(1, before + after + 1));
    }

    /// Whether both ends of every pair that row y of the tile and its patches asks for are inside the image.
    bool covered(rectangle tile, int first, int last, int dy, int y) const {
        return std::min(y, y + dy) >= 0 && std::max(y, y + dy) < size_.height &&
               tile.x0 - radius_ + std::min(first, 0) >= 0 && tile.x1 + radius_ + std::max(last - 1, 0) <= size_.width;
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
