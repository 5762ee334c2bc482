// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The sums of a filter in double, over planes as executors stage them, of which a test may change one value: what
/// derivatives are tested against.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>
#include "support/patterns.hpp"
#include "winnow/estimator/sure.hpp"
#include "winnow/executor/stage.hpp"
#include "winnow/filter/filter.hpp"
#include "winnow/frame/differential.hpp"

namespace winnow::test {

/// A double with its slopes along the channels of one pixel, which remembers how far the pixel has to move, to first
/// order, for the nearest comparison to go the other way.
class watched {
public:
    static inline double nearest = 1e300;
    static inline std::array<const float*, 3> pixel{};  ///< its channels

    explicit watched(float x) : x_(x) {}
    static watched load(const float* from) {
        const auto channel = std::find(pixel.begin(), pixel.end(), from);
        return channel == pixel.end() ? watched(*from)
                                      : watched(number::variable(*from, static_cast<int>(channel - pixel.begin())));
    }

    friend watched operator+(watched a, watched b) { return a.x_ + b.x_; }
    friend watched operator-(watched a, watched b) { return a.x_ - b.x_; }
    friend watched operator-(watched a) { return -a.x_; }
    friend watched operator*(watched a, watched b) { return a.x_ * b.x_; }
    friend watched operator/(watched a, watched b) { return a.x_ / b.x_; }
    friend bool operator<(watched a, watched b) {
        const number apart = a.x_ - b.x_;
        for (int c = 0; c < 3; ++c)
            if (apart.slope(c) != 0) nearest = std::min(nearest, std::abs(apart.value() / apart.slope(c)));
        return a.x_ < b.x_;
    }
    static watched min(watched a, watched b) { return a < b ? a : b; }
    static watched max(watched a, watched b) { return b < a ? a : b; }
    static watched select(bool m, watched a, watched b) { return m ? a : b; }
    static watched sqrt(watched a) { return number::sqrt(a.x_); }
    static watched fma(watched a, watched b, watched c) { return a * b + c; }
    static watched reciprocal(watched a) { return number::reciprocal(a.x_); }
    static watched exp(watched a) { return number::exp(a.x_); }

private:
    using number = differential<double, color_t>;
    watched(number x) : x_(x) {}

    number x_;
};

/// One pixel, by the definition.
struct defined_pixel {
    std::array<double, 3> filtered{}, derivative{};  ///< by channels
    std::array<double, 3> slopes{};                  ///< sum over q of |dw(p,q)|, over the sum of weights
    double own = 0;                                  ///< w(p,p) over the sum of weights
    double support = 0;
    double kink = 0;  ///< see watched: of all pairs with p but its own
};

/// A filter with estimator::sure over one frame; G is what it filters.
template <class Filter, guide G = color_t>
class definition {
    using sweep_type = decltype(std::declval<Filter>().as_sweep());
    using reads = typename sweep_type::reads;
    static constexpr int channels = G::channels;

public:
    template <class Frame>
    definition(const Filter& f, const Frame& in) : sweep_(f.as_sweep()) {
        const output nothing;
        detail::bind_sweep(sweep_, in, std::span(&nothing, 1), buffers_);
        const extent size = buffers_.size;
        const rectangle region = rectangle{0, 0, size.width, size.height}.grown(margin(sweep_, size));
        const std::ptrdiff_t plane = region.size().width;
        memory_.resize(static_cast<std::size_t>(staged_planes<sweep_type>(buffers_) * plane * region.size().height));
        tile_ = {region, memory_.data(), {plane, plane * staged_planes<sweep_type>(buffers_)}};
        stage(sweep_, buffers_, tile_);
    }
    definition(const definition&) = delete;

    extent size() const { return buffers_.size; }

    /// F of all channels at (x, y), with `by` added to channel `changed` of the pixel itself, in what guides and in
    /// what is filtered; not to the copies of it that a border rule has made.
    std::array<double, 3> filtered(int x, int y, int changed = 0, float by = 0) {
        float* const guide = tile_.at(1 + slot_of<G>(reads{}) + changed, x, y);
        float* const value = tile_.at(1 + reads::count + changed, x, y);
        const float before = *guide, before_value = *value;
        *guide += by, *value += by;
        std::array<double, 3> sums{};
        double total = 0;
        for_pairs(x, y, [&](const float* p, const float* q, int dx, int dy) {
            const double w = weight()(pixel_pair<double, reads>(p, q, tile_.step, dx, dy));
            total += w;
            for (int c = 0; c < channels; ++c) sums[c] += w * value_at(c, x + dx, y + dy);
        });
        *guide = before, *value = before_value;
        for (double& s : sums) s /= total;
        return sums;
    }

    /// Everything else about the pixel, with the slopes of the weights.
    defined_pixel at(int x, int y) {
        defined_pixel p;
        p.filtered = filtered(x, y);
        std::array<double, 3> sums{};
        watched::nearest = 1e300;
        for (int c = 0; c < channels; ++c) watched::pixel[c] = tile_.at(1 + slot_of<G>(reads{}) + c, x, y);
        for_pairs(x, y, [&](const float* here, const float* q, int dx, int dy) {
            const auto w = weight()(pixel_pair<differential<double, G>, reads>(here, q, tile_.step, dx, dy));
            p.support += w.value();
            if (dx == 0 && dy == 0) {  // its weight for itself is the same whatever its value
                p.own = w.value();
                return;
            }
            weight()(pixel_pair<watched, reads>(here, q, tile_.step, dx, dy));
            for (int c = 0; c < channels; ++c) {
                sums[c] += w.slope(c) * (value_at(c, x + dx, y + dy) - p.filtered[c]);
                p.slopes[c] += std::abs(w.slope(c));
            }
        });
        for (int c = 0; c < channels; ++c) {
            p.derivative[c] = (p.own + sums[c]) / p.support;
            p.slopes[c] /= p.support;
        }
        p.own /= p.support;
        p.kink = watched::nearest;
        return p;
    }

private:
    const auto& weight() const { return std::get<0>(sweep_.weights); }
    double value_at(int c, int x, int y) const { return double{*tile_.at(1 + reads::count + c, x, y)}; }

    template <class F>
    void for_pairs(int x, int y, const F& f) const {
        for (int dy = -sweep_.window.reach(); dy <= sweep_.window.reach(); ++dy)
            for (int dx = -sweep_.window.half_width(dy); dx <= sweep_.window.half_width(dy); ++dx) {
                if (const int step = winnow::step(sweep_.window); dx % step != 0 || dy % step != 0) continue;
                const rectangle& r = tile_.region;
                if (x + dx < r.x0 || x + dx >= r.x1 || y + dy < r.y0 || y + dy >= r.y1) continue;
                const float* const q = tile_.at(0, x + dx, y + dy);
                if (*q != 0) f(tile_.at(0, x, y), q, dx, dy);
            }
    }

    sweep_type sweep_;
    sweep_buffers buffers_;
    std::vector<float> memory_;
    staged_tile tile_;
};

}  // namespace winnow::test
