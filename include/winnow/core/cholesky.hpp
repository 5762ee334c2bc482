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
/// Golub, Van Loan, "Matrix Computations", section 4.1.  Each product is fused with its sum by name: a system that is
/// solved in a larger size, padded with zeros, gives the same bits.
template <class Real, int N>
struct cholesky {
    symmetric<Real, N> factors;  ///< L below the diagonal, 1 / D on it

    /// A pivot below `smallest` is taken for it.  With a ridge r on its diagonal a positive semidefinite matrix has no
    /// pivot below r: `smallest` = r changes only what rounding has done, and then nothing is ever divided by 0.  A row
    /// and column of the unit matrix are left alone by the others: so a smaller system can be solved in this size.
    WINNOW_HD cholesky(const symmetric<Real, N>& a, Real smallest) : factors(a) {
        if constexpr (N > most_unrolled) {
            factorise(smallest);
        } else {
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
                        rest = math::fma(-l, column[K + 1 + j], rest);
                    });
                });
            });
        }
    }
    /// Of a matrix whose factors are known.
    WINNOW_HD explicit cholesky(const symmetric<Real, N>& known) : factors(known) {}

    /// Replaces b by the x with A x = b.
    WINNOW_HD void solve(Real (&b)[N]) const {
        if constexpr (N > most_unrolled) {
            substitute(b);
        } else {
            math::for_each<N>([&]<int K>(math::index<K>) WINNOW_HD_LAMBDA {
                math::for_each<N - 1 - K>([&](auto i) WINNOW_HD_LAMBDA {
                    b[K + 1 + i] = math::fma(-factors.at(K + 1 + i, K), b[K], b[K + 1 + i]);
                });
            });
            math::for_each<N>([&]<int I>(math::index<I>) WINNOW_HD_LAMBDA {
                constexpr int k = N - 1 - I;
                b[k] = b[k] * factors.at(k, k);
                math::for_each<I>(
                    [&](auto i) WINNOW_HD_LAMBDA { b[k] = math::fma(-factors.at(k + 1 + i, k), b[k + 1 + i], b[k]); });
            });
        }
    }

private:
    /// Beyond this size loops stay loops: unrolled, they would take compilers seconds.
    static constexpr int most_unrolled = 11;

    WINNOW_HD void factorise(Real smallest) {
        for (int k = 0; k < N; ++k) {
            const Real inverse = math::reciprocal(math::max(factors.at(k, k), smallest));
            factors.at(k, k) = inverse;
            for (int i = N - 1; i > k; --i) {
                const Real l = factors.at(i, k) * inverse;
                for (int j = k + 1; j <= i; ++j) factors.at(i, j) = math::fma(-l, factors.at(j, k), factors.at(i, j));
                factors.at(i, k) = l;
            }
        }
    }
    WINNOW_HD void substitute(Real (&b)[N]) const {
        for (int k = 0; k < N; ++k)
            for (int i = k + 1; i < N; ++i) b[i] = math::fma(-factors.at(i, k), b[k], b[i]);
        for (int k = N; k-- > 0;) {
            b[k] = b[k] * factors.at(k, k);
            for (int i = k + 1; i < N; ++i) b[k] = math::fma(-factors.at(i, k), b[i], b[k]);
        }
    }
};

}  // namespace winnow
