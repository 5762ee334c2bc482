// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Counts what the program allocates: this file's source replaces the global operator new.  Not with sanitizers, which
/// bring their own.
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WINNOW_TEST_SANITIZED 1
#elif defined(__has_feature)
#define WINNOW_TEST_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define WINNOW_TEST_SANITIZED 0
#endif

namespace winnow::test {

inline constexpr bool allocations_are_counted = !WINNOW_TEST_SANITIZED;

struct allocations {
    long long count = 0;    ///< calls of operator new since the program started
    std::size_t bytes = 0;  ///< asked for in all
};

/// Nothing where allocations are not counted.
allocations allocations_so_far();

}  // namespace winnow::test
