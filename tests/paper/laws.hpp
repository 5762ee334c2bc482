// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What holds for every filter of a paper.  That crops, tiles, threads and bad pixels change nothing is tested with the
/// executors, for these filters among others.
#include <algorithm>
#include <functional>
#include "support/catch.hpp"
#include "support/papers.hpp"
#include "support/patterns.hpp"

namespace winnow::test {

/// The frame with every pixel moved: the new (x, y) shows what was at from(x, y).
template <class From>
buffers moved(const buffers& in, extent size, const From& from) {
    buffers result = in;
    buffers::each(result, [&](const char*, image<>& i) {
        const image<> before = i;
        i = fill(size, i.channels(), [&](int x, int y, int c) {
            const auto [fx, fy] = from(x, y);
            return before.at(fx, fy, c);
        });
    });
    return result;
}

/// A constant colour is a fixed point, whatever the features.
inline void check_constant(const any_filter& f) {
    const extent size{35, 21};
    buffers in = make_buffers(size);
    const auto constant = [&](image<>& i) { i = fill(size, 3, [](int, int, int c) { return 0.37 + c; }); };
    constant(in.color), constant(in.half_a), constant(in.half_b);
    for (const executor_kind kind : {executor_kind::serial_double, executor_kind::simd})
        CHECK(beyond_relative(4 * 0x1p-24 * 49, f.images(in.layers(), size, {kind})[0], in.color) == "");
}

/// Weights are at most that of the centre, and that is positive: w(p,q) / C(p) is what layers with one bright pixel
/// each become.
inline void check_weights(const any_filter& f, int radius) {
    const extent size{19, 17};
    for (const bool noise_only : {false, true}) {
        buffers in = make_buffers(size);
        if (noise_only)  // differences below the noise: negative distances
            for (image<>* i : {&in.color, &in.half_a, &in.half_b})
                *i = fill(size, 3, [&](int x, int y, int c) { return 0.5 + 0.05 * normal_deviate(5, x, y, c); });
        for (const executor_kind kind : {executor_kind::serial_double, executor_kind::simd})
            for (const auto& [px, py] : {std::pair{9, 8}, std::pair{0, 0}, std::pair{18, 5}}) {
                std::vector<image<>> lit, share;
                output out;
                for (int y = py - radius; y <= py + radius; ++y)
                    for (int x = px - radius; x <= px + radius; ++x)
                        if (x >= 0 && y >= 0 && x < size.width && y < size.height) {
                            lit.push_back(fill(size, 1, [&](int i, int j, int) { return i == x && j == y ? 1 : 0; }));
                            share.emplace_back(size);
                        }
                for (std::size_t i = 0; i < lit.size(); ++i) out.layer(lit[i].view(), share[i].view());
                f(in.layers(), out, {kind});
                double sum = 0, largest = 0, centre = 0;
                for (std::size_t i = 0; i < lit.size(); ++i) {
                    const double w = share[i].at(px, py);
                    CHECK(w >= 0);
                    sum += w;
                    largest = std::max(largest, w);
                    if (lit[i].at(px, py) > 0) centre = w;
                }
                CHECK(centre > 0);
                CHECK(largest <= centre * (1 + 1e-6));
                CHECK(sum == Approx(1).epsilon(1e-5));
            }
    }
}

/// Results lie between the smallest and the largest value in the window.
inline void check_convex(const any_filter& f, int radius) {
    const extent size{41, 27};
    const buffers in = make_buffers(size);
    for (const executor_kind kind : {executor_kind::serial_double, executor_kind::simd}) {
        image<> mean(size, 3), layer(size, 1);
        f(in.layers(), output{mean}.layer(in.depth.view(), layer.view()), {kind});
        int outside = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                float low = 1e30f, high = -1e30f;
                for (int j = std::max(0, y - radius); j <= std::min(size.height - 1, y + radius); ++j)
                    for (int i = std::max(0, x - radius); i <= std::min(size.width - 1, x + radius); ++i)
                        low = std::min(low, in.depth.at(i, j)), high = std::max(high, in.depth.at(i, j));
                outside += !(layer.at(x, y) >= low - 1e-6f && layer.at(x, y) <= high + 1e-6f);
            }
        CHECK(outside == 0);
    }
}

/// Flips, transposition and a quarter turn commute with the filter, up to the order of sums.
inline void check_equivariant(const any_filter& f, double tolerance = 1e-5) {
    const extent size{37, 22}, turned{22, 37};
    const buffers in = make_buffers(size);
    const auto check = [&](extent to, const auto& from) {
        const buffers other = moved(in, to, from);
        for (const executor_kind kind : {executor_kind::serial_double, executor_kind::simd}) {
            const image<> before = f.images(in.layers(), size, {kind})[0],
                          after = f.images(other.layers(), to, {kind})[0];
            const image<> expected = fill(to, 3, [&](int x, int y, int c) {
                const auto [fx, fy] = from(x, y);
                return before.at(fx, fy, c);
            });
            CHECK(beyond(tolerance * largest_magnitude(in.half_a), after, expected) == "");
        }
    };
    check(size, [&](int x, int y) { return std::pair{size.width - 1 - x, y}; });
    check(size, [&](int x, int y) { return std::pair{x, size.height - 1 - y}; });
    check(turned, [&](int x, int y) { return std::pair{y, x}; });
    check(turned, [&](int x, int y) { return std::pair{y, size.height - 1 - x}; });
}

/// a u with variance a^2 Var becomes a F; `make` gives the filter whose radiometric numbers are in units of a.
inline void check_scaling(const std::function<any_filter(double a)>& make) {
    const extent size{37, 22};
    const buffers in = make_buffers(size);
    const image<> expected = make(1).images(in.layers(), size)[0];
    for (const double a : {1e-3, 1.0, 1e3})
        for (const executor_kind kind : {executor_kind::serial_double, executor_kind::simd}) {
            buffers scaled = in;
            const auto times = [&](image<>& i, double by) {
                i = fill(size, 3, [&, before = i](int x, int y, int c) { return before.at(x, y, c) * by; });
            };
            times(scaled.color, a), times(scaled.half_a, a), times(scaled.half_b, a);
            times(scaled.color_variance, a * a);
            times(scaled.half_a_variance, a * a), times(scaled.half_b_variance, a * a);
            image<> found = make(a).images(scaled.layers(), size, {kind})[0];
            times(found, 1 / a);
            CAPTURE(a, static_cast<int>(kind));
            CHECK(beyond(2e-5 * largest_magnitude(in.half_a), found, expected) == "");
        }
}

/// The mean over the window, clipped at the border.
inline image<> box_mean(const image<>& u, int radius) {
    return fill(u.size(), u.channels(), [&](int x, int y, int c) {
        double sum = 0;
        int count = 0;
        for (int j = std::max(0, y - radius); j <= std::min(u.size().height - 1, y + radius); ++j)
            for (int i = std::max(0, x - radius); i <= std::min(u.size().width - 1, x + radius); ++i)
                sum += double{u.at(i, j, c)}, ++count;
        return sum / count;
    });
}

inline double mean_square(const image<>& a, const image<>& b) {
    return compare(a.view(), b.view(), [](double x, double y) { return (x - y) * (x - y); }).mean;
}

/// On a noisy edge the filter is neither the identity nor the plain mean, and better than both.
inline void check_useful(const any_filter& f, int radius) {
    const extent size{53, 38};
    const buffers in = make_buffers(size);
    const image<> clean = fill(size, 3, structure);
    for (const executor_kind kind : {executor_kind::serial, executor_kind::simd}) {
        const image<> found = f.images(in.layers(), size, {kind})[0];
        const image<> box = box_mean(in.color, radius);
        CHECK(beyond(0.02, found, in.color) != "");
        CHECK(beyond(0.02, found, box) != "");
        CHECK(mean_square(found, clean) < 0.6 * mean_square(in.color, clean));
        CHECK(mean_square(found, clean) < 0.6 * mean_square(box, clean));
    }
}

/// What renderers deliver at their worst comes out finite, and alike from lanes and from the definition.
inline void check_hazards(const any_filter& f) {
    const extent size{29, 18};
    const auto constant = [&](image<>& i, double value) {
        i = fill(size, i.channels(), [&](int, int, int) { return value; });
    };
    const auto each_color = [](buffers& b, const auto& g) { g(b.color), g(b.half_a), g(b.half_b); };
    const auto each_variance = [](buffers& b, const auto& g) {
        g(b.color_variance), g(b.half_a_variance), g(b.half_b_variance);
    };
    const auto check = [&](const char* hazard, const auto& spoil, double tolerance = 2e-4) {
        buffers in = make_buffers(size);
        spoil(in);
        const image<> expected = f.images(in.layers(), size)[0],
                      found = f.images(in.layers(), size, {executor_kind::simd})[0];
        CAPTURE(f.name, hazard);
        CHECK(all_finite(expected));
        CHECK(all_finite(found));
        const double scale = std::min(1e3, largest_magnitude(expected));
        CHECK(beyond(tolerance * scale, found, expected) == "");
    };
    check("no variance anywhere", [&](buffers& b) {
        buffers::each(b, [&](const std::string& name, image<>& i) {
            if (name.find("variance") != std::string::npos) constant(i, 0);
        });
    });
    check(
        "one pixel of 1e30", [&](buffers& b) { each_color(b, [](image<>& i) { i.at(14, 9, 1) = 1e30f; }); }, 1e30);
    check("constant features", [&](buffers& b) {
        constant(b.albedo, 0.5), constant(b.normal, 0), constant(b.depth, 1);
        constant(b.albedo_variance, 0), constant(b.normal_variance, 0), constant(b.depth_variance, 0);
    });
    check("negative radiance", [&](buffers& b) {
        each_color(b, [&](image<>& i) {
            i = fill(size, 3, [&, before = i](int x, int y, int c) { return -before.at(x, y, c); });
        });
    });
    check("denormal radiance", [&](buffers& b) {
        each_color(b, [&](image<>& i) {
            i = fill(size, 3, [&, before = i](int x, int y, int c) { return 1e-40 * before.at(x, y, c); });
        });
        each_variance(b, [&](image<>& i) { constant(i, 1e-42); });
    });
    check("constant everything",
          [&](buffers& b) { buffers::each(b, [&](const char*, image<>& i) { constant(i, 0.25); }); });
    check(
        "one pixel of half's largest number",
        [&](buffers& b) { each_color(b, [](image<>& i) { i.at(3, 4, 0) = 65504.0f; }); }, 1e-3);
}

}  // namespace winnow::test
