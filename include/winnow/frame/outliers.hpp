// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Fireflies taken out of a frame before it is filtered.  A filter makes a bright square of a firefly; where there are
/// many of them nearby, though, they are the light itself, seen too seldom, and their energy stays in the image.
#include <cstdint>
#include <string>
#include <winnow/frame/outlier_search.hpp>

namespace winnow {

/// What is told about each pixel; either may be empty.
struct outlier_maps {
    target removed{};  ///< mean of the renders before less mean after, in radiance; negative where energy was put
    target count{};    ///< one channel: how many renders had an outlier here
};

struct outliers_found {
    std::int64_t count = 0;       ///< values, one of each pixel of each render, that were replaced
    std::vector<double> removed;  ///< mean radiance that the image has lost, channel by channel
    std::vector<double> spread;   ///< mean radiance that was taken out and put back nearby
};

/// Writes `renders`, of about as many samples each, without their outliers to `mended`: two halves, several renders, or
/// all samples (`samples::view`).  `mended` may be `renders` themselves, and must not overlap them otherwise.
///
/// What is an outlier, what is written instead, and how much of it is confirmed by others: see outlier_search.  The
/// confirmed share is put back, evenly over the square of 3x3 around each, into the render that had it.
///
/// Variances are to be taken from what was mended.  A mean that lies beside the renders becomes consistent with them
/// when `maps.removed` is subtracted; filtered as a further layer and added to the result, that map gives all energy
/// back.  Values that are no numbers are passed through.  Throws invalid_input before any work if sizes differ.
inline outliers_found suppress_outliers(std::span<const source> renders, std::span<const target> mended,
                                        const outlier_maps& maps = {}, const outlier_numbers& n = {}) {
    if (renders.size() < 2) fail("outliers: there is no other render to compare with");
    if (mended.size() != renders.size())
        fail("outliers: there are " + std::to_string(renders.size()) + " renders, but " +
             std::to_string(mended.size()) + " to write");
    for (const source& r : renders) detail::check_same("a render", r, renders[0]);
    for (const target& t : mended) detail::check_same("a mended render", source(t), renders[0]);
    if (maps.removed) detail::check_same("the map of what is removed", source(maps.removed), renders[0]);
    if (maps.count) detail::check_same("the map of outliers", source(maps.count), renders[0].channel(0));
    n.check();

    const extent size = renders[0].size;
    const double pixels = static_cast<double>(size.pixels());
    const outlier_search search(renders, n);
    outliers_found found;
    found.count = static_cast<std::int64_t>(search.outliers().size());
    image<float> before(size), after(size);
    for (int c = 0; c < renders[0].channels; ++c) {
        std::vector<source> from, written;
        for (std::size_t k = 0; k < renders.size(); ++k) {
            from.push_back(renders[k].channel(c));
            written.push_back(source(mended[k]).channel(c));
        }
        mean_and_variance(from, before.view(), {});
        for (std::size_t k = 0; k < renders.size(); ++k)
            detail::for_pixels(size, [&](int x, int y) { mended[k].channel(c).set(x, y, from[k].at(x, y)); });

        // What is put back may fall on other outliers, so all are replaced first.
        std::vector<double> back;
        double spread = 0;
        for (std::size_t i = 0; const outlier& o : search.outliers()) {
            const target to = mended[o.render].channel(c);
            const float instead = search.instead(i++, c);
            spread += back.emplace_back(double{o.kept} * (to.at(o.x, o.y) - instead));
            to.set(o.x, o.y, instead);
        }
        for (std::size_t i = 0; const outlier& o : search.outliers()) {
            const target to = mended[o.render].channel(c);
            int count = 0;
            detail::for_square(size, o.x, o.y, 1, [&](int x, int y) { count += search.has(o.render, x, y); });
            detail::for_square(size, o.x, o.y, 1, [&](int x, int y) {
                if (search.has(o.render, x, y)) to.set(x, y, static_cast<float>(to.at(x, y) + back[i] / count));
            });
            ++i;
        }

        mean_and_variance(written, after.view(), {});
        double removed = 0;
        detail::for_pixels(size, [&](int x, int y) {
            const float less = before.at(x, y) - after.at(x, y);
            if (is_finite(less)) removed += less;
            if (maps.removed) maps.removed.channel(c).set(x, y, is_finite(less) ? less : 0);
        });
        found.removed.push_back(removed / pixels);
        found.spread.push_back(spread / pixels / static_cast<double>(renders.size()));
    }
    if (maps.count) {
        detail::for_pixels(size, [&](int x, int y) { maps.count.set(x, y, 0); });
        for (const outlier& o : search.outliers()) maps.count.set(o.x, o.y, maps.count.at(o.x, o.y) + 1);
    }
    return found;
}

/// The same of two halves.
inline outliers_found suppress_outliers(const source& a, const source& b, const target& mended_a,
                                        const target& mended_b, const outlier_maps& maps = {},
                                        const outlier_numbers& n = {}) {
    const source renders[] = {a, b};
    const target mended[] = {mended_a, mended_b};
    return suppress_outliers(renders, mended, maps, n);
}

}  // namespace winnow
