// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Stein's unbiased risk estimate of a mean under Gaussian weights of the Mahalanobis distance, in closed form.
/// Moon et al., "Noise Reduction on G-Buffers for Monte Carlo Filtering", 2017, Eq. 6 and appendix A.
#include <winnow/estimator/concept.hpp>
#include <winnow/frame/precision.hpp>

namespace winnow::estimator {

/// What is known of the noise of g: as much along every axis, as the paper has it, or as much as its covariance says.
enum class noise { isotropic, anisotropic };

/// The squared error of the filtered vector g, mean over its D components, where w = exp(-d / (2 h^2)) and d is the
/// distance of Mahalanobis in g itself.  With D_q = g(q) - g(p), s = (A_p + A_q) D_q, W = sum w, C the covariance of
/// the pixel mean, and J = dF/dg = (I + 1/h^2 sum w (g(q) - F) s^T) / W:
///     isotropic     |F - g|^2 / D - tr C / D + 2 tr C / D^2 tr J
///     anisotropic  (|F - g|^2     - tr C     + 2 tr(C J)) / D
/// F - g = sum w D_q / W, so that no large coordinates are subtracted, and the traces follow from sum w d, sum w s and,
/// of the second kind, sum w D_q^T C s.  The first is biased where the noise has a direction, as that of motion has.
template <guide G, noise Kind = noise::isotropic>
struct mahalanobis_sure {
    using role = role::estimator;
    using reads = planes<G, precision_of<G>, mean_covariance_of<G>>;
    static constexpr bool reports = true;
    static constexpr bool needs_halves = false;
    static constexpr bool needs_derivative = false;

    static constexpr int D = G::channels;
    /// Sums of D_q, of s, and of what the trace takes.
    static constexpr int sums = 2 * D + 1;

    template <class Real, class Planes>
    WINNOW_HD void terms(const pixel_pair<Real, Planes>& pq, Real* to) const {
        const scaled_difference<G, pixel_pair<Real, Planes>> apart(pq);
        // Beyond this distance no bandwidth gives any weight, and products might overflow.
        const auto near = apart.squared_distance() < Real(far);
        math::for_each<D>([&](auto i) WINNOW_HD_LAMBDA {
            to[i] = math::select(near, apart.difference(i), Real(0));
            to[D + i] = math::select(near, apart.scaled(i), Real(0));
        });
        to[2 * D] = math::sum_over<D>([&](auto i) WINNOW_HD_LAMBDA { return to[D + i] * spread(pq, to, i); });
    }

    /// From the weight that was summed, its sum W, and the sums of w times the terms.
    template <class Weight, class Real, class Pixel>
    WINNOW_HD Real operator()(const Weight& weight, Real total, const Real* sum, const Pixel& pixel) const {
        Real noise(0), square(0), rest(0);
        math::for_each<D>([&](auto i) WINNOW_HD_LAMBDA {
            noise = noise + pixel.p(mean_covariance_of<G>{}, upper_triangle<D>(i, i));
            square = square + sum[i] * sum[i];
            rest = rest + sum[D + i] * spread(pixel, sum, i);
        });
        // tr(C J) for C = I or C itself.
        const Real own = Kind == noise::isotropic ? Real(D) : noise;
        const Real per_bandwidth = Real(1) / (Real(weight.sigma) * Real(weight.sigma));
        const Real trace = (own + (sum[2 * D] - rest / total) * per_bandwidth) / total;
        const Real of_trace = Kind == noise::isotropic ? noise / Real(D) : Real(1);
        return (square / (total * total) - noise + Real(2) * of_trace * trace) / Real(D);
    }
    bool operator==(const mahalanobis_sure&) const = default;

private:
    static constexpr float far = 1e4f;

    /// (C v)_i, or v_i where noise is taken to have no direction.
    template <class Pair, class Real, class I>
    WINNOW_HD static Real spread(const Pair& pq, const Real* v, I) {
        if constexpr (Kind == noise::isotropic) return v[I{}];
        else
            return math::sum_over<D>([&](auto j) WINNOW_HD_LAMBDA {
                constexpr int at = upper_triangle<D>(I{}, j);
                return pq.p(mean_covariance_of<G>{}, at) * v[j];
            });
    }
};
static_assert(summing_estimator<mahalanobis_sure<position_t>>);

}  // namespace winnow::estimator
