// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Guides that only a path tracer can give: what happened along the path of a sample, and the random numbers behind it.
#include <winnow/frame/guide.hpp>

namespace winnow {

// The first hit.
WINNOW_GUIDE(rest_position, 3);  ///< where the hit point is when its object has not moved: s = M^-1 s'
WINNOW_GUIDE(view_depth, 1);     ///< distance along the camera's axis
WINNOW_GUIDE(emission,
             3);  ///< radiance that comes by no surface: lamps and sky that are seen, light scattered by a medium
WINNOW_GUIDE(caustic, 1);           ///< density of caustic photons, per unit of area and photon emitted
WINNOW_GUIDE(brdf, 3);              ///< f cos / pdf of the direction that was sampled
WINNOW_GUIDE(f0, 3);                ///< reflectance of the specular lobe at normal incidence
WINNOW_GUIDE(cosine, 1);            ///< between the normal and the direction to the camera
WINNOW_GUIDE(specular_share, 1);    ///< probability of the specular lobe, mirrors included
WINNOW_GUIDE(transmittance, 1);     ///< of the medium between camera and first surface
WINNOW_GUIDE(scatter_distance, 1);  ///< from the camera to the first scattering, or to the surface
WINNOW_GUIDE(motion_vector, 2);     ///< in pixels, from here to where the point was in the previous frame
WINNOW_GUIDE(instance, 1);          ///< number of the object; 0 is what was not hit
WINNOW_GUIDE(sample_count, 1);      ///< of the samples in the pixel, where it varies

// The second hit: of the direction that was sampled at the first.
WINNOW_GUIDE(position2, 3);
WINNOW_GUIDE(normal2, 3);
WINNOW_GUIDE(albedo2, 3);
WINNOW_GUIDE(hit_distance, 1);  ///< from the first to the second

// Radiance by the lobe of the first hit; with the emission they add up to the colour.
WINNOW_GUIDE(direct_diffuse, 3);
WINNOW_GUIDE(direct_specular, 3);
WINNOW_GUIDE(indirect_diffuse, 3);
WINNOW_GUIDE(indirect_specular, 3);

// Random parameters; in [0,1), as they were drawn, but for the first.
WINNOW_GUIDE(image_point, 2);   ///< where in the image, in pixels
WINNOW_GUIDE(lens_point, 2);    ///< where on the lens
WINNOW_GUIDE(shutter_time, 1);  ///< when in the shutter
WINNOW_GUIDE(light_point, 2);   ///< where on a light, seen from the first hit
WINNOW_GUIDE(light_point2, 2);  ///< and from the second

template <>
inline constexpr bool is_point<rest_position_t> = true;
template <>
inline constexpr bool is_point<position2_t> = true;

}  // namespace winnow
