// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What stands in a buffer where nothing is known.
#include <limits>

namespace winnow::detail {

inline constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace winnow::detail
