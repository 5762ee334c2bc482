// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A bounding volume hierarchy over boxes, built by the surface area heuristic.
#include <algorithm>
#include <array>
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
        const vec3 inverse = r.direction.cwiseInverse();
        std::array<std::int32_t, 64> stack;
        int depth = 0;
        std::int32_t at = 0;
        if (entry(nodes_[0], r, inverse) >= far) return;
        while (true) {
            const node& n = nodes_[at];
            if (n.count > 0) {
                for (int i = n.first; i < n.first + n.count; ++i)
                    if ((far = meet(order_[i], far)) <= 0) return;
            } else {
                std::int32_t a = at + 1, b = n.first;
                double ta = entry(nodes_[a], r, inverse), tb = entry(nodes_[b], r, inverse);
                if (tb < ta) std::swap(a, b), std::swap(ta, tb);
                if (ta < far) {
                    if (tb < far) stack[depth++] = b;
                    at = a;
                    continue;
                }
            }
            // A box on the stack may lie behind what has been met since.
            do {
                if (depth == 0) return;
                at = stack[--depth];
            } while (entry(nodes_[at], r, inverse) >= far);
        }
    }

private:
    static constexpr int most_in_leaf = 4, deepest = 60;

    struct node {
        bounds box;
        std::int32_t first = 0;  ///< of its boxes; of an inner node, its second child: the first one follows it
        std::int32_t count = 0;  ///< 0 in an inner node
    };

    /// Where the ray enters the box, infinity if it does not.  A direction of 0 gives 0 * infinity on the faces of the
    /// box, whose NaN the comparisons turn into a hit.
    static double entry(const node& n, const ray& r, const vec3& inverse) {
        double first = 0, last = infinity;
        for (int axis = 0; axis < 3; ++axis) {
            double a = (n.box.low[axis] - r.origin[axis]) * inverse[axis];
            double b = (n.box.high[axis] - r.origin[axis]) * inverse[axis];
            if (b < a) std::swap(a, b);
            if (a > first) first = a;
            if (b < last) last = b;
        }
        // The slabs are rounded: a flat box must not be missed.
        return first <= last * (1 + 1e-12) ? first : infinity;
    }

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
