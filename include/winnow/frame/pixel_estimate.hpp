// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What an estimator sees of one channel of one pixel.

namespace winnow {

/// All in the unit of the filtered buffer, or its square.
struct pixel_estimate {
    float input = 0;     ///< the value u before filtering
    float filtered = 0;  ///< the value F after filtering
    float half_a = 0;    ///< the filtered halves, where the estimator needs them
    float half_b = 0;
    float variance = 0;    ///< of u, where the estimator needs the derivative
    float derivative = 0;  ///< dF / du: which share of its own noise the pixel keeps
};

}  // namespace winnow
