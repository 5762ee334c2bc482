// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How an object moves: a rest pose, carried straight on and turned about a point.
#include <winnow/simulate/effect.hpp>
#include <winnow/simulate/shape.hpp>

namespace winnow::simulate {

/// The pose at time t, in frames: M(t) = T(velocity t) T(pivot) R(axis, spin t) T(-pivot).
struct motion {
    vec3 velocity = vec3::Zero();  ///< world units a frame
    vec3 pivot = vec3::Zero();     ///< in the rest pose
    vec3 axis = vec3::UnitZ();     ///< unit length
    double spin = 0;               ///< radians a frame, counter-clockwise about the axis

    bool moves() const { return velocity != vec3::Zero(); }
    bool turns() const { return spin != 0; }

    /// Rest pose to world.
    template <class Effects>
    vec3 carry(const vec3& p, double t) const {
        vec3 q = p;
        if constexpr (Effects::template has<effect::rotation>)
            if (turns()) q = turn(p - pivot, spin * t) + pivot;
        if constexpr (Effects::template has<effect::translation>)
            if (moves()) q += t * velocity;
        return q;
    }
    template <class Effects>
    vec3 carry_direction(const vec3& d, double t) const {
        if constexpr (Effects::template has<effect::rotation>)
            if (turns()) return turn(d, spin * t);
        return d;
    }

    /// World to rest pose: M^-1.  The inverse of a turn is the turn back; no matrix is inverted.
    template <class Effects>
    vec3 bring_back(const vec3& p, double t) const {
        vec3 q = p;
        if constexpr (Effects::template has<effect::translation>)
            if (moves()) q -= t * velocity;
        if constexpr (Effects::template has<effect::rotation>)
            if (turns()) q = turn(q - pivot, -spin * t) + pivot;
        return q;
    }
    template <class Effects>
    vec3 bring_back_direction(const vec3& d, double t) const {
        return carry_direction<Effects>(d, -t);
    }

    /// Where something can be met while t goes from t0 to t1.
    template <class Effects>
    bounds swept(const bounds& rest, double t0, double t1) const {
        bounds b = rest;
        if constexpr (Effects::template has<effect::rotation>)
            if (turns()) {
                const vec3 far = (rest.low - pivot).cwiseAbs().cwiseMax((rest.high - pivot).cwiseAbs());
                b = bounds{}.grow(pivot - vec3::Constant(far.norm())).grow(pivot + vec3::Constant(far.norm()));
            }
        if constexpr (Effects::template has<effect::translation>)
            if (moves())
                return bounds{}
                    .grow(b.low + t0 * velocity)
                    .grow(b.high + t0 * velocity)
                    .grow(b.low + t1 * velocity)
                    .grow(b.high + t1 * velocity);
        return b;
    }

private:
    /// Rodrigues' formula.
    vec3 turn(const vec3& v, double angle) const {
        const double c = std::cos(angle), s = std::sin(angle);
        return c * v + s * axis.cross(v) + (1 - c) * axis.dot(v) * axis;
    }
};

}  // namespace winnow::simulate
