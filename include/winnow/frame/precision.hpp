// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How the samples of a pixel spread, turned round: the inverse of their covariance says in which direction and how far
/// another pixel's mean has to lie to be a different one.
#include <algorithm>
#include <array>
#include <cmath>
#include <winnow/core/math.hpp>
#include <winnow/core/symmetric.hpp>
#include <winnow/frame/pixel_pair.hpp>

namespace winnow {

/// The inverse of the covariance of the samples of G, the upper triangle row by row as there.
template <guide G>
struct precision_of : guide_named<precision_of<G>, covariance_of<G>::channels> {
    using guide_named<precision_of<G>, covariance_of<G>::channels>::operator=;
    static std::string name() { return G::name() + ".precision"; }
    bool operator==(const precision_of&) const = default;
};
template <guide G>
constexpr precision_of<G> precision(G) {
    return {};
}

/// The covariance of the pixel mean of G: that of the samples over their number.
template <guide G>
struct mean_covariance_of : guide_named<mean_covariance_of<G>, covariance_of<G>::channels> {
    using guide_named<mean_covariance_of<G>, covariance_of<G>::channels>::operator=;
    static std::string name() { return G::name() + ".mean_covariance"; }
    bool operator==(const mean_covariance_of&) const = default;
};
template <guide G>
constexpr mean_covariance_of<G> mean_covariance(G) {
    return {};
}

/// No entry of a precision is larger: its products with coordinates stay finite.
inline constexpr double largest_precision = 1e15;

/// (S + floor I)^-1 of a 3x3 covariance S, in double by the adjugate.  S may have any rank: a sharp pixel of a plane
/// has rank 2, a pixel of one sample 0.  floor = max(ridge tr S, (4 eps |p|)^2), with eps = 6e-8: shorter differences
/// of a coordinate of size |p| are rounding.
inline std::array<float, 6> regularized_precision(const std::array<float, 6>& covariance, double magnitude,
                                                  double ridge) {
    const double trace = std::max(0.0, double{covariance[0]} + covariance[3] + covariance[5]);
    const double rounding = 4 * 6e-8 * magnitude;
    const double floor = std::max({ridge * trace, rounding * rounding, 1e-30});
    // In units of the floor and the trace together, so that no product leaves the range of double.
    const double unit = trace + floor, by = 1 / unit;
    const double xx = (covariance[0] + floor) * by, xy = covariance[1] * by, xz = covariance[2] * by;
    const double yy = (covariance[3] + floor) * by, yz = covariance[4] * by, zz = (covariance[5] + floor) * by;
    const std::array<double, 6> adjugate{yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
                                         xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
    const double determinant = xx * adjugate[0] + xy * adjugate[1] + xz * adjugate[2];
    // Of a covariance it is at least (floor / unit)^3; entries that are none can make it anything.
    const double least = floor * by * (floor * by) * (floor * by);
    const double scale = by / std::max(determinant, least);
    std::array<float, 6> inverse;
    for (int i = 0; i < 6; ++i)
        inverse[i] = static_cast<float>(std::clamp(adjugate[i] * scale, -largest_precision, largest_precision));
    return inverse;
}

/// How far apart p and q are in G, and that in units of both spreads.  `difference(i)` is g_i(q) - g_i(p); `scaled(i)`
/// is the i-th component of (A_p + A_q) times it, where A is the precision.
template <guide G, class Pair>
class scaled_difference {
public:
    using reads = planes<G, precision_of<G>>;
    static constexpr int dimension = G::channels;
    using real = typename Pair::real;

    WINNOW_HD explicit scaled_difference(const Pair& pq) : pq_(pq) {}

    template <class I>
    WINNOW_HD real difference(I i) const {
        return pq_.q(G{}, i) - pq_.p(G{}, i);
    }
    template <class I>
    WINNOW_HD real scaled(I) const {
        return math::sum_over<dimension>([&](auto j) WINNOW_HD_LAMBDA {
            constexpr int at = upper_triangle<dimension>(I{}, j);
            return (pq_.p(precision_of<G>{}, at) + pq_.q(precision_of<G>{}, at)) * difference(j);
        });
    }
    /// The squared distance of Mahalanobis, of both spreads.
    WINNOW_HD real squared_distance() const {
        return math::sum_over<dimension>([&](auto i) WINNOW_HD_LAMBDA { return difference(i) * scaled(i); });
    }

private:
    const Pair& pq_;
};

}  // namespace winnow
