// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <array>
#include <support/catch.hpp>
#include <support/neighbourhood.hpp>
#include <winnow/frame/differential.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

using number = differential<double, albedo_t>;

/// f(x) at three variables, one for each channel, against central differences of f over plain doubles.  The step is
/// extrapolated to 0: what is left is of order h^4 or rounding, 1e-16 / h.
template <class F>
void check_slopes(const F& f, std::array<double, 3> at = {0.7, 1.3, -0.4}) {
    const auto plain = [&](int c, double by) {
        std::array<double, 3> x = at;
        x[static_cast<std::size_t>(c)] += by;
        return f(x[0], x[1], x[2]);
    };
    const number found = f(number::variable(at[0], 0), number::variable(at[1], 1), number::variable(at[2], 2));
    CHECK(found.value() == Approx(plain(0, 0)).epsilon(1e-15));
    for (int c = 0; c < 3; ++c) {
        const auto central = [&](double h) { return (plain(c, h) - plain(c, -h)) / (2 * h); };
        const double h = 0x1p-11, expected = (4 * central(h / 2) - central(h)) / 3;
        CAPTURE(c);
        CHECK(found.slope(c) == Approx(expected).epsilon(1e-10).margin(1e-11));
    }
}

}  // namespace

TEST_CASE("the slope of each operation is that of central differences") {
    check_slopes([](auto x, auto y, auto) { return x + y; });
    check_slopes([](auto x, auto y, auto) { return x - y; });
    check_slopes([](auto x, auto y, auto) { return x * y; });
    check_slopes([](auto x, auto y, auto) { return x / y; });
    check_slopes([](auto x, auto, auto) { return -x; });
    check_slopes([](auto x, auto y, auto) { return math::sqrt(x * y); });
    check_slopes([](auto x, auto y, auto) { return math::reciprocal(x + y); });
    check_slopes([](auto x, auto y, auto) { return math::exp_neg(x * y); });
    check_slopes([](auto x, auto y, auto z) { return math::fma(x, y, z); });
    check_slopes([](auto x, auto y, auto z) { return math::square(x - y) * math::square(z); });
    check_slopes([](auto x, auto y, auto z) { return math::exp_neg(math::square(x - y) / (x + y)) - z * x; });
}

TEST_CASE("the slope of an operation with a constant on either side is that of central differences") {
    const auto with_constant = [](const auto& operation) {
        check_slopes([&](auto x, auto, auto) { return operation(x, decltype(x)(1.25f)); });
        check_slopes([&](auto x, auto, auto) { return operation(decltype(x)(1.25f), x); });
    };
    with_constant([](auto a, auto b) { return a + b; });
    with_constant([](auto a, auto b) { return a - b; });
    with_constant([](auto a, auto b) { return a * b; });
    with_constant([](auto a, auto b) { return a / b; });
    with_constant([](auto a, auto b) { return math::fma(a, a, b); });
    with_constant([](auto a, auto b) { return math::fma(b, a, a); });
}

TEST_CASE("min, max and select have the slope of the side that they take") {
    check_slopes([](auto x, auto y, auto) { return math::min(x * x, y); });
    check_slopes([](auto x, auto y, auto) { return math::min(y, x * x); });
    check_slopes([](auto x, auto y, auto) { return math::max(x * x, y); });
    check_slopes([](auto x, auto y, auto) { return math::max(y, x * x); });
    for (const float limit : {-10.0f, 0.5f, 10.0f}) {  // a constant on the other side, taken or not
        check_slopes([&](auto x, auto y, auto) { return math::min(x * y, decltype(x)(limit)); });
        check_slopes([&](auto x, auto y, auto) { return math::max(decltype(x)(limit), x * y); });
        check_slopes([&](auto x, auto y, auto z) { return math::select(decltype(x)(limit) < x, y * y, x * z); });
    }
    // At a tie the second, whose value it is for plain numbers too.
    const number x = number::variable(2, 0), y = number::variable(2, 1);
    CHECK(number::min(x, y).slope(0) == 0);
    CHECK(number::min(x, y).slope(1) == 1);
    CHECK(number::max(x, y).slope(0) == 0);
    CHECK(number::max(x, y).slope(1) == 1);
    // exp_neg no longer decays beyond its last exponent.
    CHECK(math::exp_neg(number::variable(79, 0)).slope(0) == Approx(-std::exp(-79.0)).epsilon(1e-14));
    CHECK(math::exp_neg(number::variable(81, 0)).slope(0) == 0);
}

TEST_CASE("an infinite slope on the side that is not taken does no harm") {
    const number root = math::sqrt(number::variable(0, 0));
    CHECK(std::isinf(root.slope(0)));
    CHECK(math::max(root, number(1)).slope(0) == 0);
    CHECK(math::min(number(-1), root).slope(0) == 0);
    CHECK(math::select(root < number(1), number::variable(3, 1), root).slope(0) == 0);
}

TEST_CASE("constants vary with nothing, nor does what is made of them") {
    const number a(2.0), b(3), c(0.5f);
    CHECK(b.value() == 3);
    CHECK(c.value() == 0.5);
    for (const number& x : {a, a + b, a - b, a * b, a / b, -a, math::sqrt(a), math::reciprocal(a), math::exp_neg(a),
                            math::fma(a, b, c), math::min(a, b), math::max(a, b), math::select(a < b, a, b)})
        for (int k = 0; k < 3; ++k) CHECK(x.slope(k) == 0);
    CHECK(math::select(a < b, a, b).value() == 2);
}

TEST_CASE("a variable varies with its own channel alone") {
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k) CHECK(number::variable(7, c).slope(k) == (c == k));
    CHECK(differential<float, depth_t>::variable(7, 0).slope(0) == 1);
}

namespace {

using seen = planes<depth_t, albedo_t>;
using with_slopes = differential<float, albedo_t>;
neighbourhood<seen> around({9, 8}, scales{});

/// Which of p's and q's albedo is the variable, as "pq", "p-", "-q" or "--", the same in all channels and no other.
template <class Pair>
std::string variables(const Pair& pq) {
    const auto varies = [](const auto& value) {
        int channels = 0;
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < 3; ++k) {
                const float slope = value(c).slope(k);
                if (slope != (c == k ? 1 : 0) && slope != 0) return 'x';
                if (c == k) channels += slope == 1;
            }
        return channels == 3 ? 'v' : channels == 0 ? '-' : 'x';
    };
    const char p = varies([&](int c) { return pq.p(albedo, c); }), q = varies([&](int c) { return pq.q(albedo, c); });
    return {p == 'v' ? 'p' : p, q == 'v' ? 'q' : q};
}

}  // namespace

TEST_CASE("a pair varies with its buffer at p and with nothing else") {
    const auto pq = around.pair<with_slopes>(4, 4, 2, 1);
    CHECK(variables(pq) == "p-");
    for (int k = 0; k < 3; ++k) {
        CHECK(pq.p(depth).slope(k) == 0);
        CHECK(pq.q(depth).slope(k) == 0);
        CHECK(pq.dx().slope(k) == 0);
        CHECK(pq.dy().slope(k) == 0);
        CHECK(pq.covered().slope(k) == 0);
    }
}

TEST_CASE("values are those of the plain pair, wherever it is shifted") {
    const auto pq = around.pair<with_slopes>(4, 4, 2, 1);
    const auto plain = around.pair(4, 4, 2, 1);
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x)
            for (int c = 0; c < 3; ++c) {
                CHECK(pq.shifted(x, y).p(albedo, c).value() == plain.shifted(x, y).p(albedo, c));
                CHECK(pq.shifted(x, y).q(albedo, c).value() == plain.shifted(x, y).q(albedo, c));
                CHECK(pq.shifted(x, y).q(depth).value() == plain.shifted(x, y).q(depth));
                CHECK(pq.shifted(x, y).dx().value() == 2);
                CHECK(pq.shifted(x, y).dy().value() == 1);
            }
}

TEST_CASE("a shifted pair meets p in its place, and on the side of q where q has come to p") {
    for (const auto& [dx, dy] : {std::pair{2, 1}, std::pair{-1, 0}, std::pair{0, 2}, std::pair{-2, -1}}) {
        const auto pq = around.pair<with_slopes>(4, 4, dx, dy);
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x) {
                CAPTURE(dx, dy, x, y);
                const std::string expected = x == 0 && y == 0 ? "p-" : x == -dx && y == -dy ? "-q" : "--";
                CHECK(variables(pq.shifted(x, y)) == expected);
                // In two steps, and away from it and back.
                CHECK(variables(pq.shifted(x, 0).shifted(0, y)) == expected);
                CHECK(variables(pq.shifted(1, -1).shifted(x - 1, y + 1)) == expected);
            }
    }
}

TEST_CASE("the patch around a pixel and itself meets it on both sides: its distance does not change") {
    const auto own = around.pair<with_slopes>(4, 4, 0, 0).shifted(0, 0);
    CHECK(variables(own) == "pq");
    for (int k = 0; k < 3; ++k) CHECK(math::square(own.p(albedo, k) - own.q(albedo, k)).slope(k) == 0);
}

TEST_CASE("an executor may ask for one side alone") {
    const auto pq = around.pair<with_slopes>(4, 4, 2, 1);
    CHECK(variables(pq.varying(true, false)) == "p-");
    CHECK(variables(pq.varying(false, true)) == "-q");
    CHECK(variables(pq.varying(false, false)) == "--");
}

TEST_CASE("what was worked out ahead with its slopes is read from the places after it") {
    const float ahead[] = {0, 1, 2, 3, 4, 5};
    const float planes[8] = {};
    const pixel_pair<with_slopes, winnow::planes<>> pq(planes, planes, {}, 1, 0, {ahead, 1});
    const with_slopes x = pq.ahead_with_slopes(2);
    CHECK(x.value() == 2);
    for (int c = 0; c < 3; ++c) {
        CHECK(x.slope(c) == static_cast<float>(3 + c));
        CHECK(pq.ahead(2).slope(c) == 0);
    }
}
