// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Behind any filter: back toward its input where the halves show that it did harm.
/// Stein, "Estimation of the Mean of a Multivariate Normal Distribution", 1981 (the risk that is minimised);
/// the blend of a filter and its input is the simplest of its uses.
#include <algorithm>
#include <cmath>
#include <winnow/frame/variance.hpp>

namespace winnow {

/// A colour with its half buffers: mean = (half_a + half_b) / 2, about.
struct with_halves {
    source mean, half_a, half_b;
};

struct do_no_harm_numbers {
    int radius = 3;      ///< of the square that is looked at for local harm, in pixels
    int wide = 10;       ///< of the square for harm that is small everywhere, in pixels
    float sigmas = 2.5;  ///< harm of so many standard errors begins to count, one more counts in full
};

namespace detail {

/// Sums over channels at each pixel, of input u with halves a, b and filtered f with halves f_a, f_b:
///     change = (f - u)^2,   noise = (a - b)^2 / 4,   gain = noise - (f_a - f_b) (a - b) / 4.
struct harm_terms {
    image<float> change, noise, gain;

    harm_terms(const with_halves& in, const with_halves& filtered)
        : change(in.mean.size), noise(in.mean.size), gain(in.mean.size) {
        for (int y = 0; y < in.mean.size.height; ++y)
            for (int x = 0; x < in.mean.size.width; ++x)
                for (int c = 0; c < in.mean.channels; ++c) {
                    const auto at = [&](const source& s) { return s.channel(c).at(x, y); };
                    const float moved = at(filtered.mean) - at(in.mean);
                    const float difference = at(in.half_a) - at(in.half_b);
                    const float left = at(filtered.half_a) - at(filtered.half_b);
                    change.at(x, y) += moved * moved;
                    noise.at(x, y) += difference * difference / 4;
                    gain.at(x, y) += (difference - left) * difference / 4;
                }
    }

    /// Lowers lambda to what the squares of this radius ask for.
    void lower(image<float>& lambda, int radius, float sigmas) const {
        const extent size = lambda.size();
        std::vector<float> rows;
        const auto mean = [&](const auto& value) {
            image<float> result(size);
            box_mean(value, result.view(), radius, rows);
            return result;
        };
        // Only pixels that all terms know.
        const auto known = [&](int x, int y, float v) {
            return is_finite(change.at(x, y) + noise.at(x, y) + gain.at(x, y)) ? v : unknown;
        };
        const image<float> e = mean([&](int x, int y) { return known(x, y, change.at(x, y)); });
        const image<float> n = mean([&](int x, int y) { return known(x, y, noise.at(x, y)); });
        const image<float> g = mean([&](int x, int y) { return known(x, y, gain.at(x, y)); });
        const image<float> nn = mean([&](int x, int y) { return known(x, y, noise.at(x, y) * noise.at(x, y)); });
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const double moved = e.at(x, y), better = g.at(x, y), harm = moved - 2 * better;
                if (!(moved > 0 && harm > 0)) continue;
                const double wide = std::min(size.width - 1, x + radius) - std::max(0, x - radius) + 1;
                const double high = std::min(size.height - 1, y + radius) - std::max(0, y - radius) + 1;
                const double error = std::sqrt((4 * moved * n.at(x, y) + 6.0 * nn.at(x, y)) / (wide * high));
                const double sure = std::clamp((harm - sigmas * error) / error, 0.0, 1.0);
                const double best = std::clamp(better / moved, 0.0, 1.0);
                const double here = error > 0 ? 1 - sure * (1 - best) : best;
                lambda.at(x, y) = std::min(lambda.at(x, y), static_cast<float>(here));
            }
    }
};

inline void check_with_halves(const char* what, const with_halves& layers, const source& as) {
    const std::string name = what;
    check_same((name + " mean").c_str(), layers.mean, as);
    check_same((name + " first half").c_str(), layers.half_a, as);
    check_same((name + " second half").c_str(), layers.half_b, as);
}

}  // namespace detail

/// How much of a filter's change to keep:  u + lambda (f - u),  lambda in [0, 1], one channel.  The halves are filtered
/// with the weights of the mean.  With Var = (a - b)^2 / 4 and Cov(f, u) = (f_a - f_b) (a - b) / 4, all averaged over
/// channels and a square around the pixel, the squared error is estimated to have changed by
///     harm = (f - u)^2 - 2 (Var - Cov),    least at  lambda = (Var - Cov) / (f - u)^2,  cut to [0, 1].
/// That estimate is noisier than what it estimates, so lambda is 1 unless harm is beyond `sigmas` of its own standard
/// error,  sqrt((4 (f - u)^2 Var + 6 Var^2) / pixels).  The smaller lambda of a narrow and of a wide square counts: the
/// one sees what a filter did to a detail, the other what it does a little everywhere.
///
/// It sees noise that the halves show.  Fireflies are to be suppressed before: within a square around one nothing is
/// certain, so that nothing is done.  Pixels where something is no number are left out; where nothing is known lambda
/// is 1.  Throws invalid_input before any work if sizes or channels differ.
inline void do_no_harm(const with_halves& in, const with_halves& filtered, const target& lambda,
                       const do_no_harm_numbers& n = {}) {
    detail::check_with_halves("the input's", in, in.mean);
    detail::check_with_halves("the filtered", filtered, in.mean);
    if (in.mean.channels > 0) detail::check_same("lambda", source(lambda), in.mean.channel(0));
    if (n.radius < 0 || n.wide < 0 || !(n.sigmas >= 0)) fail("do_no_harm: a number is negative");

    const detail::harm_terms terms(in, filtered);
    image<float> least(in.mean.size);
    const auto for_pixels = [&](const auto& f) {
        for (int y = 0; y < in.mean.size.height; ++y)
            for (int x = 0; x < in.mean.size.width; ++x) f(x, y);
    };
    for_pixels([&](int x, int y) { least.at(x, y) = 1; });
    terms.lower(least, n.radius, n.sigmas);
    terms.lower(least, n.wide, n.sigmas);
    for_pixels([&](int x, int y) { lambda.set(x, y, least.at(x, y)); });
}

/// Blends a layer and what a filter made of it:  to = u + lambda (f - u),  for the colour, its halves and any other:
/// layers that add up still do afterwards.  `to` may be `filtered` itself.  It is finite everywhere: a u that is no
/// number is the mean of its neighbours, and stands for an f that is none.
inline void blend(const source& u, const source& filtered, const source& lambda, const target& to) {
    detail::check_same("the filtered layer", filtered, u);
    detail::check_same("the blended layer", source(to), u);
    if (u.channels > 0) detail::check_same("lambda", lambda, u.channel(0));
    for (int c = 0; c < u.channels; ++c)
        for (int y = 0; y < u.size.height; ++y)
            for (int x = 0; x < u.size.width; ++x) {
                const float from = contained(u.channel(c), x, y), f = filtered.channel(c).at(x, y);
                const float share = lambda.at(x, y);
                to.channel(c).set(x, y, !is_finite(f) ? from : share == 1 ? f : from + share * (f - from));
            }
}

}  // namespace winnow
