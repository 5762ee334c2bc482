// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What stands outside the image.

namespace winnow {

enum class border {
    clip,    ///< nothing: neighbours outside are not in the sum (the default; never invents data)
    mirror,  ///< the image reflected without repeating the edge pixel: index -1 is 1
    clamp    ///< the edge pixel repeated
};

/// The index in [0, size) that stands at i, or -1 where nothing does.
inline int resolve(border rule, int i, int size) {
    if (i >= 0 && i < size) return i;
    if (rule == border::clip) return -1;
    if (rule == border::clamp || size == 1) return i < 0 ? 0 : size - 1;
    const int period = 2 * (size - 1);
    const int j = (i % period + period) % period;
    return j < size ? j : period - j;
}

}  // namespace winnow
