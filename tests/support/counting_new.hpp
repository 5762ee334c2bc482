// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Counts what the program allocates: this file's source replaces the global operator new.
#include <cstddef>

namespace winnow::test {

struct allocations {
    long long count = 0;    ///< calls of operator new since the program started
    std::size_t bytes = 0;  ///< asked for in all
};

allocations allocations_so_far();

}  // namespace winnow::test
