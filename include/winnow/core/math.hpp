// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// All the arithmetic that a policy may use beside + - * / and <.  `Real` is float, double, or a type that offers
/// the same names as static members (SIMD lanes, the tests' archetype).
#include <cmath>
#include <type_traits>
#include <utility>
#include <winnow/core/platform.hpp>

namespace winnow::math {

/// Of a float or a double the second argument may be a plain number: max(d, 0).  Policies write max(d, Real(0)).
template <class Real>
using same = std::type_identity_t<Real>;

template <class Real>
WINNOW_HD Real min(Real a, same<Real> b) {
    if constexpr (std::is_floating_point_v<Real>) return a < b ? a : b;
    else return Real::min(a, b);
}

template <class Real>
WINNOW_HD Real max(Real a, same<Real> b) {
    if constexpr (std::is_floating_point_v<Real>) return a > b ? a : b;
    else return Real::max(a, b);
}

/// a where the condition holds, else b; both are evaluated.
template <class Mask, class Real>
WINNOW_HD Real select(Mask condition, Real a, same<Real> b) {
    if constexpr (std::is_floating_point_v<Real>) return condition ? a : b;
    else return Real::select(condition, a, b);
}

template <class Real>
WINNOW_HD Real sqrt(Real x) {
    if constexpr (std::is_floating_point_v<Real>) return std::sqrt(x);
    else return Real::sqrt(x);
}

/// a * b + c, rounded once where the hardware does.
template <class Real>
WINNOW_HD Real fma(Real a, same<Real> b, same<Real> c) {
    if constexpr (std::is_floating_point_v<Real>) return a * b + c;
    else return Real::fma(a, b, c);
}

/// 1 / x to two units in the last place; x must be a normal positive number below 1e37.
template <class Real>
WINNOW_HD Real reciprocal(Real x) {
    if constexpr (std::is_floating_point_v<Real>) return Real(1) / x;
    else return Real::reciprocal(x);
}

/// Beyond this exponent a weight no longer decays: exp(-80) = 1.8e-35 keeps every weight positive and normal.
inline constexpr float last_exponent = 80.0f;

/// exp(-x) for x >= 0, to a relative 2e-7; x is cut at last_exponent, and a NaN counts as beyond it.
template <class Real>
WINNOW_HD Real exp_neg(Real x) {
    const Real cut = min(x, Real(last_exponent));
    if constexpr (std::is_floating_point_v<Real>) return std::exp(-cut);
    else return Real::exp(-cut);
}

template <class Real>
WINNOW_HD Real square(Real x) {
    return x * x;
}

/// A number that the compiler knows, passed as an argument.
template <int I>
struct index {
    WINNOW_HD constexpr operator int() const { return I; }
};

namespace detail {
template <class F, int... I>
WINNOW_HD void for_each(const F& f, std::integer_sequence<int, I...>) {
    (f(index<I>{}), ...);
}
template <class F, int... I>
WINNOW_HD auto sum_over(const F& f, std::integer_sequence<int, I...>) {
    return (... + f(index<I>{}));
}
}  // namespace detail

/// f(0), f(1), ..., f(Count - 1), each with an index that the compiler knows.
template <int Count, class F>
WINNOW_HD void for_each(const F& f) {
    detail::for_each(f, std::make_integer_sequence<int, Count>{});
}
/// f(0) + f(1) + ... + f(Count - 1), likewise.
template <int Count, class F>
WINNOW_HD auto sum_over(const F& f) {
    return detail::sum_over(f, std::make_integer_sequence<int, Count>{});
}

}  // namespace winnow::math
