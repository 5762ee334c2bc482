// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Weighted least squares over a window: what all filters by local regression have in common.
/// Cleveland, Devlin, "Locally Weighted Regression", 1988; Ruppert, Wand, "Multivariate Locally Weighted Least Squares
/// Regression", 1994.
#include <winnow/core/cholesky.hpp>

namespace winnow {

/// The fit  u(q) ~ beta . x(q)  of the least  sum_q w(q) (u(q) - beta . x(q))^2 + ridge (beta_1^2 + beta_2^2 + ...)
/// with x = (1, x_1, ..., x_N-1).  The intercept beta_0 is free: constants are reproduced, however few neighbours there
/// are.  Real is a number, or a batch of them for pixels side by side.
///
///     normal_equations<Real, N> a;
///     for (groups of neighbours) a.add(w, x, stride);
///     const local_fit<Real, N> fit(a, ridge);
///     row(q) = w(q) * fit.share(x(q));       beta_0 = sum_q row(q) u(q)
///
/// The row of the smoother does not depend on u: the same row filters every layer, and the variance of the result is
/// sum_q row(q)^2 Var(q).
template <class Real, int N>
struct normal_equations {
    symmetric<Real, N> sums;  ///< sum_q w x x^T

    normal_equations() {
        for (Real& s : sums.lower) s = Real(0.0f);
    }

    /// Adds Group neighbours, of weights w[n] and regressors x[n * stride + i].  Several at once, because each sum is
    /// then read and written once for all of them.
    template <int Group>
    WINNOW_HD void add(const Real (&w)[Group], const Real* x, int stride) {
        Real* to = sums.lower;
        for (int i = 0; i < N; ++i) {
            Real wx[Group];
            for (int n = 0; n < Group; ++n) wx[n] = w[n] * x[n * stride + i];
            for (int j = 0; j <= i; ++j, ++to) {
                Real sum = *to;
                for (int n = 0; n < Group; ++n) sum = math::fma(wx[n], x[n * stride + j], sum);
                *to = sum;
            }
        }
    }
};

/// A solved fit.
template <class Real, int N>
class local_fit {
public:
    WINNOW_HD local_fit(const normal_equations<Real, N>& a, float ridge)
        : inverse_(ridged(a.sums, ridge), smallest(a.sums, ridge)) {
        for (int i = 0; i < N; ++i) row_[i] = Real(i == 0 ? 1.0f : 0.0f);
        inverse_.solve(row_);
    }

    /// What a neighbour's value counts per weight:  e_0^T A^-1 x.
    WINNOW_HD Real share(const Real* x) const {
        Real sum = row_[0];  // x[0] is 1
        for (int i = 1; i < N; ++i) sum = math::fma(row_[i], x[i], sum);
        return sum;
    }

    /// All of beta, from  b = sum_q w x u.
    WINNOW_HD void solve(Real (&b)[N]) const { inverse_.solve(b); }

private:
    WINNOW_HD static symmetric<Real, N> ridged(symmetric<Real, N> a, float ridge) {
        for (int i = 1; i < N; ++i) a.at(i, i) = a.at(i, i) + Real(ridge);
        return a;
    }

    /// Of the pivots: the first is the sum of the weights, the others are no smaller than the ridge.
    WINNOW_HD static Real smallest(const symmetric<Real, N>& a, float ridge) {
        return math::max(math::min(a.at(0, 0), Real(ridge)), Real(1e-30f));
    }

    cholesky<Real, N> inverse_;
    Real row_[N];
};

}  // namespace winnow
