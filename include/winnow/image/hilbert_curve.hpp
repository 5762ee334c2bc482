// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// An order of the pixels in which those that follow each other lie together, in both directions alike.
/// Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.
#include <cstdint>
#include <winnow/image/extent.hpp>

namespace winnow {

namespace detail {

/// The part of the curve in the square at (x, y) of side 2^n: from the corner (0, 0) to (1, 0) of it, or, turned by
/// half a circle, from (1, 1) to (0, 1); transposed, with x and y exchanged.
template <class Visit>
void hilbert_square(extent size, std::int64_t x, std::int64_t y, std::int64_t side, bool transposed, bool turned,
                    const Visit& visit) {
    if (x >= size.width || y >= size.height) return;
    if (side == 1) return visit(static_cast<int>(x), static_cast<int>(y));
    const std::int64_t half = side / 2;
    const auto quarter = [&](int i, int j, bool transpose, bool turn) {
        const int a = (transposed ? j : i) ^ int { turned }, b = (transposed ? i : j) ^ int { turned };
        hilbert_square(size, x + a * half, y + b * half, half, transposed != transpose, turned != turn, visit);
    };
    quarter(0, 0, true, false);
    quarter(0, 1, false, false);
    quarter(1, 1, false, false);
    quarter(1, 0, true, true);
}

}  // namespace detail

/// Calls visit(x, y) once for each pixel along the Hilbert curve of the smallest square of side 2^n that holds the
/// image; what lies outside is left out.  Each aligned square of side 2^k is visited in one go.
template <class Visit>
void along_hilbert_curve(extent size, const Visit& visit) {
    std::int64_t side = 1;
    while (side < size.width || side < size.height) side *= 2;
    detail::hilbert_square(size, 0, 0, side, false, false, visit);
}

}  // namespace winnow
