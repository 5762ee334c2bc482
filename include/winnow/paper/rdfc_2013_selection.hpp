// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Which candidate counts where: RDFC's selection by Stein's estimate, and the convex combination that the same
/// estimate says is best.  A selection gathers statistics at each pixel, has them smoothed, and decides on the
/// candidates' shares.
#include <algorithm>
#include <array>
#include <winnow/estimator/sure.hpp>

namespace winnow::paper {

/// One pixel of the input and of three candidates FIRST, SECOND, THIRD, from the most to the least sensitive to noise.
struct rdfc_candidates_pixel {
    std::array<float, 3> input, variance;                      ///< by channel
    std::array<std::array<float, 3>, 3> filtered, derivative;  ///< by candidate and channel

    /// Stein's estimate of the squared error of a candidate, mean over channels.
    float error(int candidate) const {
        float sum = 0;
        for (int c = 0; c < 3; ++c)
            sum += estimator::sure<>{}({.input = input[c],
                                        .filtered = filtered[candidate][c],
                                        .variance = variance[c],
                                        .derivative = derivative[candidate][c]});
        return sum / 3;
    }
    float mean_derivative(int candidate) const {
        const auto& d = derivative[candidate];
        return (d[0] + d[1] + d[2]) / 3;
    }
};

/// Algorithm 1, lines 15 to 25: in each pixel the candidate with the smallest error, then a smoothed map of that. FIRST
/// is trusted only where it filters more than SECOND; if it is not, or at a tie, the more robust of the others is
/// taken.
struct binary_maps {
    static constexpr int statistics = 3;  ///< the error of each candidate
    int error_radius = 1;                 ///< of the window over which errors are smoothed, in pixels
    int map_radius = 5;                   ///< of the window over which the maps are; 0 leaves them as they are

    static std::array<float, statistics> gather(const rdfc_candidates_pixel& pixel) {
        return {pixel.error(0), pixel.error(1), pixel.error(2)};
    }
    static std::array<float, 3> decide(const std::array<float, statistics>& error, const rdfc_candidates_pixel& pixel) {
        const int robust = error[1] < error[2] ? 1 : 2;
        const bool first = error[0] < error[robust] && pixel.mean_derivative(0) < pixel.mean_derivative(1);
        std::array<float, 3> map{};
        map[first ? 0 : robust] = 1;
        return map;
    }
    static float error(const std::array<float, statistics>& error, const std::array<float, 3>& share) {
        return share[0] * error[0] + share[1] * error[1] + share[2] * error[2];
    }
    bool operator==(const binary_maps&) const = default;
};

/// The convex combination of the candidates with the smallest estimated error.  For shares s that add up to one, the
/// estimate is quadratic:  sum_ij s_i s_j G_ij + 2 sum_i s_i v_i - Var,  with G_ij = (F_i - u)(F_j - u) and
/// v_i = Var dF_i/du, sums over channels, averaged over the window.
struct convex_blend {
    static constexpr int statistics = 10;  ///< G_00 G_01 G_02 G_11 G_12 G_22, v_0 v_1 v_2, Var
    int error_radius = 5;                  ///< of the window over which statistics are averaged, in pixels
    int map_radius = 0;                    ///< as above

    static std::array<float, statistics> gather(const rdfc_candidates_pixel& pixel) {
        std::array<float, statistics> s{};
        for (int c = 0; c < 3; ++c) {
            int at = 0;
            for (int i = 0; i < 3; ++i)
                for (int j = i; j < 3; ++j)
                    s[at++] += (pixel.filtered[i][c] - pixel.input[c]) * (pixel.filtered[j][c] - pixel.input[c]) / 3;
            for (int i = 0; i < 3; ++i) s[at++] += pixel.variance[c] * pixel.derivative[i][c] / 3;
            s[at] += pixel.variance[c] / 3;
        }
        return s;
    }
    /// The best of the corners, the edges and the inside of the simplex, in this order at a tie, the robust corner
    /// first.
    static std::array<float, 3> decide(const std::array<float, statistics>& s, const rdfc_candidates_pixel&) {
        std::array<float, 3> best{0, 0, 1};
        float least = error(s, best);
        const auto consider = [&](const std::array<float, 3>& share) {
            if (!(std::min({share[0], share[1], share[2]}) >= 0)) return;
            if (const float e = error(s, share); e < least) best = share, least = e;
        };
        consider({0, 1, 0});
        consider({1, 0, 0});
        // Along an edge:  t = (G_jj - G_ij + v_j - v_i) / (G_ii - 2 G_ij + G_jj), the share of i.
        for (int i = 0; i < 3; ++i)
            for (int j = i + 1; j < 3; ++j) {
                const float curvature = g(s, i, i) - 2 * g(s, i, j) + g(s, j, j);
                if (!(curvature > 0)) continue;
                const float t = (g(s, j, j) - g(s, i, j) + s[6 + j] - s[6 + i]) / curvature;
                std::array<float, 3> share{};
                share[i] = t;
                share[j] = 1 - t;
                consider(share);
            }
        // Inside: with the share of THIRD eliminated, two equations.
        const auto h = [&](int i, int j) { return g(s, i, j) - g(s, i, 2) - g(s, j, 2) + g(s, 2, 2); };
        const auto slope = [&](int i) { return g(s, 2, 2) - g(s, i, 2) + s[8] - s[6 + i]; };
        const float determinant = h(0, 0) * h(1, 1) - h(0, 1) * h(0, 1);
        if (determinant > 1e-6f * h(0, 0) * h(1, 1)) {
            const float x = (slope(0) * h(1, 1) - slope(1) * h(0, 1)) / determinant;
            const float y = (slope(1) * h(0, 0) - slope(0) * h(0, 1)) / determinant;
            consider({x, y, 1 - x - y});
        }
        return best;
    }
    static float error(const std::array<float, statistics>& s, const std::array<float, 3>& share) {
        float sum = -s[9];
        for (int i = 0; i < 3; ++i) {
            sum += 2 * share[i] * s[6 + i];
            for (int j = 0; j < 3; ++j) sum += share[i] * share[j] * g(s, i, j);
        }
        return sum;
    }
    bool operator==(const convex_blend&) const = default;

private:
    static float g(const std::array<float, statistics>& s, int i, int j) {
        const int a = std::min(i, j), b = std::max(i, j);
        return s[a == 0 ? b : a + b + 1];
    }
};

}  // namespace winnow::paper
