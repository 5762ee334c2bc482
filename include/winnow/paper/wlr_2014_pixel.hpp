// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// WLR at one pixel, or at a batch of pixels side by side: coordinates, their bandwidths, trials, and the final fit.
/// Moon, Carr, Yoon, "Adaptive Rendering based on Weighted Local Regression", 2014.
#include <winnow/filter/regression.hpp>
#include <winnow/paper/wlr_2014_window.hpp>

namespace winnow::paper {

/// What the final fit needs to know of a pixel besides its window.
template <class Real, int N>
struct wlr_model {
    wlr_subspace<Real, N> subspace;
    Real narrowness[N];    ///< 1 / b^2 of each coordinate's bandwidth b
    Real squared_bias[3];  ///< see wlr_choice
};

/// Works on one batch of pixels at a time; `Planes` are those that are staged.
template <class Real, class Features, class Planes>
class wlr_pixel {
public:
    using window = wlr_window<Real, Features, Planes>;
    static constexpr int count = window::count;
    using model = wlr_model<Real, count>;

    /// Memory for a window, and for two numbers of each neighbour.
    static std::size_t reals(int neighbours) {
        return window::reals(neighbours) + 2 * static_cast<std::size_t>(neighbours);
    }

    /// See wlr_window.
    wlr_pixel(const wlr_numbers& numbers, const wlr_neighbour* neighbours, int real, int padded, pitch step,
              Real* memory)
        : n_(numbers),
          window_(numbers, neighbours, real, padded, step, memory),
          row_(memory + window::reals(padded)),
          slope_(row_ + padded) {}

    /// The bandwidth of each pixel of the batch, and what the final fit needs beside it.
    void choose(const float* p, const wlr_selection& selection, model& m, float* bandwidth) {
        m.subspace = wlr_subspace<Real, count>(window_.moments(p), n_.least_component);
        window_.gather(p, m.subspace);
        float ranks[lanes], filtered[wlr_trials][3][lanes], variance[wlr_trials][lanes], bias_variance[3][lanes];
        batch_of<Real>::store(m.subspace.rank, ranks);
        with_rank(m.subspace, [&]<int D>(math::index<D>) {
            feature_bandwidths<D>(p, m);
            try_bandwidths<D>(p, m, selection, filtered, variance);
        });
        for (int c = 0; c < 3; ++c) {
            Real noise(0.0f);
            for (int i = 0; i < window_.neighbours(); ++i)
                noise = math::fma(slope_[i] * slope_[i], window_.at(p, i).q(variance_of<color_t>{}, c), noise);
            batch_of<Real>::store(noise, bias_variance[c]);
        }
        float squared_bias[3][lanes];
        for (int i = 0; i < lanes; ++i) {
            wlr_trial_results trials;
            for (std::size_t t = 0; t < wlr_trials; ++t) {
                for (std::size_t c = 0; c < 3; ++c) trials.filtered[t][c] = filtered[t][c][i];
                trials.variance[t] = variance[t][i];
            }
            for (std::size_t c = 0; c < 3; ++c) trials.bias_variance[c] = bias_variance[c][i];
            const wlr_choice choice = selection(trials, static_cast<int>(ranks[i]));
            bandwidth[i] = choice.bandwidth;
            for (std::size_t c = 0; c < 3; ++c) squared_bias[c][i] = choice.squared_bias[c];
        }
        for (int c = 0; c < 3; ++c) m.squared_bias[c] = batch_of<Real>::load(squared_bias[c]);
    }

    /// The smoother's row at the given bandwidths; it adds up to 1.  Where the filtered colour would be negative, the
    /// row is that of its positive elements alone.
    void fit(const float* p, const model& m, const Real& bandwidth) {
        window_.gather(p, m.subspace);
        with_rank(m.subspace, [&]<int D>(math::index<D>) {
            Real narrow[D];
            for (int k = 0; k < D; ++k) narrow[k] = m.narrowness[k] / (bandwidth * bandwidth);
            const auto weights = [&](int i, Real(&w)[group]) WINNOW_HD_LAMBDA {
                for (int n = 0; n < group; ++n) w[n] = window_.template weight<D>(i + n, narrow);
            };
            const local_fit<Real, D + 1> solved = linear_fit<D>(weights);
            for (int i = 0; i < window_.padded(); i += group) {
                Real w[group];
                weights(i, w);
                for (int n = 0; n < group; ++n) row_[i + n] = w[n] * solved.share(window_.x(i + n));
            }
        });
        const Real zero(0.0f);
        Real least = sum_of_row() - Real(0.5f);  // the sum is 1, but for rounding
        for (int c = 0; c < 3; ++c) least = math::min(least, apply(p, window_.plane_of(color, c), false));
        if (batch_of<Real>::largest(-least) > 0)
            for (int i = 0; i < window_.padded(); ++i)
                row_[i] = math::select(least < zero, math::max(row_[i], zero), row_[i]);
        normalise();
    }

    /// sum_q row(q) u(q), or sum_q row(q)^2 u(q), for a plane u; after fit().
    Real apply(const float* p, std::ptrdiff_t plane, bool squared) const {
        Real sum(0.0f);
        for (int i = 0; i < window_.neighbours(); ++i) {
            const Real l = row_[i];
            sum = math::fma(squared ? l * l : l, window_.load(p, i, plane), sum);
        }
        return sum;
    }
    /// How many neighbours of one weight would average as much noise away.
    Real support() const {
        Real sum(0.0f);
        for (int i = 0; i < window_.neighbours(); ++i) sum = math::fma(row_[i], row_[i], sum);
        return Real(1.0f) / math::max(sum, Real(1e-30f));
    }

    const window& of() const { return window_; }

private:
    static constexpr int lanes = batch_of<Real>::size;
    static constexpr int group = window::group;
    using pair = typename window::pair;

    /// f(index<D>) with a D that is at least the rank of every pixel of the batch.
    template <class F>
    static void with_rank(const wlr_subspace<Real, count>& s, const F& f) {
        const float rank = batch_of<Real>::largest(s.rank);
        if constexpr (lanes > 1 && count > 3) {
            if (rank <= 3) return f(math::index<3>{});
            if constexpr (count > 5)
                if (rank <= 5) return f(math::index<5>{});
            if constexpr (count > 7)
                if (rank <= 7) return f(math::index<7>{});
        }
        f(math::index<count>{});
    }

    template <int D, class Weights>
    local_fit<Real, D + 1> linear_fit(const Weights& weights) const {
        normal_equations<Real, D + 1> a;
        for (int i = 0; i < window_.padded(); i += group) {
            Real w[group];
            weights(i, w);
            a.add(w, window_.x(i), count + 1);
        }
        return {a, n_.ridge};
    }

    /// b = (|u''| + flatness)^(-1/2) from a quadratic fit of the grey value, without mixed terms, of bandwidth 1.
    template <int D>
    void feature_bandwidths(const float* p, model& m) const {
        constexpr int unknowns = 2 * D + 1;
        const Real grey = window::mean_of(color, window_.self(p));
        Real unit[D], moments[unknowns];
        for (Real& u : unit) u = Real(1.0f);
        for (Real& b : moments) b = Real(0.0f);
        normal_equations<Real, unknowns> a;
        for (int i = 0; i < window_.padded(); i += group) {
            Real w[group], terms[group * unknowns];
            for (int n = 0; n < group; ++n) {
                const Real* const y = window_.x(i + n);
                Real* const to = terms + n * unknowns;
                w[n] = window_.template weight<D>(i + n, unit);
                const Real wu = w[n] * window::mean_of(color, window_.at(p, i + n), -grey);
                for (int k = 0; k <= D; ++k) to[k] = y[k];
                for (int k = 1; k <= D; ++k) to[D + k] = y[k] * y[k];
                for (int k = 0; k < unknowns; ++k) moments[k] = math::fma(wu, to[k], moments[k]);
            }
            a.add(w, terms, unknowns);
        }
        local_fit<Real, unknowns>(a, n_.curvature_ridge).solve(moments);
        for (int k = 0; k < D; ++k) {
            const Real second = Real(2 / n_.unit) * moments[1 + D + k];
            m.narrowness[k] = math::max(second, -second) + Real(n_.flatness);
        }
        for (int k = D; k < count; ++k) m.narrowness[k] = Real(n_.flatness);
    }

    template <int D>
    void try_bandwidths(const float* p, const model& m, const wlr_selection& selection,
                        float (&filtered)[wlr_trials][3][lanes], float (&variances)[wlr_trials][lanes]) {
        for (int t = 0; t < wlr_trials; ++t) {
            const float h = wlr_shares[static_cast<std::size_t>(t)] * n_.largest_bandwidth;
            Real narrow[D];
            for (int k = 0; k < D; ++k) narrow[k] = m.narrowness[k] * Real(1 / (h * h));
            const local_fit<Real, D + 1> solved = linear_fit<D>([&](int i, Real(&w)[group]) WINNOW_HD_LAMBDA {
                for (int n = 0; n < group; ++n) row_[i + n] = w[n] = window_.template weight<D>(i + n, narrow);
            });
            const Real share(selection.bias_share(t));
            Real total(0.0f), sum[3] = {total, total, total}, noise = total;
            for (int i = 0; i < window_.neighbours(); ++i) {
                const pair pq = window_.at(p, i);
                const Real l = row_[i] * solved.share(window_.x(i));
                total = total + l;
                for (int c = 0; c < 3; ++c) sum[c] = math::fma(l, pq.q(color, c), sum[c]);
                noise = math::fma(l * l, window::mean_of(variance(color), pq), noise);
                slope_[i] = math::fma(share, l, t == 0 ? Real(0.0f) : slope_[i]);
            }
            // The row adds up to 1, but for rounding.
            const Real by = inverse_of(total);
            for (int c = 0; c < 3; ++c) batch_of<Real>::store(sum[c] * by, filtered[t][c]);
            batch_of<Real>::store(noise * by * by * Real(3.0f), variances[t]);
        }
    }

    static Real inverse_of(const Real& total) {
        return math::select(Real(1e-30f) < total, Real(1.0f) / math::max(total, Real(1e-30f)), Real(0.0f));
    }

    Real sum_of_row() const {
        Real sum(0.0f);
        for (int i = 0; i < window_.neighbours(); ++i) sum = sum + row_[i];
        return sum;
    }
    /// Makes the row add up to 1.  One without positive elements becomes the pixel itself.
    void normalise() {
        const Real sum = sum_of_row(), by = inverse_of(sum);
        for (int i = 0; i < window_.padded(); ++i) row_[i] = row_[i] * by;
        Real& own = row_[window_.neighbours() / 2];
        own = math::select(Real(1e-30f) < sum, own, Real(1.0f));
    }

    const wlr_numbers& n_;
    window window_;
    Real* row_;    // its element in the row of the smoother
    Real* slope_;  // and in that of the bias, b_1
};

}  // namespace winnow::paper
