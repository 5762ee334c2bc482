// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The waist of the library: all that a policy ever sees is a pair of pixels.
#include <cstddef>
#include <type_traits>
#include <winnow/core/platform.hpp>
#include <winnow/frame/planes.hpp>

namespace winnow {

/// Where an executor keeps its planes: float values, `plane` floats from one plane to the next, `row` from one row to
/// the next.  Plane 0 is the coverage: 1 where there is a pixel, 0 where there is none.
struct pitch {
    std::ptrdiff_t plane = 0;
    std::ptrdiff_t row = 0;
};

/// What an executor has worked out ahead for one offset: values of this pair, `plane` floats apart (see `patch`), and
/// values that are the same for all pairs.
struct prepared {
    const float* data = nullptr;
    std::ptrdiff_t plane = 0;
    const float* of_offset = nullptr;
};

/// A pixel p and its neighbour q = p + offset, with the buffers in the list Planes.  Real is float, double or a batch
/// of SIMD lanes: then p stands for as many pixels side by side as there are lanes.
template <class Real, class Planes>
class pixel_pair {
public:
    using real = Real;

    WINNOW_HD pixel_pair(const float* p, const float* q, pitch step, int dx, int dy, prepared ahead = {})
        : p_(p), q_(q), step_(step), dx_(dx), dy_(dy), ahead_(ahead) {}

    /// Channel c of buffer G at p, and at q.
    template <class G>
    WINNOW_HD Real p(G, int c = 0) const {
        return load(p_ + (plane<G> + c) * step_.plane);
    }
    template <class G>
    WINNOW_HD Real q(G, int c = 0) const {
        return load(q_ + (plane<G> + c) * step_.plane);
    }

    /// The offset q - p, in pixels.
    WINNOW_HD Real dx() const { return Real(static_cast<float>(dx_)); }
    WINNOW_HD Real dy() const { return Real(static_cast<float>(dy_)); }

    /// The pair (p + n, q + n) for n = (x, y): the same offset, elsewhere.
    WINNOW_HD pixel_pair shifted(int x, int y) const {
        const std::ptrdiff_t by = x + y * step_.row;
        return {p_ + by, q_ + by, step_, dx_, dy_};
    }

    /// 1 where both pixels exist, else 0.
    WINNOW_HD Real covered() const { return load(p_) * load(q_); }

    /// The distance that the executor worked out ahead and put into place `index`.
    WINNOW_HD Real ahead(int index) const { return load(ahead_.data + index * ahead_.plane); }
    /// The same where it depends on the offset alone.
    WINNOW_HD Real of_offset(int index) const { return Real(ahead_.of_offset[index]); }

private:
    template <class G>
    static constexpr std::ptrdiff_t first_plane() {
        static_assert(contains<G, Planes>,
                      "a policy must name every buffer that it looks at in `using reads = planes<...>`");
        return 1 + slot_of<G>(Planes{});
    }
    // A constant, so that device code does not call what the host computes.
    template <class G>
    static constexpr std::ptrdiff_t plane = first_plane<G>();

    WINNOW_HD static Real load(const float* from) {
        if constexpr (std::is_floating_point_v<Real>) return Real(*from);
        else return Real::load(from);
    }

    const float* p_;
    const float* q_;
    pitch step_;
    int dx_, dy_;
    prepared ahead_;
};

}  // namespace winnow
