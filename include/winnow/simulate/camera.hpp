// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A perspective camera with a thin lens.
#include <winnow/image/extent.hpp>
#include <winnow/simulate/vector.hpp>

namespace winnow::simulate {

/// Where the camera is and what it looks at; world units and degrees.
struct camera {
    vec3 eye = vec3::Zero(), target = vec3::UnitY(), up = vec3::UnitZ();
    double field_of_view = 40;  ///< from the left to the right edge of the image
    double lens_radius = 0;     ///< see effect::depth_of_field
    double focus = 1;           ///< depth of the plane in focus, along the axis
};

/// A camera made ready for images of one size.
class view {
public:
    view(const camera& c, extent size)
        : eye_(c.eye),
          forward_((c.target - c.eye).normalized()),
          right_(forward_.cross(c.up).normalized()),
          down_(forward_.cross(right_)),
          lens_radius_(c.lens_radius),
          focus_(c.focus),
          width_(size.width),
          height_(size.height),
          // At depth 1 a pixel is this wide and high.
          pixel_(2 * std::tan(c.field_of_view * pi / 360) / size.width) {}

    /// Through a point of the image, in pixels from its upper left corner.
    ray through(const vec2& image) const { return from_lens(image, {0, 0}); }
    /// The same from a point of the lens, a unit disc.  All rays of an image point meet in the plane of focus; with a
    /// lens of radius 0 this is `through`, bit by bit.
    ray from_lens(const vec2& image, const vec2& lens) const {
        const vec2 offset = lens_radius_ * lens;
        const double x = (image.x() - width_ / 2) * pixel_ - offset.x() / focus_;
        const double y = (image.y() - height_ / 2) * pixel_ - offset.y() / focus_;
        return {eye_ + offset.x() * right_ + offset.y() * down_, (x * right_ + y * down_ + forward_).normalized()};
    }
    /// Distance along the axis.
    double depth(const vec3& p) const { return (p - eye_).dot(forward_); }
    /// The image point of a point in front of the camera.
    vec2 project(const vec3& p) const {
        const vec3 d = p - eye_;
        const double z = d.dot(forward_);
        return {d.dot(right_) / z / pixel_ + width_ / 2, d.dot(down_) / z / pixel_ + height_ / 2};
    }
    /// The solid angle of a pixel about this direction.
    double solid_angle(const vec3& direction) const {
        const double cosine = direction.dot(forward_);
        return pixel_ * pixel_ * cosine * cosine * cosine;
    }
    const vec3& eye() const { return eye_; }

private:
    vec3 eye_, forward_, right_, down_;
    double lens_radius_, focus_, width_, height_, pixel_;
};

}  // namespace winnow::simulate
