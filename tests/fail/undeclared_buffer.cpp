// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: must name every buffer that it looks at
#include <winnow/winnow.hpp>
using namespace winnow;
struct depth_apart {
    using role = role::distance;
#ifdef WINNOW_WRONG
    using reads = planes<albedo_t>;
#else
    using reads = planes<depth_t>;
#endif
    template <class Real, class Planes>
    Real operator()(const pixel_pair<Real, Planes>& pq) const {
#ifdef WINNOW_WRONG
        return math::square(pq.p(depth) - pq.q(depth));
#else
        return math::square(pq.p(depth) - pq.q(depth));
#endif
    }
};
const auto f = filter{exponential(depth_apart{})};
void run(const named_layers& in, const output& out) { f(in, out); }
