// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Counts the operations of a policy by running it on numbers that count.
#include <tuple>
#include <vector>
#include <winnow/executor/patches.hpp>

namespace winnow::benchmarks {

/// A `Real` that counts what is done to values that depend on q; what depends on p alone is worked out once for many
/// q, and is not counted.  An exponential counts as 15 operations, a reciprocal as 4, everything else as 1.
struct counted {
    bool varies = false;

    static inline long long operations = 0;
    static inline const float* q_begin = nullptr;  ///< values loaded from here on belong to q
    struct mask {
        bool varies;
    };

    counted() = default;
    explicit counted(float) {}
    static counted load(const float* from) { return result(from >= q_begin); }
    static counted result(bool varies, int cost = 0) {
        if (varies) operations += cost;
        counted r;
        r.varies = varies;
        return r;
    }
    friend counted operator+(counted a, counted b) { return result(a.varies || b.varies, 1); }
    friend counted operator-(counted a, counted b) { return result(a.varies || b.varies, 1); }
    friend counted operator*(counted a, counted b) { return result(a.varies || b.varies, 1); }
    friend counted operator/(counted a, counted b) { return result(a.varies || b.varies, 4); }
    friend counted operator-(counted a) { return result(a.varies, 1); }
    friend mask operator<(counted a, counted b) { return {result(a.varies || b.varies, 1).varies}; }
    static counted min(counted a, counted b) { return result(a.varies || b.varies, 1); }
    static counted max(counted a, counted b) { return result(a.varies || b.varies, 1); }
    static counted sqrt(counted a) { return result(a.varies, 4); }
    static counted exp(counted a) { return result(a.varies, 15); }
    static counted reciprocal(counted a) { return result(a.varies, 4); }
    static counted fma(counted a, counted b, counted c) { return result(a.varies || b.varies || c.varies, 2); }
    static counted select(mask m, counted a, counted b) { return result(m.varies || a.varies || b.varies, 1); }
};

/// Operations per pixel and offset of a filter that is run offset-major: what is inside a patch once, its separable
/// sums by balanced trees, the weight, and two for each sum.
template <class Filter>
double operations_per_pair(const Filter& filter, int values) {
    using reads = typename Filter::reads;
    std::vector<float> memory(1 << 16);
    const float* p = memory.data();
    const float* q = p + memory.size() / 2;
    const pitch step{64, 64 * (reads::count + 1)};
    counted::q_begin = q;
    counted::operations = 2 * (1 + values);
    const auto count = [&](const auto& self, const auto& nodes) -> void {
        std::apply(
            [&](const auto&... node) {
                ((void)node(pixel_pair<counted, reads>(p, q, step, 1, 1, {q, 1})), ...);
            },
            detail::without_patches(nodes));
        std::apply(
            [&](const auto&... patch) {
                ((counted::operations += 2 * 2 * patch.radius + 1, self(self, std::tuple(patch.inner))), ...);
            },
            detail::patches_in(nodes));
    };
    count(count, filter.as_sweep().weights);
    return static_cast<double>(counted::operations);
}

}  // namespace winnow::benchmarks
