// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// expect: bool
// A policy that branches: lanes cannot go both ways.
#include <support/archetype.hpp>
#include <winnow/winnow.hpp>
using namespace winnow;
struct brighter {
    using role = role::distance;
    using reads = planes<depth_t>;
    template <class Real, class Planes>
    Real operator()(const pixel_pair<Real, Planes>& pq) const {
#ifdef WINNOW_WRONG
        return pq.p(depth) < pq.q(depth) ? Real(1) : Real(0);
#else
        return math::select(pq.p(depth) < pq.q(depth), Real(1), Real(0));
#endif
    }
};
auto evaluate(const pixel_pair<test::archetype, brighter::reads>& pq) { return brighter{}(pq); }
