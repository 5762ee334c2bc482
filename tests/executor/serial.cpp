// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The definition against loops written straight from the formulas, which know nothing of tiles, planes or policies.
#include <algorithm>
#include <winnow/executor/serial.hpp>
#include "executor/agreement.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

/// The pixel that stands at index i of n: reflected, repeated, or none (-1).
int standing_at(int i, int n, border rule) {
    if (rule == border::clip) return i < 0 || i >= n ? -1 : i;
    if (rule == border::clamp) return i < 0 ? 0 : i >= n ? n - 1 : i;
    while (n > 1 && (i < 0 || i >= n)) i = i < 0 ? -i : 2 * (n - 1) - i;
    return n > 1 ? i : 0;
}

struct naive {
    const buffers& in;
    border rule;
    int radius;

    int column(int x) const { return standing_at(x, in.size().width, rule); }
    int line(int y) const { return standing_at(y, in.size().height, rule); }
    bool exists(int x, int y) const { return column(x) >= 0 && line(y) >= 0; }
    double at(const image<>& i, int x, int y, int c) const { return double{i.at(column(x), line(y), c)}; }

    /// F(p) = sum_q w(p,q) u(q) / sum_q w(p,q).
    template <class Weight>
    image<> filtered(const image<>& u, const Weight& weight) const {
        return fill(in.size(), 3, [&](int x, int y, int c) {
            double sum = 0, total = 0;
            for (int v = y - radius; v <= y + radius; ++v)
                for (int s = x - radius; s <= x + radius; ++s)
                    if (exists(s, v)) {
                        const double w = weight(x, y, s, v);
                        sum += w * at(u, s, v, c);
                        total += w;
                    }
            return sum / total;
        });
    }

    double squared(const image<>& i, int px, int py, int qx, int qy) const {
        double sum = 0;
        for (int c = 0; c < i.channels(); ++c) {
            const double d = at(i, px, py, c) - at(i, qx, qy, c);
            sum += d * d;
        }
        return sum;
    }

    /// The mean over a patch and three channels of the noise-normalised distance.
    double patch_distance(int px, int py, int qx, int qy, int f, double k) const {
        double sum = 0;
        int pairs = 0;
        for (int v = -f; v <= f; ++v)
            for (int s = -f; s <= f; ++s) {
                if (!exists(px + s, py + v) || !exists(qx + s, qy + v)) continue;
                ++pairs;
                for (int c = 0; c < 3; ++c) {
                    const double d = at(in.color, px + s, py + v, c) - at(in.color, qx + s, qy + v, c);
                    const double vp = at(in.color_variance, px + s, py + v, c);
                    const double vq = at(in.color_variance, qx + s, qy + v, c);
                    sum += (d * d - (vp + std::min(vp, vq))) / (1e-10 + k * k * (vp + vq)) / 3;
                }
            }
        return sum / pairs;
    }

    /// Per axis the smaller of the squared one-sided half differences; nothing along an axis that ends at p.
    double gradient(const image<>& i, int x, int y, int c) const {
        const auto half_difference = [&](int ax, int ay, int bx, int by) {
            const double d = (double{i.at(bx, by, c)} - double{i.at(ax, ay, c)}) / 2;
            return d * d;
        };
        double sum = 0;
        if (x > 0 && x + 1 < in.size().width)
            sum += std::min(half_difference(x - 1, y, x, y), half_difference(x, y, x + 1, y));
        if (y > 0 && y + 1 < in.size().height)
            sum += std::min(half_difference(x, y - 1, x, y), half_difference(x, y, x, y + 1));
        return sum;
    }

    double feature_distance(const image<>& i, const image<>& variance, int px, int py, int qx, int qy) const {
        double unexplained = 0, noise = 0, contrast = 0;
        for (int c = 0; c < i.channels(); ++c) {
            const double d = at(i, px, py, c) - at(i, qx, qy, c);
            const double vp = at(variance, px, py, c), vq = at(variance, qx, qy, c);
            unexplained += d * d - (vp + std::min(vp, vq));
            noise += vp;
            contrast += gradient(i, px, py, c);
        }
        return unexplained / (0.6 * 0.6 * std::max({1e-3, noise, contrast}));
    }
};

constexpr extent sizes[] = {{1, 1}, {1, 7}, {9, 1}, {17, 5}, {23, 19}};

/// Results are stored as floats (half a unit in the last place, 6e-8), and the policies square and invert their numbers
/// as floats before use: up to three roundings of 6e-8 in exponents that matter up to about 10.
constexpr double rounding = 3 * 6e-8 * 10;

}  // namespace

TEST_CASE("serial in double is the joint bilateral filter as the formula stands") {
    for (const border rule : all_borders)
        for (const extent size : sizes) {
            const buffers in = make_buffers(size);
            const naive loop{in, rule, 3};
            const image<> expected = loop.filtered(in.color, [&](int px, int py, int qx, int qy) {
                const double space = (px - qx) * (px - qx) + (py - qy) * (py - qy);
                return std::exp(-space / (2 * 5.0 * 5.0) - loop.squared(in.albedo, px, py, qx, qy) / (2 * 0.1 * 0.1) -
                                loop.squared(in.normal, px, py, qx, qy) / (2 * 0.2 * 0.2));
            });
            CAPTURE(static_cast<int>(rule), size.width, size.height);
            const auto found = joint_bilateral({.radius = 3, .border = rule}).images(in.layers(), size);
            CHECK(beyond(rounding * largest_magnitude(in.color), found[0], expected) == "");
        }
}

TEST_CASE("serial in double is non-local means as the formula stands") {
    for (const border rule : all_borders)
        for (const extent size : sizes)
            for (const int f : {0, 1, 2}) {
                const buffers in = make_buffers(size);
                const naive loop{in, rule, 3};
                const image<> expected = loop.filtered(in.color, [&](int px, int py, int qx, int qy) {
                    return std::exp(-std::max(0.0, loop.patch_distance(px, py, qx, qy, f, 0.45)));
                });
                CAPTURE(static_cast<int>(rule), size.width, size.height, f);
                const auto found = nlm({.radius = 3, .patch_radius = f, .border = rule}).images(in.layers(), size);
                CHECK(beyond(rounding * largest_magnitude(in.color), found[0], expected) == "");
            }
}

TEST_CASE("serial in double is the RDFC candidate as the formula stands") {
    for (const border rule : all_borders)
        for (const extent size : sizes) {
            const buffers in = make_buffers(size);
            const naive loop{in, rule, 2};
            const image<> expected = loop.filtered(in.color, [&](int px, int py, int qx, int qy) {
                const double of_features =
                    std::max({loop.feature_distance(in.albedo, in.albedo_variance, px, py, qx, qy),
                              loop.feature_distance(in.normal, in.normal_variance, px, py, qx, qy),
                              loop.feature_distance(in.depth, in.depth_variance, px, py, qx, qy)});
                return std::min(std::exp(-std::max(0.0, loop.patch_distance(px, py, qx, qy, 1, 0.45))),
                                std::exp(-std::max(0.0, of_features)));
            });
            CAPTURE(static_cast<int>(rule), size.width, size.height);
            const auto found = rdfc_candidate({.radius = 2, .border = rule}).images(in.layers(), size);
            CHECK(beyond(rounding * largest_magnitude(in.color), found[0], expected) == "");
        }
}

TEST_CASE("serial in double is dual-buffer non-local means as the formula stands") {
    const extent size{19, 11};
    const buffers in = make_buffers(size);
    // The loop's colour and variance are what guides.
    buffers a_guides = in, b_guides = in;
    a_guides.color = in.half_a, a_guides.color_variance = in.half_a_variance;
    b_guides.color = in.half_b, b_guides.color_variance = in.half_b_variance;
    const auto half = [&](const buffers& guide, const image<>& values) {
        const naive loop{guide, border::clip, 3};
        return loop.filtered(values, [&](int px, int py, int qx, int qy) {
            return std::exp(-std::max(0.0, loop.patch_distance(px, py, qx, qy, 1, 0.45)));
        });
    };
    const image<> a = half(b_guides, in.half_a), b = half(a_guides, in.half_b);
    const image<> expected =
        fill(size, 3, [&](int x, int y, int c) { return (double{a.at(x, y, c)} + double{b.at(x, y, c)}) / 2; });
    const auto found = nlm_dual_buffer().images(in.layers(), size);
    CHECK(beyond(2 * rounding * largest_magnitude(in.half_a), found[0], expected) == "");
}

TEST_CASE("a disk window is the pixels within its radius") {
    const extent size{19, 17};
    const buffers in = make_buffers(size);
    const naive loop{in, border::clip, 4};
    const image<> expected = loop.filtered(in.color, [&](int px, int py, int qx, int qy) {
        const int d = (px - qx) * (px - qx) + (py - qy) * (py - qy);
        return d <= 16 ? std::exp(-d / 8.0) : 0.0;
    });
    const auto found = test::disk({.radius = 4}).images(in.layers(), size);
    CHECK(beyond(rounding * largest_magnitude(in.color), found[0], expected) == "");
}

TEST_CASE("serial in float is within rounding of serial in double") {
    for (const border rule : all_borders) {
        const filter_numbers n{.border = rule};
        check_agreement({21, 14}, n, {{executor_kind::serial}}, all_filters(n));
    }
}
