// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What an estimator sees of one channel of one pixel.

namespace winnow {

/// All in the unit of the filtered buffer.
struct pixel_estimate {
    float input = 0;     ///< the value before filtering
    float filtered = 0;  ///< the value after filtering
    float half_a = 0;    ///< the filtered halves, where the estimator asks for them
    float half_b = 0;
};

}  // namespace winnow
