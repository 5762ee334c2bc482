// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The window of WLR as its fits see it: coordinates and weights of all neighbours.
/// Moon, Carr, Yoon, "Adaptive Rendering based on Weighted Local Regression", 2014.
#include <cstddef>
#include <winnow/core/batch.hpp>
#include <winnow/paper/wlr_2014_bandwidth.hpp>
#include <winnow/paper/wlr_2014_subspace.hpp>

namespace winnow::paper {

/// Where a neighbour is.
struct wlr_neighbour {
    std::ptrdiff_t at;  ///< floats from the pixel to it
    int dx, dy;
};

/// Works on one batch of pixels at a time; `Planes` are those that are staged.
template <class Real, class Features, class Planes>
class wlr_window {
public:
    using regressors = wlr_regressors<Features>;
    using pair = pixel_pair<Real, Planes>;
    static constexpr int count = regressors::count;
    static constexpr int group = 4;  ///< neighbours that are added to sums at once

    /// Memory for the coordinates (1, y) of all neighbours and their weights.
    static std::size_t reals(int neighbours) { return static_cast<std::size_t>(neighbours) * (count + 2); }

    /// `neighbours` holds `real` ones, the pixel itself and copies of it to fill the last group.
    wlr_window(const wlr_numbers& numbers, const wlr_neighbour* neighbours, int real, int padded, pitch step,
               Real* memory)
        : n_(numbers),
          neighbours_(neighbours),
          real_(real),
          padded_(padded),
          step_(step),
          x_(memory),
          prior_(x_ + std::ptrdiff_t{padded} * (count + 1)) {}

    int neighbours() const { return real_; }
    int padded() const { return padded_; }

    pair at(const float* p, int i) const {
        const wlr_neighbour& q = neighbours_[i];
        return pair(p, p + q.at, step_, q.dx, q.dy);
    }
    pair self(const float* p) const { return pair(p, p, step_, 0, 0); }
    /// The value of a plane at neighbour i.
    WINNOW_HD Real load(const float* p, int i, std::ptrdiff_t plane) const {
        return batch_of<Real>::load(p + neighbours_[i].at + plane);
    }
    /// (1, y) of neighbour i.
    Real* x(int i) const { return x_ + std::ptrdiff_t{i} * (count + 1); }

    /// The mean of the channels of q, and something added: fused by name, because left to the compiler the bits would
    /// depend on the code around.
    template <class G>
    WINNOW_HD static Real mean_of(G, const pair& pq, const Real& and_add = Real(0.0f)) {
        return math::fma(pq.q(G{}, 0) + pq.q(G{}, 1) + pq.q(G{}, 2), Real(1.0f / 3), and_add);
    }

    template <class G>
    std::ptrdiff_t plane_of(G, int c) const {
        return (1 + slot_of<G>(Planes{}) + c) * step_.plane;
    }

    std::ptrdiff_t plane_of_value(int v) const { return (1 + Planes::count + v) * step_.plane; }

    wlr_moments<Real, count> moments(const float* p) const {
        wlr_moments<Real, count> m;
        for (int i = 0; i < padded_; i += group) {
            Real z[group * count];
            for (int n = 0; n < group; ++n) regressors::differences(at(p, i + n), z + n * count);
            m.template add<group>(z);
        }
        for (int i = 0; i < real_; ++i) {
            const pair pq = at(p, i);
            m.pixels = m.pixels + pq.covered();
            regressors::add_noise(pq, m.noise);
        }
        return m;
    }

    /// The coordinates of all neighbours, and the weight that each has before any kernel: none where it is missing or
    /// an outlier, less where it is noisy.
    void gather(const float* p, const wlr_subspace<Real, count>& s) {
        const int kept = static_cast<int>(batch_of<Real>::largest(s.rank));
        const Real zero(0.0f), one(1.0f), per_unit(1 / (n_.unit * n_.unit));
        const Real grey = mean_of(color, self(p)), deviation = math::sqrt(mean_of(variance(color), self(p)));
        Real best = zero;
        for (int i = 0; i < padded_; i += group) {
            Real z[group][count];
            for (int n = 0; n < group; ++n) {
                regressors::differences(at(p, i + n), z[n]);
                x(i + n)[0] = one;
            }
            for (int k = 0; k < kept; ++k) {
                Real y[group];
                for (int n = 0; n < group; ++n) y[n] = s.to[k][0] * z[n][0];
                for (int j = 1; j < count; ++j)
                    for (int n = 0; n < group; ++n) y[n] = math::fma(s.to[k][j], z[n][j], y[n]);
                for (int n = 0; n < group; ++n) x(i + n)[1 + k] = y[n];
            }
            for (int k = kept; k < count; ++k)
                for (int n = 0; n < group; ++n) x(i + n)[1 + k] = zero;
            for (int n = 0; n < group; ++n) {
                const pair pq = at(p, i + n);
                const Real noise = mean_of(variance(color), pq), off = mean_of(color, pq, -grey);
                const Real allowed =
                    math::fma(Real(n_.outlier_sigmas), deviation + math::sqrt(noise), Real(n_.outlier_floor * n_.unit));
                const Real w = pq.covered() / math::max(noise * per_unit, one);
                prior_[i + n] = i + n < real_ ? math::select(allowed < math::max(off, -off), zero, w) : zero;
                best = math::max(best, prior_[i + n]);
            }
        }
        // Relative to the best, so that a ridge means the same wherever it is noisy.
        const Real by = one / math::max(best, Real(1e-30f));
        for (int i = 0; i < padded_; ++i) prior_[i] = prior_[i] * by;
    }

    /// The product over coordinates of  max(0, 1 - y^2 / (h b)^2).
    template <int D>
    WINNOW_HD static Real epanechnikov(const Real* x, const Real (&narrow)[D]) {
        Real w(1.0f);
        for (int k = 0; k < D; ++k)
            w = w * math::max(math::fma(-(x[1 + k] * x[1 + k]), narrow[k], Real(1.0f)), Real(0.0f));
        return w;
    }

    /// The weight of neighbour i in a fit.
    template <int D>
    WINNOW_HD Real weight(int i, const Real (&narrow)[D]) const {
        return prior_[i] * epanechnikov<D>(x(i), narrow);
    }

private:
    const wlr_numbers& n_;
    const wlr_neighbour* neighbours_;
    int real_, padded_;
    pitch step_;
    Real* x_;      // (1, y) of each neighbour
    Real* prior_;  // its weight before any kernel
};

}  // namespace winnow::paper
