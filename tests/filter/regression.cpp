// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <vector>
#include <winnow/filter/regression.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

constexpr int size = 4, group = 4;

struct neighbours {
    std::vector<double> w, x;
    int count;

    explicit neighbours(int n) : w(static_cast<std::size_t>(n)), x(static_cast<std::size_t>(n * size)), count(n) {
        for (int i = 0; i < n; ++i) {
            w[static_cast<std::size_t>(i)] = 0.1 + uniform(1, i, 0);
            for (int j = 0; j < size; ++j)
                x[static_cast<std::size_t>(i * size + j)] = j == 0 ? 1 : uniform(2, i, j) - 0.3;
        }
    }
    const double* at(int i) const { return x.data() + i * size; }
    double weight(int i) const { return w[static_cast<std::size_t>(i)]; }

    normal_equations<double, size> equations() const {
        normal_equations<double, size> a;
        for (int i = 0; i < count; i += group) {
            double of[group];
            for (int n = 0; n < group; ++n) of[n] = weight(i + n);
            a.add(of, at(i), size);
        }
        return a;
    }
    template <class F>
    double sum(const local_fit<double, size>& fit, const F& u) const {
        double total = 0;
        for (int i = 0; i < count; ++i) total += weight(i) * fit.share(at(i)) * u(i);
        return total;
    }
};

}  // namespace

TEST_CASE("regression: a line through two points, by hand") {
    // u = 1 at x = -1 and 4 at x = 2, both of weight 2: 2 at x = 0, by the row (2/3, 1/3).
    const double x[] = {1, -1, 1, 2}, w[2] = {2, 2};
    normal_equations<double, 2> a;
    a.add(w, x, 2);
    CHECK(a.sums.at(0, 0) == 4);
    CHECK(a.sums.at(1, 0) == 2);
    CHECK(a.sums.at(1, 1) == 10);
    const local_fit<double, 2> fit(a, 1e-9f);
    CHECK(2 * fit.share(x) == Approx(2.0 / 3).epsilon(1e-8));
    CHECK(2 * fit.share(x + 2) == Approx(1.0 / 3).epsilon(1e-8));
    double b[2] = {2 * 1 + 2 * 4, -2 * 1 + 2 * 2 * 4};
    fit.solve(b);
    CHECK(b[0] == Approx(2).epsilon(1e-8));
    CHECK(b[1] == Approx(1).epsilon(1e-8));
}

TEST_CASE("regression: a ridge shrinks slopes by hand's account") {
    // Two points at -1 and 1 of weight 1, values -1 and 1: slope 2 / (2 + ridge).
    const double x[] = {1, -1, 1, 1}, w[2] = {1, 1};
    normal_equations<double, 2> a;
    a.add(w, x, 2);
    double b[2] = {0, 2};
    local_fit<double, 2>(a, 2).solve(b);
    CHECK(b[1] == Approx(0.5));
    CHECK(b[0] == Approx(0).margin(1e-15));
}

TEST_CASE("regression: the row adds up to 1, whatever the ridge, and kills what is linear in x") {
    const neighbours q(40);
    for (const float ridge : {1e-6f, 1.0f, 1e3f}) {
        const local_fit<double, size> fit(q.equations(), ridge);
        CHECK(q.sum(fit, [](int) { return 1.0; }) == Approx(1).epsilon(1e-12));
    }
    const local_fit<double, size> fit(q.equations(), 1e-9f);
    for (int j = 1; j < size; ++j) CHECK(std::abs(q.sum(fit, [&](int i) { return q.at(i)[j]; })) < 1e-8);
}

TEST_CASE("regression: the row and the solution agree on the intercept") {
    const neighbours q(36);
    const local_fit<double, size> fit(q.equations(), 0.1f);
    const auto u = [](int i) { return normal_deviate(3, i, 0); };
    double b[size] = {};
    for (int i = 0; i < q.count; ++i)
        for (int j = 0; j < size; ++j) b[j] += q.weight(i) * q.at(i)[j] * u(i);
    fit.solve(b);
    CHECK(b[0] == Approx(q.sum(fit, u)).epsilon(1e-10));
}

TEST_CASE("regression: one neighbour, or all in one place: a mean, and nothing is divided by 0") {
    const double x[] = {1, 0, 0, 1, 0, 0}, w[2] = {1, 0};
    normal_equations<double, 3> a;
    a.add(w, x, 3);
    const local_fit<double, 3> fit(a, 1e-4f);
    CHECK(fit.share(x) == Approx(1).epsilon(1e-12));
}
