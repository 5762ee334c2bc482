// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: (return-type-requirement|same_as<double, float>)
#include <winnow/winnow.hpp>
using namespace winnow;
struct half_of_all {
    using role = role::weight;
    using reads = planes<>;
    template <class Real, class Planes>
    auto operator()(const pixel_pair<Real, Planes>&) const {
#ifdef WINNOW_WRONG
        return 0.5;
#else
        return Real(0.5f);
#endif
    }
};
#ifdef WINNOW_WRONG
const auto f = filter{half_of_all{}};
#else
const auto f = filter{half_of_all{}};
#endif
