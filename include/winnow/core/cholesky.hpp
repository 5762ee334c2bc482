// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Small symmetric systems of a size that the compiler knows, such as the normal equations of a regression.
#include <winnow/core/math.hpp>

namespace winnow {

/// A symmetric N x N matrix: its lower triangle, row by row.
template <class Real, int N>
struct symmetric {
    static constexpr int count = N * (N + 1) / 2;

    Real lower[count];

    WINNOW_HD static constexpr int place(int i, int j) { return i < j ? place(j, i) : i * (i + 1) / 2 + j; }
    WINNOW_HD Real& at(int i, int j) { return lower[place(i, j)]; }
    WINNOW_HD Real at(int i, int j) const { return lower[place(i, j)]; }
};

/// A positive definite matrix as L D L^T, with ones on the diagonal of L: Cholesky's factors without the square roots.
/// Golub, Van Loan, "Matrix Computations", section 4.1.
template <class Real, int N>
struct cholesky {
    symmetric<Real, N> factors;  ///< L below the diagonal, 1 / D on it

    /// A pivot below `smallest` is taken for it.  With a ridge r on its diagonal a positive semidefinite matrix has no
    /// pivot below r: `smallest` = r changes only what rounding has done, and then nothing is ever divided by 0.  A row
    /// and column of the unit matrix are left alone by the others: so a smaller system can be solved in this size.
    WINNOW_HD cholesky(const symmetric<Real, N>& a, Real smallest) : factors(a) {
        math::for_each<N>([&]<int K>(math::index<K>) WINNOW_HD_LAMBDA {
            Real column[N];  // of D L
            math::for_each<N>([&](auto i) WINNOW_HD_LAMBDA { column[i] = factors.at(i, K); });
            const Real inverse = math::reciprocal(math::max(column[K], smallest));
            factors.at(K, K) = inverse;
            math::for_each<N - 1 - K>([&]<int I>(math::index<I>) WINNOW_HD_LAMBDA {
                const Real l = column[K + 1 + I] * inverse;
                factors.at(K + 1 + I, K) = l;
                math::for_each<I + 1>([&](auto j) WINNOW_HD_LAMBDA {
                    Real& rest = factors.at(K + 1 + I, K + 1 + j);
                    rest = rest - l * column[K + 1 + j];
                });
            });
        });
    }
    /// Of a matrix whose factors are known.
    WINNOW_HD explicit cholesky(const symmetric<Real, N>& known) : factors(known) {}

    /// Replaces b by the x with A x = b.
    WINNOW_HD void solve(Real (&b)[N]) const {
        math::for_each<N>([&]<int K>(math::index<K>) WINNOW_HD_LAMBDA {
            math::for_each<N - 1 - K>(
                [&](auto i) WINNOW_HD_LAMBDA { b[K + 1 + i] = b[K + 1 + i] - factors.at(K + 1 + i, K) * b[K]; });
        });
        math::for_each<N>([&]<int I>(math::index<I>) WINNOW_HD_LAMBDA {
            constexpr int k = N - 1 - I;
            b[k] = b[k] * factors.at(k, k);
            math::for_each<I>([&](auto i) WINNOW_HD_LAMBDA { b[k] = b[k] - factors.at(k + 1 + i, k) * b[k + 1 + i]; });
        });
    }
};

}  // namespace winnow
