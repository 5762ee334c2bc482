// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <random>
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <support/patterns.hpp>
#include <support/statistics.hpp>
#include <winnow/distance/mahalanobis.hpp>
#include <winnow/estimator/mahalanobis_sure.hpp>
#include <winnow/estimator/sure.hpp>
#include <winnow/executor/simd.hpp>
#include <winnow/filter/candidates.hpp>
#include <winnow/weight/gaussian.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

using isotropic = estimator::mahalanobis_sure<position_t>;
using anisotropic = estimator::mahalanobis_sure<position_t, estimator::noise::anisotropic>;
static_assert(estimator_policy<isotropic> && summing_estimator<anisotropic>);
static_assert(!summing_estimator<estimator::sure<>>);

using vector = std::array<double, 3>;
using matrix = std::array<double, 6>;

double element(const matrix& m, int i, int j) { return m[static_cast<std::size_t>(upper_triangle<3>(i, j))]; }
vector times(const matrix& m, const vector& v) {
    vector r{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r[i] += element(m, i, j) * v[j];
    return r;
}
double dot(const vector& a, const vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Random numbers for one window of pixels, in double.
struct window_of_positions {
    std::mt19937_64 random;
    std::normal_distribution<double> normal{};
    vector centre{};
    matrix centre_precision{};
    std::vector<vector> others;
    std::vector<matrix> precisions;

    explicit window_of_positions(unsigned seed) : random(seed) {
        centre = point();
        centre_precision = positive();
        for (int i = 0; i < 48; ++i) others.push_back(point()), precisions.push_back(positive());
    }
    vector point() { return {normal(random), normal(random), normal(random)}; }
    /// B B^T + a little: symmetric and positive definite.
    matrix positive() {
        std::array<vector, 3> b{point(), point(), point()};
        matrix m{};
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j)
                m[static_cast<std::size_t>(upper_triangle<3>(i, j))] = dot(b[i], b[j]) + (i == j ? 0.1 : 0);
        return m;
    }
    /// f(difference, scaled difference, weight) for each pixel of the window, from a centre at p.
    template <class F>
    void for_each(const vector& p, double h, const F& f) const {
        f(vector{}, vector{}, 1.0);
        for (std::size_t k = 0; k < others.size(); ++k) {
            vector d;
            for (int i = 0; i < 3; ++i) d[i] = others[k][i] - p[i];
            vector s = times(centre_precision, d);
            const vector t = times(precisions[k], d);
            for (int i = 0; i < 3; ++i) s[i] += t[i];
            f(d, s, std::exp(-dot(d, s) / (2 * h * h)));
        }
    }
    vector filtered(const vector& p, double h) const {
        vector sum{};
        double total = 0;
        for_each(p, h, [&](const vector& d, const vector&, double w) {
            for (int i = 0; i < 3; ++i) sum[i] += w * (p[i] + d[i]);
            total += w;
        });
        for (double& s : sum) s /= total;
        return sum;
    }
    /// dF_i / dp_j by central differences.
    double jacobian(double h, int i, int j) const {
        const double step = 1e-5;
        vector up = centre, down = centre;
        up[j] += step, down[j] -= step;
        return (filtered(up, h)[i] - filtered(down, h)[i]) / (2 * step);
    }
};

struct noisy_pixel {
    matrix covariance;
    double p(mean_covariance_of<position_t>, int at) const { return covariance[static_cast<std::size_t>(at)]; }
};
struct bandwidth_only {
    double sigma;
};

/// What the estimator makes of the window.
template <class Estimator>
double estimated(const window_of_positions& w, double h, const matrix& covariance) {
    constexpr bool all = std::is_same_v<Estimator, anisotropic>;
    double total = 0, sums[7] = {};
    w.for_each(w.centre, h, [&](const vector& d, const vector& s, double weight) {
        total += weight;
        for (int i = 0; i < 3; ++i) sums[i] += weight * d[i], sums[3 + i] += weight * s[i];
        sums[6] += weight * dot(s, all ? times(covariance, d) : d);
    });
    return Estimator{}(bandwidth_only{h}, total, sums, noisy_pixel{covariance});
}

}  // namespace

TEST_CASE("the traces in Stein's estimate are those of the Jacobian, by central differences") {
    for (const unsigned seed : {1u, 2u, 3u, 4u})
        for (const double h : {0.4, 1.0, 2.0, 5.0}) {
            window_of_positions w(seed);
            const matrix covariance = w.positive();
            const vector f = w.filtered(w.centre, h);
            double change = 0, noise = 0, divergence = 0, of_noise = 0;
            for (int i = 0; i < 3; ++i) {
                change += (f[i] - w.centre[i]) * (f[i] - w.centre[i]);
                noise += element(covariance, i, i);
                divergence += w.jacobian(h, i, i);
                for (int j = 0; j < 3; ++j) of_noise += element(covariance, i, j) * w.jacobian(h, j, i);
            }
            CAPTURE(seed, h);
            // A quarter of a digit above the rounding of the differences.
            CHECK(estimated<isotropic>(w, h, covariance) ==
                  Approx((change - noise + 2 * noise / 3 * divergence) / 3).epsilon(1e-8).margin(1e-9));
            CHECK(estimated<anisotropic>(w, h, covariance) ==
                  Approx((change - noise + 2 * of_noise) / 3).epsilon(1e-8).margin(1e-9));
        }
}

TEST_CASE("limits: no neighbour counts, all count alike") {
    const double sums[7] = {}, all[7] = {49 * 0.1, 0, 0, 0, 0, 0, 0};
    const noisy_pixel pixel{{0.3, 0.1, 0, 0.6, 0, 0.9}};
    // The identity keeps its noise: tr C / 3.
    CHECK(isotropic{}(bandwidth_only{0.4}, 1.0, sums, pixel) == Approx(0.6));
    CHECK(anisotropic{}(bandwidth_only{0.4}, 1.0, sums, pixel) == Approx(0.6));
    // |0.1|^2 / 3 - tr C / 3 (1 - 2/49)
    CHECK(isotropic{}(bandwidth_only{1e9}, 49.0, all, pixel) == Approx(0.01 / 3 - 0.6 * (1 - 2 / 49.0)));
    CHECK(anisotropic{}(bandwidth_only{1e9}, 49.0, all, pixel) == Approx(0.01 / 3 - 0.6 * (1 - 2 / 49.0)));
}

TEST_CASE("terms of a pair, by hand; beyond all weights there are none") {
    neighbourhood<isotropic::reads> around({2, 1});
    const float q[] = {0.5f, 0, -1};
    for (int c = 0; c < 3; ++c) around.at(position, 1, 0, c) = q[c];
    for (const int x : {0, 1}) {
        around.at(precision(position), x, 0, 0) = 2;      // xx
        around.at(precision(position), x, 0, 2) = 0.25f;  // xz
        around.at(precision(position), x, 0, 5) = 1;      // zz
    }
    around.at(mean_covariance(position), 0, 0, 0) = 3;
    around.at(mean_covariance(position), 0, 0, 5) = 5;
    float t[7];
    isotropic{}.terms(around.pair(0, 0, 1, 0), t);
    // A = 2 (2 0 .25; 0 0 0; .25 0 1):  s = (4 .5 - .5, 0, .5 .5 - 2) = (1.5, 0, -1.75)
    const float expected[] = {0.5f, 0, -1, 1.5f, 0, -1.75f, 0.75f + 1.75f};
    for (int k = 0; k < 7; ++k) CHECK(t[k] == Approx(expected[k]));
    anisotropic{}.terms(around.pair(0, 0, 1, 0), t);
    CHECK(t[6] == Approx(1.5 * 3 * 0.5 + 1.75 * 5));
    around.at(position, 1, 0, 0) = 1e15f;
    for (int c = 0; c < 6; ++c) around.at(precision(position), 1, 0, c) = c % 2 ? -1e15f : 1e15f;
    isotropic{}.terms(around.pair(0, 0, 1, 0), t);
    for (int k = 0; k < 7; ++k) CHECK(t[k] == 0);
}

namespace {

/// Noise of the given standard deviations along three axes that are turned in the plane of the first two.
vector turned(const vector& deviation, std::uint64_t stream, int x, int y) {
    const double a = deviation[0] * normal_deviate(stream, x, y, 0), b = deviation[1] * normal_deviate(stream, x, y, 1);
    const double c = std::cos(0.6), s = std::sin(0.6);
    return {c * a - s * b, s * a + c * b, deviation[2] * normal_deviate(stream, x, y, 2)};
}
matrix covariance_of_turned(const vector& d) {
    const double c = std::cos(0.6), s = std::sin(0.6), a = d[0] * d[0], b = d[1] * d[1];
    return {c * c * a + s * s * b, c * s * (a - b), 0, s * s * a + c * c * b, 0, d[2] * d[2]};
}

/// How much the estimate is above the squared error, mean over the image, over draws of noise.
template <class Estimator>
std::pair<statistic, statistic> over_noise(const vector& deviation, float h) {
    const extent size{13, 11};
    const matrix noise = covariance_of_turned(deviation);
    image<> truth = fill(size, 3, [](int x, int y, int c) { return c == 0 ? 0.1 * x : c == 1 ? 0.1 * y : 0.02 * x; });
    image<> position_(size, 3), error(size), filtered(size, 3);
    // Samples spread eight times as much as their mean; precisions are fixed, as the estimate has it.
    std::array<float, 6> spread;
    for (std::size_t k = 0; k < 6; ++k) spread[k] = static_cast<float>(8 * noise[k]);
    const auto inverse = regularized_precision(spread, 1, 1e-4);
    const image<> precisions = fill(size, 6, [&](int, int, int c) { return inverse[static_cast<std::size_t>(c)]; });
    const image<> covariances = fill(size, 6, [&](int, int, int c) { return noise[static_cast<std::size_t>(c)]; });
    const filter f = filter{gaussian(mahalanobis(position), h), window::square{.radius = 3}}.with(Estimator{});
    const frame in{position = position_.view(), precision(position) = precisions.view(),
                   mean_covariance(position) = covariances.view()};
    workspace memory;
    const output out = output{filtered}.error(error.view());
    std::pair<statistic, statistic> found;
    for (int n = 0; n < 3000; ++n) {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const vector e = turned(deviation, static_cast<std::uint64_t>(100 + n), x, y);
                for (int c = 0; c < 3; ++c) position_.at(x, y, c) = truth.at(x, y, c) + static_cast<float>(e[c]);
            }
        f(filtering(position, in), out, executor::simd{}, memory);
        double excess = 0, squared = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                double off = 0;
                for (int c = 0; c < 3; ++c) {
                    const double d = double{filtered.at(x, y, c)} - double{truth.at(x, y, c)};
                    off += d * d / 3;
                }
                excess += error.at(x, y) - off;
                squared += off;
            }
        found.first.add(excess / static_cast<double>(size.pixels()));
        found.second.add(squared / static_cast<double>(size.pixels()));
    }
    return found;
}

}  // namespace

TEST_CASE("Stein's estimate of positions is unbiased; of noise with a direction only the anisotropic one is") {
    const vector round{0.05, 0.05, 0.05}, along{0.15, 0.02, 0.01};
    for (const float h : {0.8f, 1.6f}) {
        const auto [even, even_error] = over_noise<isotropic>(round, h);
        const auto [all, all_error] = over_noise<anisotropic>(along, h);
        const auto [biased, biased_error] = over_noise<isotropic>(along, h);
        CAPTURE(h, even, even_error, all, all_error, biased, biased_error);
        CHECK(std::abs(even.mean) <= 3 * even.standard_error());
        CHECK(std::abs(all.mean) <= 3 * all.standard_error());
        CHECK(std::abs(biased.mean) > 20 * biased.standard_error());
        // The test would see a twentieth of the error itself.
        CHECK(even_error.mean > 20 * even.standard_error());
        CHECK(all_error.mean > 20 * all.standard_error());
    }
}

TEST_CASE("of isotropic noise it is the mean over the coordinates of the estimate by differentiation") {
    const extent size{21, 17};
    const image<> positions = fill(size, 3, [](int x, int y, int c) {
        return (c == 0 ? 0.1 * x : c == 1 ? 0.1 * y : 2) + 0.05 * normal_deviate(3, x, y, c);
    });
    const image<> precisions = fill(size, 6, [](int x, int y, int c) {
        return c == 0 || c == 3 || c == 5 ? 90 + 20 * uniform(4, x, y, c) : 20 * uniform(5, x, y, c);
    });
    const image<> covariances = fill(size, 6, [](int, int, int c) { return c == 0 || c == 3 || c == 5 ? 0.002 : 0; });
    const image<> variances = fill(size, 3, [](int, int, int) { return 0.002; });
    const frame in{position = positions.view(), precision(position) = precisions.view(),
                   mean_covariance(position) = covariances.view(), variance(position) = variances.view()};
    for (const float h : {0.4f, 1.2f, 2.0f}) {
        const filter f{gaussian(mahalanobis(position), h), window::square{.radius = 3}};
        image<> closed(size), differentiated(size, 3);
        const auto check = [&](const auto& executor) {
            f.with(isotropic{})(filtering(position, in), output{}.error(closed.view()), executor);
            f.with(estimator::sure<position_t>{})(filtering(position, in), output{}.error(differentiated.view()),
                                                  executor);
            const image<> expected = fill(size, 1, [&](int x, int y, int) {
                return (differentiated.at(x, y, 0) + differentiated.at(x, y, 1) + differentiated.at(x, y, 2)) / 3;
            });
            CHECK(beyond(1e-7, closed, expected) == "");
        };
        check(executor::serial<double>{});
        check(executor::simd{});
    }
}
