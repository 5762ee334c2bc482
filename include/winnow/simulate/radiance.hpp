// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The radiance of a sample, and the parts of it by the way that the light took.
#include <array>
#include <winnow/frame/path_guides.hpp>
#include <winnow/frame/sample.hpp>
#include <winnow/simulate/vector.hpp>

namespace winnow::simulate {

/// By the lobe of the first surface; direct is what reaches that surface from a light in one step.  Emission is what
/// does not come by a surface: lamps and sky that are seen, and what the medium scatters in front of the first surface.
enum class way { emission, direct_diffuse, direct_specular, indirect_diffuse, indirect_specular };

/// The sum; the parts only where a plane for one of them is asked for.
template <class Planes>
class radiance {
public:
    void add(way by, const rgb& value) {
        sum_ += value;
        if constexpr (split) parts_[static_cast<std::size_t>(by)] += value;
    }
    void record(sample<Planes>& s) const {
        s.set(color = sum_);
        if constexpr (split) {
            s.set(emission = parts_[0]);
            s.set(direct_diffuse = parts_[1]);
            s.set(direct_specular = parts_[2]);
            s.set(indirect_diffuse = parts_[3]);
            s.set(indirect_specular = parts_[4]);
        }
    }

private:
    static constexpr bool split = contains<emission_t, Planes> || contains<direct_diffuse_t, Planes> ||
                                  contains<direct_specular_t, Planes> || contains<indirect_diffuse_t, Planes> ||
                                  contains<indirect_specular_t, Planes>;
    static auto no_parts() {
        std::array<rgb, split ? 5 : 0> all;
        all.fill(grey(0));
        return all;
    }

    rgb sum_ = grey(0);
    std::array<rgb, split ? 5 : 0> parts_ = no_parts();
};

}  // namespace winnow::simulate
