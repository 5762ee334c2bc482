// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// dF / du: serial in double against finite differences, lanes against serial.
#include <functional>
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/paper/rdfc_2013_candidate.hpp>
#include <winnow/weight/cutoff.hpp>
#include <winnow/weight/patch_mean.hpp>
#include <winnow/window/disk.hpp>
#include "executor/agreement.hpp"
#include "executor/definition.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

auto with_numbers(filter_numbers n) {
    return [n](auto weight) { return filter{weight, window::square{.radius = n.radius}, estimator::sure{}, n.border}; };
}
auto nlm_with_sure(filter_numbers n) {
    return with_numbers(n)(exponential(patch(noise_normalized(color), {.radius = n.patch_radius})));
}
auto candidate_with_sure(filter_numbers n) {
    return paper::make_rdfc_candidate({.radius = n.radius, .patch_radius = n.patch_radius, .tau = 0.05f})
        .with(n.border)
        .with(estimator::sure{});
}
auto bilateral_with_sure(filter_numbers n) {
    return paper::make_bilateral({.radius = n.radius, .sigma_spatial = 2, .sigma_color = 0.3f})
        .with(n.border)
        .with(estimator::sure{});
}
/// Products, a smaller weight that is no exponential, a cutoff, sums of a patch with what is none, over a disk.
auto mixture_with_sure(filter_numbers n) {
    return filter{min(exponential(patch(noise_normalized(color), {.radius = n.patch_radius}) + l2(albedo)),
                      cutoff(l2(depth), 0.25f + 0x1p-18f)) *
                      gaussian(max(l2(color), patch(l2(color), {.radius = 2})), 0.5f) * gaussian(spatial, 2.5f),
                  window::disk{.radius = n.radius}, estimator::sure{}, n.border};
}
auto features_with_sure(filter_numbers n) { return with_numbers(n)(gaussian(l2(albedo), 0.2f)); }

/// sum |g(p) - g(q)|, which has a kink where both are the same, as of a pixel and itself.
struct absolute_difference {
    using role = role::distance;
    using reads = planes<color_t>;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return math::sum_over<3>([&](auto c) WINNOW_HD_LAMBDA {
            const Real difference = pq.p(color, c) - pq.q(color, c);
            return math::max(difference, -difference);
        });
    }
};
auto absolute_with_sure(filter_numbers n) {
    return with_numbers(n)(exponential(absolute_difference{}) *
                           gaussian(patch(absolute_difference{}, {.radius = n.patch_radius}), 0.5f));
}

/// Noisy buffers whose colour is a multiple of 2^-20, so that small powers of two can be added to it exactly.
buffers make_exact(extent size, std::uint64_t seed = 1) {
    buffers in = make_buffers(size, seed);
    in.color = fill(size, 3, [before = in.color](int x, int y, int c) {
        return std::round(before.at(x, y, c) * 0x1p20) * 0x1p-20;
    });
    return in;
}

/// A pixel that has a pair this near a kink, in units of the colour, is left out: the steps below may cross it, and a
/// float may be on its other side.
constexpr double near_kink = 0x1p-13;

/// Central differences of the definition, which works in double, with the step extrapolated to 0.  The step of 2^-15 is
/// exact in the planes, which hold floats; sums of doubles are good to 1e-15, so that differences are to 1e-10, and
/// what the step leaves is of order 2^-60 times a fifth derivative.  Results leave an executor as floats: half a unit
/// in the last place on top.
template <guide G = color_t, class Filter, class Frame>
void check_differences(const Filter& f, const Frame& in, extent size) {
    image<> derivative(size, G::channels);
    f(in, output{}.derivative(derivative.view()), executor::serial<double>{});
    definition<Filter, G> exact(f, in);
    int left_out = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const defined_pixel p = exact.at(x, y);
            if (p.kink < near_kink) {
                ++left_out;
                continue;
            }
            for (int c = 0; c < G::channels; ++c) {
                const auto central = [&](float h) {
                    return (exact.filtered(x, y, c, h)[c] - exact.filtered(x, y, c, -h)[c]) / (2 * double{h});
                };
                const double expected = (4 * central(0x1p-16f) - central(0x1p-15f)) / 3;
                CAPTURE(to_string(size), static_cast<int>(f.border), x, y, c, p.kink);
                CHECK(std::abs(p.derivative[c] - expected) <= 1e-8);
                CHECK(std::abs(derivative.at(x, y, c) - expected) <= 1e-8 + 0x1p-24 * std::abs(expected));
            }
        }
    CAPTURE(left_out, size.pixels());
    // Copies beyond the image lie on a kink of their own for distances that have one at equal colours.
    if (f.border == border::clip) CHECK(10 * left_out <= size.pixels());
}

constexpr extent usual{13, 11};
constexpr extent tiny[] = {{1, 1}, {2, 2}, {1, 9}, {5, 3}};

template <class Make>
void check_differences_of(const Make& make, filter_numbers n, extent size = usual) {
    for (const border rule : all_borders) {
        n.border = rule;
        check_differences(make(n), make_exact(size).layers(), size);
    }
}

}  // namespace

TEST_CASE("the derivative of non-local means is that of differences, for every patch and border") {
    for (const int f : {0, 1, 2}) check_differences_of(nlm_with_sure, {.radius = 3, .patch_radius = f});
    check_differences_of(nlm_with_sure, {.radius = 2, .patch_radius = 3});  // patches that reach beyond the window
}

TEST_CASE("the derivative of RDFC's candidates is that of differences, for every border") {
    for (const int f : {1, 3}) check_differences_of(candidate_with_sure, {.radius = 3, .patch_radius = f});
}

TEST_CASE("the derivative of a bilateral filter is that of differences, for every border") {
    check_differences_of(bilateral_with_sure, {.radius = 3});
}

TEST_CASE("the derivative of products, minima, cutoffs and sums over a disk is that of differences") {
    for (const int f : {1, 2}) check_differences_of(mixture_with_sure, {.radius = 3, .patch_radius = f});
}

TEST_CASE("the derivative of patches within patches and of mean weights is that of differences, on serial") {
    check_differences_of(
        [](filter_numbers n) {
            return with_numbers(n)(
                patch_mean(exponential(patch(noise_normalized(color), {.radius = 1})), {.radius = n.patch_radius}) *
                gaussian(patch(patch(l2(color), {.radius = 1}), {.radius = n.patch_radius}), 0.5f));
        },
        {.radius = 2, .patch_radius = 1}, {9, 7});
}

TEST_CASE("the derivative of distances with a kink at equal colours is that of differences") {
    check_differences_of(absolute_with_sure, {.radius = 3, .patch_radius = 1});
}

TEST_CASE("the derivative is that of differences on images smaller than the window") {
    for (const extent size : tiny) {
        check_differences_of(nlm_with_sure, {.radius = 6, .patch_radius = 1}, size);
        check_differences_of(candidate_with_sure, {.radius = 6, .patch_radius = 3}, size);
        check_differences_of(mixture_with_sure, {.radius = 4, .patch_radius = 1}, size);
    }
}

TEST_CASE("the derivative with respect to another buffer than colour is that of differences") {
    const buffers in = make_exact(usual);  // depths are multiples of 1/256
    const named_layers layers = in.layers();
    for (const border rule : all_borders) {
        const filter f{exponential(patch(noise_normalized(depth), {.radius = 1})) * gaussian(l2(depth), 0.4f) *
                           gaussian(l2(albedo), 0.5f),
                       window::square{.radius = 3}, estimator::sure<depth_t>{}, rule};
        check_differences<depth_t>(f, filtering(depth, layers), usual);
    }
}

TEST_CASE("the derivative is what the filter does to an image of which one value is changed") {
    // Through the filter itself, all in floats: differences of results of 2^-24 over a step of 2^-7, extrapolated.
    // Copies beyond the image would change as well: with borders that make some, only pixels away from them.
    const extent size{17, 15};
    const float h = 0x1p-7f;
    for (const border rule : all_borders) {
        const auto f = bilateral_with_sure({.radius = 2, .border = rule});
        buffers in = make_exact(size);
        image<> derivative(size, 3);
        f(in.layers(), output{}.derivative(derivative.view()), executor::serial<double>{});
        const auto filtered = [&](int x, int y, int c, float by) {
            image<> mean(size, 3);
            const float before = in.color.at(x, y, c);
            in.color.at(x, y, c) += by;
            f(in.layers(), mean, executor::serial<double>{});
            in.color.at(x, y, c) = before;
            return double{mean.at(x, y, c)};
        };
        const int rim = rule == border::clip ? 0 : 2;
        for (int y = rim; y < size.height - rim; y += 2)
            for (int x = rim; x < size.width - rim; x += 3) {
                const int c = (x + y) % 3;
                const auto central = [&](float by) {
                    return (filtered(x, y, c, by) - filtered(x, y, c, -by)) / (2 * double{by});
                };
                CAPTURE(static_cast<int>(rule), x, y, c);
                // Two results of up to 2, half a unit each: 2^-24 over the half step, times 4/3, and as much again.
                CHECK(std::abs(derivative.at(x, y, c) - (4 * central(h / 2) - central(h)) / 3) <=
                      3 * 0x1p-23 / double{h});
            }
    }
}

TEST_CASE("what does not look at the colour keeps w(p,p) / C of a pixel's noise") {
    for (const border rule : all_borders) {
        const auto f = features_with_sure({.radius = 2, .border = rule});
        const buffers in = make_exact(usual);
        check_differences(f, in.layers(), usual);
        image<> derivative(usual, 3), support(usual, 1);
        f(in.layers(), output{}.derivative(derivative.view()).support(support.view()));
        for (int y = 0; y < usual.height; ++y)
            for (int x = 0; x < usual.width; ++x)
                for (int c = 0; c < 3; ++c) CHECK(derivative.at(x, y, c) == Approx(1 / support.at(x, y)).epsilon(1e-6));
    }
}

namespace {

/// Everything that a filter with estimator::sure can be asked for.
struct results {
    image<> mean, error, derivative, support;
    explicit results(extent size) : mean(size, 3), error(size, 3), derivative(size, 3), support(size, 1) {}
    output all() { return output{mean}.error(error.view()).derivative(derivative.view()).support(support.view()); }
    std::string other_bits_than(const results& o) const {
        return other_bits(mean, o.mean) + other_bits(error, o.error) + other_bits(derivative, o.derivative) +
               other_bits(support, o.support);
    }
};

/// A filter with its type erased, for the executors that these tests need.
struct erased_filter {
    std::string name;
    std::function<results(const buffers&, const how&)> run;
    std::function<std::vector<defined_pixel>(const buffers&)> define;
};
template <class Filter>
erased_filter erased(std::string name, const Filter& f) {
    return {std::move(name),
            [f](const buffers& in, const how& h) {
                results r(in.size());
                const executor::simd lanes{.tile = h.tile};
                if (h.kind == executor_kind::serial_double) f(in.layers(), r.all(), executor::serial<double>{});
                else if (h.kind == executor_kind::simd) f(in.layers(), r.all(), lanes);
                else f(in.layers(), r.all(), executor::openmp{.threads = h.threads, .inner = lanes});
                return r;
            },
            [f](const buffers& in) {
                definition<Filter> exact(f, in.layers());
                std::vector<defined_pixel> all;
                for (int y = 0; y < in.size().height; ++y)
                    for (int x = 0; x < in.size().width; ++x) all.push_back(exact.at(x, y));
                return all;
            }};
}
std::vector<erased_filter> filters(filter_numbers n) {
    return {erased("nlm", nlm_with_sure(n)),
            erased("candidate", candidate_with_sure(n)),
            erased("bilateral", bilateral_with_sure(n)),
            erased("mixture", mixture_with_sure(n)),
            erased("absolute", absolute_with_sure(n)),
            erased("features", features_with_sure(n))};
}

/// Lanes against serial<double>, within what rounding can do.  With r = rounding_bound(n), which bounds the relative
/// error of a weight, and s the largest value: F is wrong by at most r s.  A slope of a weight is wrong by r of itself
/// as its weight is, so that dF/du = (w(p,p) + sum dw (u - F)) / C is wrong by at most
/// r (w(p,p) + sum |dw| (|u| + |F|)) / C + r s sum |dw| / C + r |dF/du|.
void check_lanes(const erased_filter& f, extent size, filter_numbers n, const how& h = {executor_kind::simd}) {
    const buffers in = make_buffers(size);
    const results expected = f.run(in, {}), found = f.run(in, h);
    const std::vector<defined_pixel> defined = f.define(in);
    const double e = 0x1p-24, r = rounding_bound(n), s = largest_magnitude(in.color);
    CAPTURE(f.name, to_string(h), to_string(size), n.radius, n.patch_radius, static_cast<int>(n.border));
    CHECK(beyond(r * s, found.mean, expected.mean) == "");
    CHECK(beyond_relative(r, found.support, expected.support) == "");
    int left_out = 0;
    double mean_error = 0, mean_condition = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const defined_pixel& p = defined[static_cast<std::size_t>(x + y * size.width)];
            if (p.kink < near_kink) {
                ++left_out;
                continue;
            }
            for (int c = 0; c < 3; ++c) {
                const double d = expected.derivative.at(x, y, c), condition = p.own + 3 * s * p.slopes[c] + std::abs(d);
                const double off = std::abs(found.derivative.at(x, y, c) - d);
                CAPTURE(x, y, c, d, condition, p.kink);
                CHECK(off <= r * condition);
                mean_error += off, mean_condition += condition;
                const double change = std::abs(double{expected.mean.at(x, y, c)} - double{in.color.at(x, y, c)});
                const double v = in.color_variance.at(x, y, c);
                CHECK(std::abs(found.error.at(x, y, c) - expected.error.at(x, y, c)) <=
                      2 * change * r * s + r * r * s * s + 2 * v * r * condition +
                          8 * e * (change * change + v + 2 * v * std::abs(d)));
            }
        }
    CHECK(mean_error <= mean_bound(n) * mean_condition);
    CAPTURE(left_out, size.pixels());
    if (n.border == border::clip) CHECK(4 * left_out <= size.pixels() + 4);
}

}  // namespace

TEST_CASE("lanes agree with serial on derivatives, errors and sums of weights, for every border and patch") {
    for (const border rule : all_borders)
        for (const int f : {0, 1, 2, 3, 4}) {
            const filter_numbers n{.radius = 2, .patch_radius = f, .border = rule};
            for (const erased_filter& each : filters(n)) check_lanes(each, {21, 14}, n);
        }
}

TEST_CASE("lanes agree with serial on derivatives at every width around a register's") {
    const filter_numbers n{.radius = 2, .patch_radius = 1};
    for (const int width : {1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 47, 48, 49})
        for (const erased_filter& each : filters(n)) check_lanes(each, {width, 3}, n);
}

TEST_CASE("lanes agree with serial on derivatives where window and patches are larger than the image") {
    for (const border rule : all_borders)
        for (const extent size : {extent{1, 1}, extent{2, 2}, extent{1, 9}, extent{5, 3}}) {
            const filter_numbers n{.radius = 6, .patch_radius = 3, .border = rule};
            for (const erased_filter& each : filters(n)) check_lanes(each, size, n);
        }
}

TEST_CASE("lanes agree with serial on derivatives over several tiles") {
    const filter_numbers n{.radius = 3, .patch_radius = 1};
    for (const erased_filter& each : filters(n))
        check_lanes(each, {37, 11}, n, {.kind = executor_kind::simd, .tile = {16, 4}});
}

TEST_CASE("the bits of derivatives, errors and sums of weights do not depend on tiles or threads", "[openmp]") {
    const extent size{67, 29};
    const buffers in = make_buffers(size);
    std::vector<how> hows;
    for (const extent tile : {extent{1, 1}, extent{16, 7}, extent{48, 5}, extent{400, 3}, extent{1000, 1000}})
        hows.push_back({.kind = executor_kind::simd, .tile = tile});
    for (const int threads : {1, 2, 3, 7})
        hows.push_back({.kind = executor_kind::openmp, .threads = threads, .tile = {16, 4}});
    for (const border rule : all_borders)
        for (const erased_filter& f : filters({.radius = 2, .patch_radius = 2, .border = rule})) {
            const results expected = f.run(in, {executor_kind::simd});
            for (const how& h : hows) {
                CAPTURE(f.name, to_string(h), static_cast<int>(rule));
                CHECK(f.run(in, h).other_bits_than(expected) == "");
            }
        }
}

TEST_CASE("one layer's bits do not depend on what else is asked for") {
    const extent size{19, 9};
    const buffers in = make_buffers(size);
    const auto f = candidate_with_sure({.radius = 2});
    results all(size), alone(size);
    f(in.layers(), all.all(), executor::simd{});
    f(in.layers(), output{}.derivative(alone.derivative.view()), executor::simd{});
    f(in.layers(), output{}.error(alone.error.view()), executor::simd{});
    f(in.layers(), output{}.support(alone.support.view()), executor::simd{});
    f(in.layers(), alone.mean, executor::simd{});
    CHECK(alone.other_bits_than(all) == "");
}

TEST_CASE("a window of radius 0 keeps all noise") {
    const extent size{21, 5};
    const buffers in = make_buffers(size);
    for (const erased_filter& f : filters({.radius = 0}))
        for (const executor_kind kind : {executor_kind::serial_double, executor_kind::simd}) {
            const results r = f.run(in, {kind});
            CAPTURE(f.name, static_cast<int>(kind));
            CHECK(other_bits(r.mean, in.color) == "");
            CHECK(other_bits(r.derivative, fill(size, 3, [](int, int, int) { return 1; })) == "");
            CHECK(other_bits(r.support, fill(size, 1, [](int, int, int) { return 1; })) == "");
            CHECK(beyond_relative(3 * 0x1p-24, r.error, in.color_variance) == "");
        }
}
