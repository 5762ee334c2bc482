// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Which values of several renders of one frame are outliers (fireflies): single bright events that neither the
/// neighbours nor the other renders of the same pixel confirm.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>
#include <winnow/frame/variance.hpp>

namespace winnow {

namespace detail {

/// Calls f(x, y) for the part of the square around a pixel that lies in the image.
template <class F>
void for_square(extent size, int x, int y, int radius, const F& f) {
    for (int j = std::max(0, y - radius); j <= std::min(size.height - 1, y + radius); ++j)
        for (int i = std::max(0, x - radius); i <= std::min(size.width - 1, x + radius); ++i) f(i, j);
}
template <class F>
void for_pixels(extent size, const F& f) {
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) f(x, y);
}

}  // namespace detail

struct outlier_numbers {
    int radius = 2;    ///< of the square that says what is usual, in pixels
    float sigmas = 3;  ///< deviations from the usual that are too many; standard errors that make a pixel trusted
    int reach = 10;    ///< how far events speak for each other, and noise against a bright pixel, in pixels
    float events = 3;  ///< no energy is kept unless more events than this, all equal, are within reach

    void check() const {
        if (radius < 1 || reach < 1 || !(sigmas > 0) || !(events >= 1))
            fail("outliers: radius, reach and events must be at least 1, sigmas above 0");
    }
};

/// One value of one render that is not to be believed.
struct outlier {
    int render, x, y;
    float taken;  ///< brightness less what is usual
    float kept;   ///< the share of it that other outliers within reach confirm, in [0, 1)
};

/// Brightness is the mean over channels.  A value is an outlier if its brightness is above
///     m + sigmas max(s, m / 100),
/// where m and s are the mean and the deviation of all other values of all renders in the square around it, and unless
/// its pixel is trusted: the mean of the renders there is at least `sigmas` times the largest standard error of that
/// mean within reach, its own included.  So what all renders show stays, however small and bright, unless single
/// renders show the like nearby; in a frame without noise there are no outliers.  Of the energies r of outliers within
/// reach, the share  max(0, 1 - events sum r^2 / (sum r)^2)  is confirmed: nothing of a lone one, nearly all where
/// there are many.  A pixel with a value that is no number says nothing in that render.  The renders are of one size.
class outlier_search {
public:
    outlier_search(std::span<const source> renders, const outlier_numbers& n) : renders_(renders), n_(n) {
        const extent size = renders[0].size;
        std::vector<source> planes;
        for (const source& r : renders) {
            image<float>& plane = brightness_.emplace_back(size);
            const float share = 1 / static_cast<float>(r.channels);
            detail::for_pixels(size, [&](int x, int y) {
                for (int c = 0; c < r.channels; ++c) plane.at(x, y) += share * r.channel(c).at(x, y);
            });
        }
        for (const image<float>& plane : brightness_) planes.emplace_back(plane.view());
        image<float> mean(size), squared_error(size);
        mean_and_variance(planes, mean.view(), squared_error.view());
        detail::for_pixels(size, [&](int x, int y) { look_at(x, y, mean, squared_error); });
        confirm();
    }

    const std::vector<outlier>& outliers() const { return outliers_; }
    /// To be written in the place of outlier i: the mean of the other values in the square that are not above its
    /// limit.
    float instead(std::size_t i, int channel) const { return instead_[i * renders_[0].channels + channel]; }
    /// Whether the render has the pixel: all its channels are numbers.
    bool has(int render, int x, int y) const { return is_finite(brightness_[render].at(x, y)); }

private:
    static constexpr int fewest = 8;  ///< values that can say what is usual

    /// f(render, x, y, brightness) for what is known in the square around a pixel.
    template <class F>
    void for_usual(int x, int y, const F& f) const {
        detail::for_square(renders_[0].size, x, y, n_.radius, [&](int i, int j) {
            for (int k = 0; k < static_cast<int>(renders_.size()); ++k)
                if (has(k, i, j)) f(k, i, j, double{brightness_[k].at(i, j)});
        });
    }

    void look_at(int x, int y, const image<float>& mean, const image<float>& squared_error) {
        double sum = 0, squares = 0;
        int others = -1;
        for_usual(x, y, [&](int, int, int, double v) { sum += v, squares += v * v, ++others; });
        for (int k = 0; k < static_cast<int>(renders_.size()); ++k) {
            if (others < fewest || !has(k, x, y)) continue;
            const double v = brightness_[k].at(x, y), usual = (sum - v) / others;
            const double spread = std::sqrt(std::max(0.0, (squares - v * v) / others - usual * usual));
            const double limit = usual + n_.sigmas * std::max(spread, 0.01 * std::abs(usual));
            if (!(v > limit)) continue;
            // Of one render alone nothing is known.
            float noise = squared_error.at(x, y);
            detail::for_square(mean.size(), x, y, n_.reach, [&](int i, int j) {
                if (squared_error.at(i, j) > noise) noise = squared_error.at(i, j);
            });
            if (is_finite(noise) && mean.at(x, y) >= n_.sigmas * std::sqrt(noise)) return;
            replace(k, x, y, limit);
        }
    }

    void replace(int k, int x, int y, double limit) {
        double usual = 0;
        for (int c = 0; c < renders_[0].channels; ++c) {
            double sum = 0;
            int count = 0;
            for_usual(x, y, [&](int r, int i, int j, double v) {
                if (!(v > limit)) sum += renders_[r].channel(c).at(i, j), ++count;
            });
            instead_.push_back(static_cast<float>(sum / count));
            usual += sum / count / renders_[0].channels;
        }
        outliers_.push_back({k, x, y, static_cast<float>(brightness_[k].at(x, y) - usual), 0});
    }

    void confirm() {
        image<float> energy(renders_[0].size), squares(renders_[0].size);
        for (const outlier& o : outliers_) {
            energy.at(o.x, o.y) += o.taken;
            squares.at(o.x, o.y) += o.taken * o.taken;
        }
        for (outlier& o : outliers_) {
            double sum = 0, sum_of_squares = 0;
            detail::for_square(energy.size(), o.x, o.y, n_.reach,
                               [&](int x, int y) { sum += energy.at(x, y), sum_of_squares += squares.at(x, y); });
            o.kept = static_cast<float>(std::max(0.0, 1 - n_.events * sum_of_squares / (sum * sum)));
        }
    }

    std::span<const source> renders_;
    outlier_numbers n_;
    std::vector<image<float>> brightness_;
    std::vector<outlier> outliers_;
    std::vector<float> instead_;  ///< of each outlier, channel by channel
};

}  // namespace winnow
