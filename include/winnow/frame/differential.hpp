// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A number that knows its derivative with respect to one buffer of one pixel: put in place of `Real`, it makes every
/// policy tell how its value changes with that pixel.  Forward differentiation, exact to rounding.
#include <utility>
#include <winnow/core/math.hpp>
#include <winnow/frame/pixel_pair.hpp>

namespace winnow {

/// With respect to nothing there is none: clang wants the name all the same, where a sweep has no derivative.
template <class Real, class G>
class differential;

/// value, and slope(c) = d value / d G_c(p) for the channels c of G.  Along an edge of min, max or select the slope is
/// that of the side taken.  Which slopes can differ from 0 is known when the compiler has seen the whole expression:
/// the others cost nothing.
template <class Real, guide G>
class differential<Real, G> {
public:
    static constexpr int channels = G::channels;

    WINNOW_HD differential(Real value) : value_(value) {}
    template <class Number>
    requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, Real>) WINNOW_HD
        explicit differential(Number value)
        : value_(Real(static_cast<float>(value))) {}
    /// Channel c of G itself.
    WINNOW_HD static differential variable(Real value, int c) {
        differential x(value);
        each([&](auto k) WINNOW_HD_LAMBDA {
            if (k == c) x.set(k, Real(1));
        });
        return x;
    }

    WINNOW_HD Real value() const { return value_; }
    WINNOW_HD Real slope(int c) const { return varies_[c] ? slope_[c] : Real(0); }
    WINNOW_HD void set(int c, Real slope) {
        slope_[c] = slope;
        varies_[c] = true;
    }

    friend WINNOW_HD differential operator+(const differential& a, const differential& b) {
        return joined(
            a.value_ + b.value_, a, b, [](Real s) WINNOW_HD_LAMBDA { return s; },
            [](Real s) WINNOW_HD_LAMBDA { return s; });
    }
    friend WINNOW_HD differential operator-(const differential& a, const differential& b) {
        return joined(
            a.value_ - b.value_, a, b, [](Real s) WINNOW_HD_LAMBDA { return s; },
            [](Real s) WINNOW_HD_LAMBDA { return -s; });
    }
    friend WINNOW_HD differential operator*(const differential& a, const differential& b) {
        return joined(
            a.value_ * b.value_, a, b, [&](Real s) WINNOW_HD_LAMBDA { return s * b.value_; },
            [&](Real s) WINNOW_HD_LAMBDA { return s * a.value_; });
    }
    friend WINNOW_HD differential operator/(const differential& a, const differential& b) {
        const Real quotient = a.value_ / b.value_;
        return joined(
            quotient, a, b, [&](Real s) WINNOW_HD_LAMBDA { return s / b.value_; },
            [&](Real s) WINNOW_HD_LAMBDA { return -s * quotient / b.value_; });
    }
    friend WINNOW_HD differential operator-(const differential& a) {
        return mapped(-a.value_, a, [](Real s) WINNOW_HD_LAMBDA { return -s; });
    }
    friend WINNOW_HD auto operator<(const differential& a, const differential& b) { return a.value_ < b.value_; }

    WINNOW_HD static differential min(const differential& a, const differential& b) {
        return either(a < b, math::min(a.value_, b.value_), a, b);
    }
    WINNOW_HD static differential max(const differential& a, const differential& b) {
        return either(b < a, math::max(a.value_, b.value_), a, b);
    }
    template <class Mask>
    WINNOW_HD static differential select(const Mask& m, const differential& a, const differential& b) {
        return either(m, math::select(m, a.value_, b.value_), a, b);
    }
    WINNOW_HD static differential sqrt(const differential& a) {
        const Real root = math::sqrt(a.value_);
        return mapped(root, a, [&](Real s) WINNOW_HD_LAMBDA { return s / (root + root); });
    }
    WINNOW_HD static differential fma(const differential& a, const differential& b, const differential& c) {
        return a * b + c;
    }
    WINNOW_HD static differential reciprocal(const differential& a) {
        const Real r = math::reciprocal(a.value_);
        return mapped(r, a, [&](Real s) WINNOW_HD_LAMBDA { return -s * r * r; });
    }
    WINNOW_HD static differential exp(const differential& a) {
        const Real e = math::exp_neg(-a.value_);
        return mapped(e, a, [&](Real s) WINNOW_HD_LAMBDA { return s * e; });
    }

private:
    /// The slopes of a and b, each times its share of the result's, added up.
    template <class ShareA, class ShareB>
    WINNOW_HD static differential joined(Real value, const differential& a, const differential& b, const ShareA& of_a,
                                         const ShareB& of_b) {
        differential x(value);
        each([&](auto k) WINNOW_HD_LAMBDA {
            if (a.varies_[k] && b.varies_[k]) x.set(k, of_a(a.slope_[k]) + of_b(b.slope_[k]));
            else if (a.varies_[k]) x.set(k, of_a(a.slope_[k]));
            else if (b.varies_[k]) x.set(k, of_b(b.slope_[k]));
        });
        return x;
    }
    template <class Share>
    WINNOW_HD static differential mapped(Real value, const differential& a, const Share& of_a) {
        differential x(value);
        each([&](auto k) WINNOW_HD_LAMBDA {
            if (a.varies_[k]) x.set(k, of_a(a.slope_[k]));
        });
        return x;
    }
    template <class Mask>
    WINNOW_HD static differential either(const Mask& m, Real value, const differential& a, const differential& b) {
        differential x(value);
        each([&](auto k) WINNOW_HD_LAMBDA {
            if (a.varies_[k] || b.varies_[k]) x.set(k, math::select(m, a.slope(k), b.slope(k)));
        });
        return x;
    }

    template <class F>
    WINNOW_HD static void each(const F& f) {
        math::for_each<channels>(f);
    }

    Real value_;
    Real slope_[channels];
    bool varies_[channels] = {};
};

/// The pair (p, q) as seen by whoever asks what G(p) does to an expression: wherever the expression meets the pixel p,
/// be it in a patch, on the side of p or on that of q, its G is the variable.  Of copies of p that a border rule makes
/// beyond the image it knows nothing.
template <class Real, class G, class Planes>
class pixel_pair<differential<Real, G>, Planes> {
public:
    using real = differential<Real, G>;

    WINNOW_HD pixel_pair(const float* p, const float* q, pitch step, int dx, int dy, prepared ahead = {})
        : plain_(p, q, step, dx, dy, ahead), dx_(dx), dy_(dy) {}

    /// The same pair where only G at p, or only G at q, is the variable: how an executor splits the derivative of a
    /// patch in two.
    WINNOW_HD pixel_pair varying(bool at_p, bool at_q) const {
        pixel_pair one = *this;
        one.at_p_ = at_p;
        one.at_q_ = at_q;
        return one;
    }

    /// The same pair where q is in another frame than p: no shift leads from q to p.
    WINNOW_HD pixel_pair to_other_frame() const {
        pixel_pair other = *this;
        other.other_frame_ = true;
        return other;
    }

    template <class H>
    WINNOW_HD real p(H, int c = 0) const {
        if constexpr (std::is_same_v<H, G>)
            if (at_p_) return real::variable(plain_.p(H{}, c), c);
        return plain_.p(H{}, c);
    }
    template <class H>
    WINNOW_HD real q(H, int c = 0) const {
        if constexpr (std::is_same_v<H, G>)
            if (at_q_) return real::variable(plain_.q(H{}, c), c);
        return plain_.q(H{}, c);
    }
    WINNOW_HD real dx() const { return plain_.dx(); }
    WINNOW_HD real dy() const { return plain_.dy(); }

    WINNOW_HD pixel_pair shifted(int x, int y) const {
        pixel_pair moved = *this;
        moved.plain_ = plain_.shifted(x, y);
        moved.x_ = x_ + x;
        moved.y_ = y_ + y;
        moved.at_p_ = moved.x_ == 0 && moved.y_ == 0;
        moved.at_q_ = !other_frame_ && moved.x_ == -dx_ && moved.y_ == -dy_;
        return moved;
    }
    WINNOW_HD real covered() const { return plain_.covered(); }
    WINNOW_HD real ahead(int index) const { return plain_.ahead(index); }
    WINNOW_HD real of_offset(int index) const { return plain_.of_offset(index); }
    /// What the executor worked out ahead together with its slopes, in the places after `index`.
    WINNOW_HD real ahead_with_slopes(int index) const {
        real x = plain_.ahead(index);
        for (int c = 0; c < G::channels; ++c) x.set(c, plain_.ahead(index + 1 + c));
        return x;
    }

private:
    pixel_pair<Real, Planes> plain_;
    int dx_, dy_;
    int x_ = 0, y_ = 0;  ///< how far it has been shifted
    /// A pixel with itself: weights do not change with it, so that only p's side has to be looked at.
    bool at_p_ = true, at_q_ = false;
    bool other_frame_ = false;
};

}  // namespace winnow
