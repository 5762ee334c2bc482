// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A bounding volume hierarchy over boxes, built by the surface area heuristic.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <winnow/simulate/shape.hpp>

namespace winnow::simulate {

/// Knows only boxes: what lies in them is asked of the caller.
class bvh {
public:
    bvh() = default;
    explicit bvh(const std::vector<bounds>& boxes) {
        for (std::size_t i = 0; i < boxes.size(); ++i) order_.push_back(static_cast<int>(i));
        if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
    }

    /// Calls meet(i, far) for the boxes that the ray enters before `far`, nearer ones mostly first; it returns how far
    /// the ray still goes, 0 or less to stop.
    template <class Meet>
    void walk(const ray& r, double far, const Meet& meet) const {
        if (nodes_.empty()) return;
        const slabs through(r);
        struct visit {
            std::int32_t node;
            double entry;
        };
        std::array<visit, 64> stack;
        int depth = 0;
        visit at{0, through.entry(nodes_[0].box)};
        while (true) {
            // What waited on the stack may lie behind what has been met since.
            if (at.entry < far) {
                const node& n = nodes_[at.node];
                if (n.count == 0) {
                    visit a{at.node + 1, through.entry(nodes_[at.node + 1].box)};
                    visit b{n.first, through.entry(nodes_[n.first].box)};
                    if (b.entry < a.entry) std::swap(a, b);
                    if (b.entry < far) stack[depth++] = b;
                    at = a;
                    continue;
                }
                for (int i = n.first; i < n.first + n.count; ++i)
                    if ((far = meet(order_[i], far)) <= 0) return;
            }
            if (depth == 0) return;
            at = stack[--depth];
        }
    }

private:
    static constexpr int most_in_leaf = 4, deepest = 60;

    struct node {
        bounds box;
        std::int32_t first = 0;  ///< of its boxes; of an inner node, its second child: the first one follows it
        std::int32_t count = 0;  ///< 0 in an inner node
    };

    /// A ray as the slabs of a box meet it.
    class slabs {
    public:
        explicit slabs(const ray& r) : origin_(r.origin), inverse_(r.direction.cwiseInverse()) {
            for (int axis = 0; axis < 3; ++axis) backwards_[axis] = inverse_[axis] < 0;
        }

        /// Where the ray enters the box, infinity if it does not.  A direction of 0 gives 0 * infinity on the faces of
        /// the box; its NaN fails all comparisons, which leaves the slab out.
        [[gnu::always_inline]] double entry(const bounds& box) const {
            const vec3* const side[2] = {&box.low, &box.high};
            double first = 0, last = infinity;
            for (int axis = 0; axis < 3; ++axis) {
                const double enter = ((*side[backwards_[axis]])[axis] - origin_[axis]) * inverse_[axis];
                const double leave = ((*side[1 - backwards_[axis]])[axis] - origin_[axis]) * inverse_[axis];
                first = enter > first ? enter : first;
                last = leave < last ? leave : last;
            }
            // The slabs are rounded: a flat box must not be missed.
            return first <= last * (1 + 1e-12) ? first : infinity;
        }

    private:
        vec3 origin_, inverse_;
        std::array<std::ptrdiff_t, 3> backwards_;
    };

    int build(const std::vector<bounds>& boxes, int begin, int end, int depth = 0) {
        const int self = static_cast<int>(nodes_.size());
        nodes_.emplace_back();
        bounds all;
        for (int i = begin; i < end; ++i) all.grow(boxes[order_[i]]);
        const auto [axis, middle] = depth < deepest ? best_split(boxes, begin, end, all.area()) : split{0, 0};
        nodes_[self].box = all;
        if (middle == 0) {
            nodes_[self].first = begin;
            nodes_[self].count = end - begin;
            return self;
        }
        sort(boxes, begin, end, axis);
        build(boxes, begin, middle, depth + 1);
        const int second = build(boxes, middle, end, depth + 1);
        nodes_[self].first = second;
        return self;
    }

    struct split {
        int axis, middle;  ///< no middle: a leaf is best
    };
    split best_split(const std::vector<bounds>& boxes, int begin, int end, double area) {
        split best{0, 0};
        const int count = end - begin;
        double least = count <= most_in_leaf ? count * area : infinity;
        std::vector<double> from_right(static_cast<std::size_t>(count));
        for (int axis = 0; axis < 3 && count > 1; ++axis) {
            sort(boxes, begin, end, axis);
            bounds right, left;
            for (int i = count; i-- > 1;) from_right[i] = right.grow(boxes[order_[begin + i]]).area();
            for (int i = 1; i < count; ++i) {
                left.grow(boxes[order_[begin + i - 1]]);
                const double cost = area + left.area() * i + from_right[i] * (count - i);
                if (cost < least) least = cost, best = {axis, begin + i};
            }
        }
        return best;
    }
    void sort(const std::vector<bounds>& boxes, int begin, int end, int axis) {
        std::sort(order_.begin() + begin, order_.begin() + end, [&](int a, int b) {
            const double x = boxes[a].low[axis] + boxes[a].high[axis], y = boxes[b].low[axis] + boxes[b].high[axis];
            return x != y ? x < y : a < b;
        });
    }

    std::vector<node> nodes_;
    std::vector<int> order_;
};

}  // namespace winnow::simulate
