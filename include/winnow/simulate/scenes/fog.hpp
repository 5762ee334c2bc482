// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The conference room with fog in it: halos about the lamps, a cone of light under the shade.  The first surface tells
/// little of a sample that the fog has scattered; the transmittance does.
#include <winnow/simulate/scenes/conference.hpp>

namespace winnow::simulate::scenes {

/// The conference in a medium.
struct fog {
    static std::string name() { return "fog"; }
    static std::string summary() { return "the conference room full of fog: halos, a cone of light"; }
    using shows = effects<effect::area_light, effect::global_illumination, effect::medium>;

    template <class Effects = shows>
    static auto make() {
        scene<Effects, quad, frustum, ellipsoid> s;
        conference::furnish(s);
        s.medium = {.extinction = 0.09, .albedo = {0.92, 0.93, 0.95}, .anisotropy = 0.3};
        return s;
    }
};

}  // namespace winnow::simulate::scenes
