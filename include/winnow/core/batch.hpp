// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A `Real` as so many numbers side by side: one for float and double, all its lanes for a batch.
#include <algorithm>
#include <type_traits>
#include <winnow/core/platform.hpp>

namespace winnow {

template <class Real>
struct batch_of {
    static constexpr int size = [] {
        if constexpr (std::is_floating_point_v<Real>) return 1;
        else return Real::size;
    }();

    WINNOW_HD static Real load(const float* from) {
        if constexpr (std::is_floating_point_v<Real>) return Real(*from);
        else return Real::load(from);
    }
    WINNOW_HD static void store(const Real& x, float* to) {
        if constexpr (std::is_floating_point_v<Real>) *to = static_cast<float>(x);
        else x.store(to);
    }
    /// The largest of the numbers.
    static float largest(const Real& x) {
        float values[size];
        store(x, values);
        return *std::max_element(values, values + size);
    }
};

}  // namespace winnow
