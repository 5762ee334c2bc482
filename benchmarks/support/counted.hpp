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

/// Operations per pixel and offset of a sweep that is run offset-major: what is inside patches once, its separable sums
/// by balanced trees, what several weights share once, each weight, the slopes of all that where the estimator needs
/// them, and two for each sum.  `values` counts the planes that are filtered.
template <class Sweep>
double operations_of_sweep(const Sweep& sweep, int values) {
    using reads = typename Sweep::reads;
    using varied = varied_in<Sweep>;
    constexpr int channels = detail::channels_of<varied>;
    std::vector<float> memory(1 << 17);
    const float* p = memory.data();
    const float* q = p + memory.size() / 2;
    const pitch step{64, 64 * (reads::count + 1)};
    counted::q_begin = q;
    counted::operations = 0;
    const auto evaluate = [&]<class Node>(const Node& node) {
        if constexpr (detail::varies_with<Node, varied>)
            (void)node(pixel_pair<differential<counted, varied>, reads>(p, q, step, 1, 1, {q, 1}));
        else (void)node(pixel_pair<counted, reads>(p, q, step, 1, 1, {q, 1}));
    };

    const auto count_patches = [&]<class V>(const auto& self, const auto& nodes, std::type_identity<V>) -> void {
        const auto patches = detail::collect_all<detail::is_patch>(nodes);
        const auto inner = std::apply([](const auto&... patch) { return std::tuple(patch.inner...); }, patches);
        const auto simple = detail::look_up_all<detail::is_patch, void>(inner);
        detail::for_each_node(inner, [&](const auto& node, auto i) {
            if (detail::leader(inner, node, i) == i) evaluate(std::get<i>(simple));
        });
        detail::for_each_node(patches, [&]<class Patch>(const Patch& patch, auto) {
            counted::operations += 2 * 2 * patch.radius + 1;
            if constexpr (detail::varies_with<Patch, V>) counted::operations += channels;
        });
        if constexpr (std::tuple_size_v < decltype(patches) >> 0) self(self, inner, std::type_identity<void>{});
    };
    count_patches(count_patches, sweep.weights, std::type_identity<varied>{});

    using weights = std::remove_const_t<decltype(detail::look_up_all<detail::is_patch, varied>(sweep.weights))>;
    const shared_distances<varied, weights> shared(detail::look_up_all<detail::is_patch, varied>(sweep.weights), 0);
    shared.for_each([&](int, const auto& distance) { evaluate(distance); });
    detail::for_each_node(shared.weights(), [&](const auto& weight, auto k) {
        using original = std::tuple_element_t<k, decltype(Sweep::weights)>;
        if constexpr (detail::varies_with<original, varied>) {
            (void)weight(pixel_pair<differential<counted, varied>, reads>(p, q, step, 1, 1, {q, 1}));
            counted::operations += 2 * 2 * channels;
        } else {
            (void)weight(pixel_pair<counted, reads>(p, q, step, 1, 1, {q, 1}));
        }
        counted::operations += 2 * (1 + values);
    });
    return static_cast<double>(counted::operations);
}

template <class Filter>
double operations_per_pair(const Filter& filter, int values) {
    return operations_of_sweep(filter.as_sweep(), values);
}

}  // namespace winnow::benchmarks
