// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The coordinates of WLR: which directions of feature space a window shows beyond the features' own noise.
/// Moon, Carr, Yoon, "Adaptive Rendering based on Weighted Local Regression", 2014: truncated singular value
/// decomposition.
#include <winnow/core/symmetric_eigen.hpp>
#include <winnow/frame/pixel_pair.hpp>

namespace winnow::paper {

template <class Features>
struct wlr_regressors;

/// The raw regressors of a neighbour q of p:  z = (dx, dy, f(q) - f(p), ...), 0 where a pixel is missing.
template <guide... Feature>
struct wlr_regressors<planes<Feature...>> {
    static constexpr int count = 2 + planes<Feature...>::count;
    using reads = planes<Feature..., variance_of<Feature>...>;

    template <class Real, class Planes>
    WINNOW_HD static void differences(const pixel_pair<Real, Planes>& pq, Real* z) {
        const Real covered = pq.covered();
        z[0] = covered * pq.dx();
        z[1] = covered * pq.dy();
        int i = 2;
        planes<Feature...>::for_each([&]<class G>(G g) WINNOW_HD_LAMBDA {
            for (int c = 0; c < G::channels; ++c) z[i++] = covered * (pq.q(g, c) - pq.p(g, c));
        });
    }
    /// Adds the variance of each difference; positions in the image have none.
    template <class Real, class Planes>
    WINNOW_HD static void add_noise(const pixel_pair<Real, Planes>& pq, Real* noise) {
        const Real covered = pq.covered();
        int i = 2;
        planes<Feature...>::for_each([&]<class G>(G g) WINNOW_HD_LAMBDA {
            for (int c = 0; c < G::channels; ++c, ++i)
                noise[i] = math::fma(covered, pq.q(variance(g), c) + pq.p(variance(g), c), noise[i]);
        });
    }
};

/// What a window says about its N raw regressors: sums over its pixels.
template <class Real, int N>
struct wlr_moments {
    Real products[N][N];  ///< sum z z^T, below the diagonal and on it
    Real largest[N];      ///< max |z|
    Real noise[N];        ///< sum of the variances of z
    Real pixels;

    wlr_moments() {
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j < N; ++j) products[i][j] = Real(0.0f);
            largest[i] = noise[i] = Real(0.0f);
        }
        pixels = Real(0.0f);
    }

    /// Adds Group neighbours, of regressors z[n * N + i].
    template <int Group>
    WINNOW_HD void add(const Real* z) {
        for (int i = 0; i < N; ++i) {
            for (int n = 0; n < Group; ++n) largest[i] = math::max(largest[i], math::max(z[n * N + i], -z[n * N + i]));
            for (int j = 0; j <= i; ++j) {
                Real sum = products[i][j];
                for (int n = 0; n < Group; ++n) sum = math::fma(z[n * N + i], z[n * N + j], sum);
                products[i][j] = sum;
            }
        }
    }
};

/// The reduced coordinates  y_k = sum_j to[k][j] z_j,  those kept first, the strongest first of all; the others are 0.
/// Each column of z is divided by its largest magnitude; y are its principal components.
///
/// A column, and then a component, is kept if its singular value is above  least sqrt(pixels) + 2 |E|,  with |E| the
/// noise of the features in that direction.  The paper bounds |E| by one number for all directions; direction by
/// direction one noisy feature does not take the others with it.
template <class Real, int N>
struct wlr_subspace {
    Real to[N][N];
    Real rank;

    WINNOW_HD wlr_subspace(const wlr_moments<Real, N>& m, float least) {
        const Real zero(0.0f), one(1.0f), four(4.0f);
        Real scale[N], noise[N], matrix[N][N];
        for (int i = 0; i < N; ++i) {
            scale[i] = math::select(Real(1e-15f) < m.largest[i], one / math::max(m.largest[i], Real(1e-15f)), zero);
            noise[i] = m.noise[i] * scale[i] * scale[i];
            const Real energy = m.products[i][i] * scale[i] * scale[i];
            scale[i] = math::select(four * noise[i] < energy, scale[i], zero);
            noise[i] = m.noise[i] * scale[i] * scale[i];
        }
        for (int i = 0; i < N; ++i)
            for (int j = 0; j <= i; ++j) matrix[i][j] = matrix[j][i] = (m.products[i][j] * scale[i]) * scale[j];
        const symmetric_eigen<Real, N> eigen(matrix);
        const Real root = math::sqrt(m.pixels) * Real(least);
        Real energy[N];
        rank = zero;
        for (int k = 0; k < N; ++k) {
            Real of_noise = zero;
            for (int j = 0; j < N; ++j)
                of_noise = math::fma(eigen.vectors[j][k] * eigen.vectors[j][k], noise[j], of_noise);
            const Real threshold = math::fma(Real(2.0f), math::sqrt(of_noise), root);
            const auto kept = threshold * threshold < eigen.values[k];
            energy[k] = math::select(kept, eigen.values[k], zero);
            rank = rank + math::select(kept, one, zero);
            for (int j = 0; j < N; ++j) to[k][j] = math::select(kept, eigen.vectors[j][k] * scale[j], zero);
        }
        // The largest first, so that the kept ones are the first ones.
        for (int last = N - 1; last > 0; --last)
            for (int k = 0; k < last; ++k) {
                const auto swap = energy[k] < energy[k + 1];
                exchange(swap, energy[k], energy[k + 1]);
                for (int j = 0; j < N; ++j) exchange(swap, to[k][j], to[k + 1][j]);
            }
    }

private:
    template <class Mask>
    WINNOW_HD static void exchange(const Mask& swap, Real& a, Real& b) {
        const Real first = math::select(swap, b, a);
        b = math::select(swap, a, b);
        a = first;
    }
};

}  // namespace winnow::paper
