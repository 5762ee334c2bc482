// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Shapes, each met by a ray in closed form.
#include <algorithm>
#include <array>
#include <concepts>
#include <winnow/simulate/vector.hpp>

namespace winnow::simulate {

/// A box with sides along the axes.
struct bounds {
    vec3 low = vec3::Constant(infinity), high = vec3::Constant(-infinity);

    bounds& grow(const vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
        return *this;
    }
    bounds& grow(const bounds& b) { return grow(b.low).grow(b.high); }
    vec3 centre() const { return (low + high) / 2; }
    double area() const {
        const vec3 d = (high - low).cwiseMax(0);
        return 2 * (d.x() * d.y() + d.y() * d.z() + d.z() * d.x());
    }
};

/// What a surface is like at one of its points.
struct surface_point {
    vec3 normal;   ///< unit length, outward
    vec3 tangent;  ///< along which u grows; unit length
    vec2 uv;       ///< in [0, 1]^2, or what the shape says
};

/// A shape says where a ray meets it first beyond `near` (infinity where it does not), and what it is like there.
template <class S>
concept shape = requires(const S& s, const ray& r, const vec3& p) {
    { s.intersect(r, 0.0) } -> std::same_as<double>;
    { s.at(p) } -> std::same_as<surface_point>;
    { s.bounding() } -> std::same_as<bounds>;
};

/// A parallelogram: corner + u a + v b.  Its normal is a x b.
class quad {
public:
    quad(const vec3& corner, const vec3& a, const vec3& b)
        : corner_(corner), a_(a), b_(b), normal_(a.cross(b).normalized()) {
        const vec3 n = a.cross(b);
        dual_a_ = b.cross(n) / n.squaredNorm();
        dual_b_ = n.cross(a) / n.squaredNorm();
    }
    double intersect(const ray& r, double near) const {
        const double t = (corner_ - r.origin).dot(normal_) / r.direction.dot(normal_);
        if (!(t > near && t < infinity)) return infinity;
        const vec3 p = r.at(t) - corner_;
        const double u = p.dot(dual_a_), v = p.dot(dual_b_);
        return u >= 0 && u <= 1 && v >= 0 && v <= 1 ? t : infinity;
    }
    surface_point at(const vec3& p) const {
        return {normal_, a_.normalized(), {(p - corner_).dot(dual_a_), (p - corner_).dot(dual_b_)}};
    }
    bounds bounding() const {
        return bounds{}.grow(corner_).grow(corner_ + a_).grow(corner_ + b_).grow(corner_ + a_ + b_);
    }
    double area() const { return a_.cross(b_).norm(); }
    vec3 point(const vec2& uv) const { return corner_ + uv.x() * a_ + uv.y() * b_; }

private:
    vec3 corner_, a_, b_, normal_, dual_a_, dual_b_;
};

/// A flat disc; uv is the point in units of the radius, in [-1, 1]^2, so that spokes and rings are easy to paint.
class disc {
public:
    disc(const vec3& centre, const vec3& normal, double radius)
        : centre_(centre), frame_(normal.normalized()), radius_(radius) {}
    double intersect(const ray& r, double near) const {
        const double t = (centre_ - r.origin).dot(frame_.n) / r.direction.dot(frame_.n);
        return t > near && t < infinity && (r.at(t) - centre_).squaredNorm() <= radius_ * radius_ ? t : infinity;
    }
    surface_point at(const vec3& p) const {
        const vec3 q = frame_.to_local(p - centre_) / radius_;
        return {frame_.n, frame_.s, {q.x(), q.y()}};
    }
    bounds bounding() const {
        const vec3 reach = radius_ * (vec3::Ones() - frame_.n.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
        return bounds{}.grow(centre_ - reach).grow(centre_ + reach);
    }

private:
    vec3 centre_;
    basis frame_;
    double radius_;
};

/// An ellipsoid with its axes along those of the world; uv are longitude and latitude.
class ellipsoid {
public:
    ellipsoid(const vec3& centre, const vec3& radii) : centre_(centre), radii_(radii) {}
    double intersect(const ray& r, double near) const {
        // In units of the radii the ray meets a unit sphere, at the same t.
        const vec3 o = (r.origin - centre_).cwiseQuotient(radii_), d = r.direction.cwiseQuotient(radii_);
        const double a = d.squaredNorm(), b = -o.dot(d);
        // The distance of the centre from the ray: no difference of large squares (Hearn and Baker).
        const double discriminant = 1 - (o + b / a * d).squaredNorm();
        if (!(discriminant >= 0)) return infinity;
        const double root = std::sqrt(a * discriminant);
        const double first = (b - root) / a, second = (b + root) / a;
        return first > near ? first : second > near ? second : infinity;
    }
    surface_point at(const vec3& p) const {
        const vec3 q = (p - centre_).cwiseQuotient(radii_);
        const vec3 normal = q.cwiseQuotient(radii_).normalized();
        const vec3 along = vec3(-q.y() * radii_.x(), q.x() * radii_.y(), 0);
        const vec3 tangent = along.squaredNorm() > 1e-20 ? along.normalized() : basis(normal).s;
        return {
            normal, tangent, {std::atan2(q.y(), q.x()) / (2 * pi) + 0.5, std::acos(std::clamp(q.z(), -1.0, 1.0)) / pi}};
    }
    bounds bounding() const { return bounds{}.grow(centre_ - radii_).grow(centre_ + radii_); }
    const vec3& centre() const { return centre_; }
    const vec3& radii() const { return radii_; }

private:
    vec3 centre_, radii_;
};
inline ellipsoid sphere(const vec3& centre, double radius) { return {centre, vec3::Constant(radius)}; }

/// A triangle; uv are two of its barycentric coordinates.
class triangle {
public:
    triangle(const vec3& a, const vec3& b, const vec3& c) : a_(a), ab_(b - a), ac_(c - a) {}
    double intersect(const ray& r, double near) const {  // Moeller and Trumbore 1997
        const vec3 p = r.direction.cross(ac_);
        const double determinant = ab_.dot(p);
        if (determinant == 0) return infinity;
        const vec3 s = r.origin - a_, q = s.cross(ab_);
        const double u = s.dot(p) / determinant, v = r.direction.dot(q) / determinant;
        const double t = ac_.dot(q) / determinant;
        return u >= 0 && v >= 0 && u + v <= 1 && t > near ? t : infinity;
    }
    surface_point at(const vec3& p) const {
        const vec3 n = ab_.cross(ac_), q = p - a_;
        const double scale = 1 / n.squaredNorm();
        return {n.normalized(), ab_.normalized(), {q.cross(ac_).dot(n) * scale, ab_.cross(q).dot(n) * scale}};
    }
    bounds bounding() const { return bounds{}.grow(a_).grow(a_ + ab_).grow(a_ + ac_); }

private:
    vec3 a_, ab_, ac_;
};

/// The open mantle of a cone that is cut off, from radius `r0` at the base to `r1` at the top; equal radii make a tube.
/// u goes around, v from base to top.
class frustum {
public:
    frustum(const vec3& base, const vec3& top, double r0, double r1)
        : base_(base),
          frame_((top - base).normalized()),
          height_((top - base).norm()),
          r0_(r0),
          slope_((r1 - r0) / height_) {}
    double intersect(const ray& r, double near) const {
        const vec3 o = frame_.to_local(r.origin - base_), d = frame_.to_local(r.direction);
        // x^2 + y^2 = (r0 + slope z)^2 along the ray: a t^2 + 2 b t + c = 0.
        const double radius = r0_ + slope_ * o.z(), grows = slope_ * d.z();
        const double a = d.x() * d.x() + d.y() * d.y() - grows * grows;
        const double b = o.x() * d.x() + o.y() * d.y() - radius * grows;
        const double c = o.x() * o.x() + o.y() * o.y() - radius * radius;
        const double discriminant = b * b - a * c;
        if (!(discriminant >= 0)) return infinity;
        // The root that does not cancel, and the other from their product.
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        std::array<double, 2> t{q / a, c / q};
        if (t[1] < t[0]) std::swap(t[0], t[1]);
        for (const double hit : t) {
            const double z = o.z() + hit * d.z();
            if (hit > near && hit < infinity && z >= 0 && z <= height_ && r0_ + slope_ * z >= 0) return hit;
        }
        return infinity;
    }
    surface_point at(const vec3& p) const {
        const vec3 q = frame_.to_local(p - base_);
        const double around = std::hypot(q.x(), q.y());
        const vec3 out = around > 0 ? vec3(q.x() / around, q.y() / around, -slope_) : vec3(0, 0, 1);
        return {frame_.to_world(out).normalized(),
                frame_.to_world({-out.y(), out.x(), 0}).normalized(),
                {std::atan2(q.y(), q.x()) / (2 * pi) + 0.5, q.z() / height_}};
    }
    bounds bounding() const {
        const double r = std::max(r0_, r0_ + slope_ * height_);
        const vec3 reach = r * (vec3::Ones() - frame_.n.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
        const vec3 top = base_ + height_ * frame_.n;
        return bounds{}.grow(base_ - reach).grow(base_ + reach).grow(top - reach).grow(top + reach);
    }

private:
    vec3 base_;
    basis frame_;
    double height_, r0_, slope_;
};

static_assert(shape<quad> && shape<disc> && shape<ellipsoid> && shape<triangle> && shape<frustum>);

}  // namespace winnow::simulate
