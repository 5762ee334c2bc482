// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// What several weights have in common is evaluated once, and nobody sees it in the results.
#include <winnow/executor/simd.hpp>
#include <winnow/filter/candidates.hpp>
#include <winnow/weight/cutoff.hpp>
#include <winnow/window/disk.hpp>
#include "executor/agreement.hpp"
#include "winnow/distance/chessboard.hpp"
#include "winnow/distance/combine.hpp"
#include "winnow/distance/cross_feature.hpp"
#include "winnow/distance/noise_normalized.hpp"
#include "winnow/distance/patch.hpp"
#include "winnow/distance/spatial.hpp"
#include "winnow/distance/squared_difference.hpp"
#include "winnow/estimator/sure.hpp"
#include "winnow/weight/combine.hpp"
#include "winnow/weight/exponential.hpp"
#include "winnow/weight/gaussian.hpp"
#include "winnow/weight/shared.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

/// The places at which shared distances of these weights are evaluated; the first place is 10.
template <class Varied, class... Weights>
std::vector<int> places(const Weights&... weights) {
    const shared_distances<Varied, std::tuple<Weights...>> shared(std::tuple<Weights...>(weights...), 10);
    std::vector<int> all;
    shared.for_each([&](int place, const auto&) { all.push_back(place); });
    return all;
}
using list = std::vector<int>;

auto features(float tau) { return exponential(max(cross(albedo, {.tau = tau}), cross(normal, {.tau = tau}))); }

}  // namespace

TEST_CASE("a distance that two weights have in common is evaluated once, one with other numbers by itself") {
    CHECK(places<void>(features(0.01f), features(0.01f)) == list{10});
    CHECK(places<void>(features(0.01f), features(0.02f)) == list{10, 11});
    CHECK(places<void>(features(0.01f), features(0.02f), features(0.01f)) == list{10, 11});
    CHECK(places<void>(features(0.01f), features(0.02f), features(0.02f)) == list{10, 11});
    CHECK(places<void>(features(0.01f), features(0.02f), features(0.03f)) == list{10, 11, 12});
}

TEST_CASE("what one weight has alone is left in its place") {
    CHECK(places<void>(features(0.01f)).empty());
    CHECK(places<void>(gaussian(l2(albedo), 1), gaussian(l2(normal), 1)).empty());
    CHECK(places<void>(features(0.01f), gaussian(l2(albedo), 1)).empty());
    // Twice in one weight is in common as well.
    CHECK(places<void>(gaussian(l2(albedo), 1) * exponential(l2(albedo))) == list{10});
    // Where the whole is not in common its parts may be.
    CHECK(places<void>(exponential(max(l2(albedo), l2(normal))), gaussian(l2(albedo), 1)) == list{10});
    CHECK(places<void>(exponential(max(l2(albedo), l2(normal))), gaussian(l2(albedo), 1), exponential(l2(normal))) ==
          list{10, 11});
}

TEST_CASE("what changes with the buffer of the derivative, and what costs nothing, is not shared") {
    CHECK(places<void>(exponential(l2(color)), gaussian(l2(color), 1)) == list{10});
    CHECK(places<color_t>(exponential(l2(color)), gaussian(l2(color), 1)).empty());
    CHECK(places<color_t>(exponential(l2(albedo)), gaussian(l2(albedo), 1)) == list{10});
    CHECK(places<color_t>(exponential(max(l2(color), l2(albedo))), gaussian(max(l2(color), l2(albedo)), 1)) ==
          list{10});
    CHECK(places<void>(exponential(spatial), gaussian(spatial, 1)).empty());
}

TEST_CASE("a weight reads each shared distance from where the first of its kind put it") {
    const float tau[] = {0.01f, 0.02f, 0.01f, 0.02f};
    const std::tuple weights(features(tau[0]), features(tau[1]), features(tau[2]) * exponential(l2(depth)),
                             min(features(tau[3]), exponential(l2(depth))));
    const shared_distances<void, std::remove_const_t<decltype(weights)>> shared(weights, 0);
    // Distances of 1, 2, ... by places.
    const float ahead[] = {1, 2, 3, 4, 5, 6};
    const float zeros[64] = {};
    const pixel_pair<double, planes<>> pq(zeros, zeros, {}, 1, 0, {ahead, 1});
    int depth_place = -1;
    shared.for_each([&]<class D>(int place, const D&) {
        if constexpr (std::is_same_v<D, distance::squared_difference<depth_t>>) depth_place = place;
    });
    REQUIRE(depth_place == 3);  // after three of four feature distances; the last is the fifth
    CHECK(std::get<0>(shared.weights())(pq) == Approx(std::exp(-1.0)));
    CHECK(std::get<1>(shared.weights())(pq) == Approx(std::exp(-2.0)));
    CHECK(std::get<2>(shared.weights())(pq) == Approx(std::exp(-1.0 - 4.0)));
    CHECK(std::get<3>(shared.weights())(pq) == Approx(std::exp(-4.0)));
}

namespace {

struct results {
    image<> mean, error, derivative, support;
    explicit results(extent size) : mean(size, 3), error(size, 3), derivative(size, 3), support(size, 1) {}
    output all(bool sure) {
        output out{mean};
        out.support(support.view());
        if (sure) out.error(error.view()).derivative(derivative.view());
        return out;
    }
    std::string other_bits_than(const results& o) const {
        return other_bits(mean, o.mean) + other_bits(error, o.error) + other_bits(derivative, o.derivative) +
               other_bits(support, o.support);
    }
};

/// Together and one by one: the same bits on lanes, or, where a distance that is shared is the term of a sum, which a
/// compiler may fuse with its last product in one place and not in the other, the same but for rounding.  Together on
/// serial in double: the same but for rounding.
template <class Estimator, class Window, class... Weights>
void check_together(bool same_bits, extent size, Window window, border rule, const Weights&... weights) {
    constexpr bool sure = Estimator::needs_derivative;
    constexpr std::size_t count = sizeof...(Weights);
    const buffers in = make_buffers(size);
    const named_layers layers = in.layers();
    const auto run = [&](const auto& executor) {
        std::vector<results> all(count, results(size));
        std::array<output, count> out;
        for (std::size_t i = 0; i < count; ++i) out[i] = all[i].all(sure);
        candidates{filter{weights, window, Estimator{}, rule}...}(layers, out, executor);
        return all;
    };
    const std::vector<results> together = run(executor::simd{.tile = {16, 8}}), exact = run(executor::serial<double>{});
    std::size_t i = 0;
    const auto check = [&](const auto& weight) {
        results alone(size);
        filter{weight, window, Estimator{}, rule}(layers, alone.all(sure), executor::simd{});
        CAPTURE(to_string(size), static_cast<int>(rule), i, sure);
        const double r = rounding_bound({.radius = window.reach(), .patch_radius = 3}), s = largest_magnitude(in.color);
        if (same_bits) CHECK(together[i].other_bits_than(alone) == "");
        else CHECK(beyond(r * s, together[i].mean, alone.mean) == "");
        CHECK(beyond(r * s, together[i].mean, exact[i].mean) == "");
        CHECK(beyond_relative(r, together[i].support, exact[i].support) == "");
        // How far derivatives may be off is tested for each filter by itself; here it is a matter of mixing them up.
        if (sure) {
            CHECK(beyond(0.01, together[i].derivative, exact[i].derivative) == "");
            CHECK(beyond(0.01, together[i].error, exact[i].error) == "");
        }
        ++i;
    };
    (check(weights), ...);
}

template <class Estimator>
void check_mixtures(float tau_first, float tau_second, float tau_third) {
    const auto of_color = [](int radius) { return exponential(patch(noise_normalized(color), {.radius = radius})); };
    for (const border rule : all_borders)
        for (const extent size : {extent{35, 11}, extent{3, 2}}) {
            // As RDFC has them: a patch beside shared features, and features alone.
            check_together<Estimator>(true, size, window::square{.radius = 3}, rule,
                                      min(of_color(1), features(tau_first)), min(of_color(3), features(tau_second)),
                                      features(tau_third));
            // As SBF has them: what depends on the offset alone beside weights that are shared.
            const auto alike = shared(features(tau_first));
            check_together<Estimator>(true, size, window::square{.radius = 3}, rule, gaussian(spatial, 1) * alike,
                                      gaussian(spatial, 2) * cutoff(chessboard, 2) * alike,
                                      shared(features(tau_second)) * cutoff(spatial, 5));
            // Shared distances inside sums and maxima with patches, which take places of their own before them.
            check_together<Estimator>(
                false, size, window::disk{.radius = 3}, rule,
                exponential(patch(l2(albedo), {.radius = 1}) + cross(depth, {.tau = tau_first})) * of_color(1),
                gaussian(max(cross(depth, {.tau = tau_second}), l2(normal)), 0.5f) * cutoff(l2(normal), 0.5f),
                exponential(cross(depth, {.tau = tau_third})) * gaussian(l2(color), 0.5f));
        }
}

}  // namespace

TEST_CASE("candidates with equal and with unequal feature distances give what they give alone") {
    for (const auto& [a, b, c] : {std::tuple{0.05f, 0.05f, 0.05f}, std::tuple{0.05f, 0.05f, 0.2f},
                                  std::tuple{0.2f, 0.05f, 0.2f}, std::tuple{0.05f, 0.1f, 0.2f}})
        check_mixtures<estimator::none>(a, b, c);
}

TEST_CASE("candidates with equal and with unequal feature distances and Stein's estimate give what they give alone") {
    for (const auto& [a, b, c] : {std::tuple{0.05f, 0.05f, 0.05f}, std::tuple{0.05f, 0.05f, 0.2f},
                                  std::tuple{0.2f, 0.05f, 0.2f}, std::tuple{0.05f, 0.1f, 0.2f}})
        check_mixtures<estimator::sure<>>(a, b, c);
}
