// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Where the entries of a symmetric matrix lie when only its upper triangle is stored, row by row.
#include <winnow/core/platform.hpp>

namespace winnow {

/// The place of entry (row, column) of an N x N matrix: (0,0), (0,1), ..., (0,N-1), (1,1), ...
template <int N>
WINNOW_HD constexpr int upper_triangle(int row, int column) {
    const int i = row < column ? row : column, j = row < column ? column : row;
    return i * N - i * (i - 1) / 2 + j - i;
}

}  // namespace winnow
