// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Means over patches worked out ahead, row by row: what is averaged once for each pixel pair, then sums along y and x,
/// so that the cost of a patch hardly depends on its size.
#include <algorithm>
#include <winnow/executor/lanes.hpp>
#include <winnow/executor/run.hpp>
#include <winnow/executor/stage.hpp>

namespace winnow {

namespace detail {

/// A policy that says what it averages over a patch: distance::patch, weight::patch_mean.
template <class Node>
concept averages_over_patch = requires {
    typename Node::prepares;
};
template <class Node>
struct is_patch : std::bool_constant<averages_over_patch<Node>> {};

/// Stands in the expression where a patch stood.
template <class Role>
struct looked_up {
    using role = Role;
    using reads = planes<>;

    int index;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return pq.ahead(index);
    }
};

template <class A, class B>
bool same_policy(const A& a, const B& b) {
    if constexpr (std::is_same_v<A, B> && std::equality_comparable<A>) return a == b;
    else return false;
}

/// The outermost patches of several expressions, and the expressions with these looked up instead.
template <class... Node>
constexpr auto patches_in(const std::tuple<Node...>& nodes) {
    return std::apply([](const auto&... node) { return std::tuple_cat(collect<is_patch>(node)...); }, nodes);
}
template <class... Node>
constexpr auto without_patches(const std::tuple<Node...>& nodes) {
    int index = 0;
    const auto replace = [&index](const auto& patch) {
        return looked_up<typename std::remove_cvref_t<decltype(patch)>::role>{index++};
    };
    return std::apply(
        [&](const auto&... node) {
            return std::tuple<decltype(rewrite<is_patch>(node, replace))...>{rewrite<is_patch>(node, replace)...};
        },
        nodes);
}

/// row(0) + row(1) + ... + row(count - 1), added as a balanced tree: one order for each count, whatever the pixel.
template <int Count, class Row>
WINNOW_HD lanes tree_sum(const Row& row, int first = 0) {
    if constexpr (Count == 1) return row(first);
    else return tree_sum<Count / 2>(row, first) + tree_sum<Count - Count / 2>(row, first + Count / 2);
}

}  // namespace detail

/// The offsets (first .. last - 1, dy).
struct offset_group {
    int first, last, dy;

    int size() const { return last - first; }
};

/// Means over patches around the pixels of a tile, for a group of offsets, row by row.  Patches over the same policy
/// share its evaluation; what is inside a patch may hold patches itself.
template <class Reads, class Patches>
class prepared_patches;

template <class Reads>
class prepared_patches<Reads, std::tuple<>> {
public:
    prepared_patches(const std::tuple<>&, extent, extent, int, border) {}

    int reach() const { return 0; }
    std::size_t floats() const { return 0; }
    prepared at(const float*, int, int) const { return {}; }
    void start(rectangle, offset_group, float*) const {}
    void row(const staged_tile&, rectangle, offset_group, int, float*) const {}
};

template <class Reads, class... Patch>
class prepared_patches<Reads, std::tuple<Patch...>> {
public:
    /// For tiles up to this size, and up to `group` offsets at a time.
    prepared_patches(const std::tuple<Patch...>& patches, extent size, extent tile, int group, border rule)
        : patches_(patches),
          evaluated_(detail::without_patches(inner_of(patches))),
          radius_(std::apply([](const auto&... p) { return std::max({p.radius...}); }, patches)),
          inner_(detail::patches_in(inner_of(patches)), size,
                 rectangle{0, 0, tile.width, tile.height}.grown(radius_).size(), group, rule),
          size_(size),
          tile_(tile),
          group_(group),
          rule_(rule) {}

    /// How far around a tile it looks: the largest patch of each level.
    int reach() const {
        // Also of a policy that looks around by itself, without being a patch.
        const int inner =
            std::apply([](const auto&... p) { return std::max({detail::reach_of(p.inner)...}); }, patches_);
        return radius_ + std::max(inner, inner_.reach());
    }

    /// Memory for a group of offsets: the means of one row of pixels, then what it takes to work them out.
    std::size_t floats() const { return own_floats() + inner_.floats(); }

    /// Where the means at the i-th offset of the group lie for the x-th pixel of the row.
    prepared at(const float* memory, int i, int x) const {
        return {memory + std::ptrdiff_t{i} * count * width() + x, width()};
    }

    /// Starts a group of offsets.
    void start(rectangle tile, offset_group offsets, float* memory) const {
        for_each([&](const auto& patch, const auto&, int index) {
            for (int i = 0; i < offsets.size(); ++i)
                for (int x = 0; x < tile.x1 - tile.x0; ++x)
                    share(memory, i, index)[x] =
                        1.0f / pairs(tile.x0 + x, offsets.first + i, patch.radius, size_.width);
        });
        inner_.start(tile.grown(radius_), offsets, memory + own_floats());
    }

    /// Works out the means of row y of the tile; rows are asked for one after the other, from the first on.
    void row(const staged_tile& staged, rectangle tile, offset_group offsets, int y, float* memory) const {
        for (int k = y == tile.y0 ? y - radius_ : y + radius_; k <= y + radius_; ++k)
            add_row(staged, tile, offsets, k, memory);
        for_each([&](const auto& patch, const auto&, int index) {
            const int from = leader(patch, index);
            switch (patch.radius) {
                case 1:
                    return sum_row<1>(1, index, from, tile, offsets, y, memory);
                case 2:
                    return sum_row<2>(2, index, from, tile, offsets, y, memory);
                case 3:
                    return sum_row<3>(3, index, from, tile, offsets, y, memory);
                default:
                    return sum_row<0>(patch.radius, index, from, tile, offsets, y, memory);
            }
        });
    }

private:
    static constexpr int count = sizeof...(Patch);

    static constexpr auto inner_of(const std::tuple<Patch...>& patches) {
        return std::apply([](const auto&... p) { return std::tuple<typename Patch::prepares...>(p.inner...); },
                          patches);
    }

    /// Evaluates what is inside the patches for row y, for the pixels of the tile and radius_ beyond.
    void add_row(const staged_tile& staged, rectangle tile, offset_group offsets, int y, float* memory) const {
        inner_.row(staged, tile.grown(radius_), offsets, y, memory + own_floats());
        for_each([&](const auto& patch, const auto& evaluated, int index) {
            if (leader(patch, index) != index) return;
            const int pixels = tile.x1 - tile.x0 + 2 * radius_;
            const bool masked = rule_ == border::clip && !covered(tile, offsets, y);
            const std::ptrdiff_t next = ring_size();
            for (int x = 0; x < pixels; x += lanes::size) {
                const float* p = staged.at(0, tile.x0 - radius_ + x, y);
                const float* q = p + offsets.first + offsets.dy * staged.step.row;
                float* to = ring(memory, 0, index, y) + x;
                for (int i = 0; i < offsets.size(); ++i)
                    evaluated(pixel_pair<lanes, Reads>(p, q + i, staged.step, offsets.first + i, offsets.dy,
                                                       inner_.at(memory + own_floats(), i, x)))
                        .store(to + i * next);
                if (masked)  // a pair that does not exist adds nothing
                    for (int i = 0; i < offsets.size(); ++i)
                        (lanes::load(to + i * next) * (lanes::load(p) * lanes::load(q + i))).store(to + i * next);
            }
        });
    }

    /// Sums over the patches around row y, once all their rows are there; divides by the number of pairs that exist.
    /// Unrolled is the radius where it is one of the usual ones, else 0.
    template <int Unrolled>
    void sum_row(int radius, int index, int from, rectangle tile, offset_group offsets, int y, float* memory) const {
        const int pixels = tile.x1 - tile.x0;
        const lanes rows(1.0f / pairs(y, offsets.dy, radius, size_.height));
        const auto sum = [&](const auto& row) {
            lanes s = detail::tree_sum<2 * Unrolled + 1>(row);
            if constexpr (Unrolled == 0)
                for (int k = 1; k <= 2 * radius; ++k) s = s + row(k);
            return s;
        };
        for (int i = 0; i < offsets.size(); ++i) {
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

    /// The means of a row for the i-th offset of the group.
    float* result(float* memory, int i, int index) const {
        return memory + (std::ptrdiff_t{i} * count + index) * width();
    }
    /// What the sums of a column of pixels are divided by: one over the number of pairs along x.
    float* share(float* memory, int i, int index) const { return result(memory + result_floats(), i, index); }
    /// Row y of what is inside the patches, for the i-th offset; the last 2 radius + 1 rows are kept.
    float* ring(float* memory, int i, int index, int y) const {
        const int rows = 2 * radius_ + 1;
        const int place = (y % rows + rows) % rows;
        return memory + 2 * result_floats() + i * ring_size() + (std::ptrdiff_t{index} * rows + place) * width();
    }

    std::size_t own_floats() const { return 2 * result_floats() + ring_floats() + width(); }

    /// f(patch, what is evaluated inside it, index).
    template <class F>
    void for_each(const F& f) const {
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            (f(std::get<I>(patches_), std::get<I>(evaluated_), static_cast<int>(I)), ...);
        }
        (std::index_sequence_for<Patch...>{});
    }
    /// Index of the first patch over the same policy as patch `index`.
    template <class P>
    int leader(const P& patch, int index) const {
        int found = index;
        for_each([&](const auto& other, const auto&, int i) {
            if (i < found && detail::same_policy(other.inner, patch.inner)) found = i;
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
    bool covered(rectangle tile, offset_group offsets, int y) const {
        return std::min(y, y + offsets.dy) >= 0 && std::max(y, y + offsets.dy) < size_.height &&
               tile.x0 - radius_ + std::min(offsets.first, 0) >= 0 &&
               tile.x1 + radius_ + std::max(offsets.last - 1, 0) <= size_.width;
    }

    std::tuple<Patch...> patches_;
    decltype(detail::without_patches(inner_of(std::declval<std::tuple<Patch...>>()))) evaluated_;
    int radius_;  ///< the largest of the patches
    prepared_patches<Reads, decltype(detail::patches_in(inner_of(std::declval<std::tuple<Patch...>>())))> inner_;
    extent size_, tile_;
    int group_;
    border rule_;
};

/// The patches of a sweep.
template <class Sweep>
using prepared_patches_of =
    prepared_patches<typename Sweep::reads, decltype(detail::patches_in(std::declval<const Sweep&>().weights))>;

}  // namespace winnow
