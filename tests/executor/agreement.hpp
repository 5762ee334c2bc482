// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How far an executor in float may be from the definition in double, and the check that it is not.
#include <cmath>
#include "support/catch.hpp"
#include "support/filters.hpp"

namespace winnow::test {

/// Bound on |F_float - F_double| in units of the largest input value, worst case, for n = (2 radius + 1)^2 neighbours
/// and patches of side s = 2 f + 1.  With e = 2^-24 the unit roundoff:
/// - An exponent x is a sum of terms of both signs: the terms that noise explains add up to at most 10 (2/k^2 with
///   k = 0.45), so the magnitudes add up to at most x + 20.  Sums over a patch take s^2 additions pixel by pixel, and
///   about 30 operations go into a term: the error is at most (s^2 + 30) e (x + 20).
/// - An error dx of an exponent changes F by at most dx w |u - F| / C, |u - F| <= 2.  The centre has weight 1, so the
///   mean of x under the weights is at most ln n.
/// - The exponential is good to 2e-7 on either side; n weights and n products are added: n e each, twice.
inline double rounding_bound(filter_numbers n) {
    const double e = 0x1p-24, side = 2 * n.patch_radius + 5, count = (2 * n.radius + 1) * (2 * n.radius + 1);
    return 2 * ((side * side + 30) * e * (std::log(count) + 20) + 4e-7 + 2 * count * e);
}

/// On average rounding stays far below the worst case: a slightly wrong constant does not.  Only sums of many like
/// numbers drift to one side.
inline double mean_bound(filter_numbers n) {
    const double count = (2 * n.radius + 1) * (2 * n.radius + 1);
    return 1e-6 + 0.1 * count * 0x1p-24;
}

/// Every filter, as `h` runs it, against the definition.
inline void check_agreement(extent size, filter_numbers n, const std::vector<how>& hows,
                            const std::vector<any_filter>& filters) {
    const buffers in = make_buffers(size);
    const double scale = std::max(largest_magnitude(in.half_a), largest_magnitude(in.half_b));
    for (const any_filter& f : filters) {
        const auto expected = f.images(in.layers(), size);
        for (const how& h : hows) {
            CAPTURE(f.name, to_string(h), to_string(size), n.radius, n.patch_radius, static_cast<int>(n.border));
            const auto found = f.images(in.layers(), size, h);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                CHECK(beyond(rounding_bound(n) * scale, found[i], expected[i]) == "");
                const difference d =
                    compare(found[i].view(), expected[i].view(), [](double a, double b) { return std::abs(a - b); });
                CHECK(d.mean <= mean_bound(n) * scale);
            }
        }
    }
}

/// Every filter gives the same bits in all these ways.
inline void check_same_bits(extent size, const std::vector<how>& hows, const std::vector<any_filter>& filters) {
    const buffers in = make_buffers(size);
    for (const any_filter& f : filters) {
        const auto expected = f.images(in.layers(), size, hows[0]);
        for (const how& h : hows) {
            CAPTURE(f.name, to_string(h), to_string(size));
            const auto found = f.images(in.layers(), size, h);
            for (std::size_t i = 0; i < expected.size(); ++i) CHECK(other_bits(found[i], expected[i]) == "");
        }
    }
}

inline constexpr border all_borders[] = {border::clip, border::mirror, border::clamp};

}  // namespace winnow::test
