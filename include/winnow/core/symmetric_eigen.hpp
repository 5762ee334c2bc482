// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Eigenvalues and eigenvectors of a small symmetric matrix, for many matrices at once where Real is a batch.
/// Jacobi, "Ueber ein leichtes Verfahren, die in der Theorie der Saecularstoerungen vorkommenden Gleichungen numerisch
/// aufzuloesen", 1846; Golub, Van Loan, "Matrix Computations", 4th edition 2013, section 8.5.
#include <winnow/core/batch.hpp>
#include <winnow/core/math.hpp>

namespace winnow {

/// A = V diag(values) V^T for a matrix without negative eigenvalues; column k of V belongs to values[k].  They come in
/// the order of the matrix's own columns, not by size.
///
/// Two columns whose product is below 1e-6 of their lengths', or 1e-7 of the trace, count as orthogonal: where an
/// eigenvalue is double any basis will do, and rounding is not to choose it.
template <class Real, int N>
struct symmetric_eigen {
    static constexpr int most_sweeps = 10;  ///< off-diagonal elements shrink quadratically: 4 to 6 do for N = 9
    static constexpr float orthogonal = 1e-6f;
    static constexpr float rounded = 1e-7f;

    Real values[N];
    Real vectors[N][N];

    explicit symmetric_eigen(const Real (&matrix)[N][N]) {
        Real a[N][N];
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j) {
                a[i][j] = matrix[i][j];
                vectors[i][j] = Real(i == j ? 1.0f : 0.0f);
            }
        Real trace(0.0f), turned(1.0f);
        for (int i = 0; i < N; ++i) trace = trace + a[i][i];
        const Real rounding = math::square(trace * Real(rounded));
        for (int sweep = 0; sweep < most_sweeps && batch_of<Real>::largest(turned) > 0; ++sweep) {
            turned = Real(0.0f);
            for (int p = 0; p < N; ++p)
                for (int q = p + 1; q < N; ++q) turned = math::max(turned, rotate(a, p, q, rounding));
        }
        for (int i = 0; i < N; ++i) values[i] = math::max(a[i][i], Real(0.0f));
    }

private:
    /// The rotation in the plane of p and q by at most 45 degrees after which a[p][q] is 0.  Returns 1 where it was
    /// needed, else 0, and then nothing has changed.
    Real rotate(Real (&a)[N][N], int p, int q, const Real& rounding) {
        const Real zero(0.0f), one(1.0f), off = a[p][q], distance = a[q][q] - a[p][p];
        const Real size = math::max(distance, -distance);
        const Real length = size + math::sqrt(math::fma(distance, distance, Real(4.0f) * off * off));
        // tan(2 angle) = 2 off / distance, in the form that neither cancels nor divides by 0.
        const Real tangent = (off + off) * math::reciprocal(math::max(length, Real(1e-30f)));
        const Real nothing = math::fma(a[p][p] * a[q][q], Real(orthogonal * orthogonal), rounding);
        const Real turned = math::select(distance < zero, -tangent, tangent);
        const auto needed = nothing < off * off;
        const Real t = math::select(needed, turned, zero);
        const Real c = math::select(needed, math::reciprocal(math::sqrt(math::fma(t, t, one))), one), s = t * c;
        a[p][p] = math::max(math::fma(-t, off, a[p][p]), zero);
        a[q][q] = math::max(math::fma(t, off, a[q][q]), zero);
        a[p][q] = a[q][p] = math::select(needed, zero, off);
        for (int k = 0; k < N; ++k) {
            const Real v_p = vectors[k][p], v_q = vectors[k][q];
            vectors[k][p] = math::fma(c, v_p, -s * v_q);
            vectors[k][q] = math::fma(s, v_p, c * v_q);
            if (k == p || k == q) continue;
            const Real a_p = a[k][p], a_q = a[k][q];
            a[k][p] = a[p][k] = math::fma(c, a_p, -s * a_q);
            a[k][q] = a[q][k] = math::fma(s, a_p, c * a_q);
        }
        return math::select(needed, one, zero);
    }
};

}  // namespace winnow
