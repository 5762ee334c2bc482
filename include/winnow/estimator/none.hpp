// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// No error is asked for, none is worked out.
#include <winnow/estimator/concept.hpp>

namespace winnow::estimator {

struct none {
    using role = role::estimator;
    using reads = planes<>;
    static constexpr bool reports = false;  ///< whether there is an error to write
    static constexpr bool needs_halves = false;
    static constexpr bool needs_derivative = false;

    float operator()(const pixel_estimate&) const { return 0; }
    bool operator==(const none&) const = default;
};
static_assert(estimator_policy<none>);

}  // namespace winnow::estimator
