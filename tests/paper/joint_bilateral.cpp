// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/paper/joint_bilateral.hpp>
#include "paper/laws.hpp"

using namespace winnow;
using namespace winnow::test;

// The typedef is the expression.
static_assert(
    std::is_same_v<paper::joint_bilateral,
                   decltype(filter{gaussian(spatial, 3.0f) * gaussian(l2(albedo), 0.1f) * gaussian(l2(normal), 0.2f),
                                   window::square{.radius = 7}})>);
static_assert(
    paper::make_joint_bilateral({.radius = 7, .sigma_spatial = 3, .sigma_albedo = 0.5f, .sigma_normal = 0.25f}) ==
    filter{gaussian(spatial, 3.0f) * gaussian(l2(albedo), 0.5f) * gaussian(l2(normal), 0.25f),
           window::square{.radius = 7}});
static_assert(std::is_same_v<paper::bilateral, decltype(filter{gaussian(spatial, 3.0f) * gaussian(l2(color), 0.1f),
                                                               window::square{.radius = 7}})>);
static_assert(paper::make_bilateral({.radius = 7, .sigma_spatial = 3, .sigma_color = 0.5f}) ==
              filter{gaussian(spatial, 3.0f) * gaussian(l2(color), 0.5f), window::square{.radius = 7}});

namespace {

any_filter joint(paper::joint_bilateral_numbers n) { return erased(paper::make_joint_bilateral(n)); }
any_filter plain(paper::bilateral_numbers n) { return erased(paper::make_bilateral(n)); }
const std::vector<any_filter> both = {joint({.radius = 3}), plain({.radius = 3})};

constexpr extent size{35, 23};
constexpr executor_kind kinds[] = {executor_kind::serial_double, executor_kind::simd};
constexpr float wide = 1e6f;

/// The Gaussian average over the pixels that are alike.
template <class Alike>
image<> gaussian_average(const image<>& u, int radius, double sigma, const Alike& alike) {
    return fill(u.size(), 3, [&](int x, int y, int c) {
        double sum = 0, total = 0;
        for (int j = std::max(0, y - radius); j <= std::min(u.size().height - 1, y + radius); ++j)
            for (int i = std::max(0, x - radius); i <= std::min(u.size().width - 1, x + radius); ++i)
                if (alike(x, y, i, j)) {
                    const double w = std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * sigma * sigma));
                    sum += w * double{u.at(i, j, c)}, total += w;
                }
        return sum / total;
    });
}

}  // namespace

TEST_CASE("bilateral filters: a constant is a fixed point") {
    for (const any_filter& f : both) check_constant(f);
}
TEST_CASE("bilateral filters: no weight exceeds the centre's") {
    for (const any_filter& f : both) check_weights(f, 3);
}
TEST_CASE("bilateral filters: results stay within the values of the window") {
    for (const any_filter& f : both) check_convex(f, 3);
}
TEST_CASE("bilateral filters: flips, transposition and turns commute") {
    for (const any_filter& f : both) check_equivariant(f);
}
TEST_CASE("bilateral filters: the unit of radiance does not matter") {
    check_scaling([](double) { return joint({.radius = 3}); });
    check_scaling([](double a) { return plain({.radius = 3, .sigma_color = static_cast<float>(0.3 * a)}); });
}
TEST_CASE("bilateral filters: neither the identity nor the plain mean") {
    check_useful(joint({.radius = 3, .sigma_albedo = 0.1f, .sigma_normal = 0.2f}), 3);
    check_useful(plain({.radius = 3, .sigma_color = 0.3f}), 3);
}
TEST_CASE("bilateral filters: hazards") {
    for (const any_filter& f : both) check_hazards(f);
}

TEST_CASE("bilateral filters: at sigma 0 the input, bit for bit") {
    const buffers in = make_buffers(size);
    for (const executor_kind kind : kinds) {
        CHECK(other_bits(joint({.radius = 3, .sigma_albedo = 0}).images(in.layers(), size, {kind})[0], in.color) == "");
        CHECK(other_bits(joint({.radius = 3, .sigma_spatial = 0}).images(in.layers(), size, {kind})[0], in.color) ==
              "");
        CHECK(other_bits(plain({.radius = 3, .sigma_color = 0}).images(in.layers(), size, {kind})[0], in.color) == "");
    }
}

TEST_CASE("bilateral filters: at large sigmas the Gaussian average, then the box mean") {
    const buffers in = make_buffers(size);
    const auto all = [](int, int, int, int) { return true; };
    const image<> average = gaussian_average(in.color, 3, 2, all), box = box_mean(in.color, 3);
    for (const executor_kind kind : kinds) {
        const auto check = [&](const any_filter& f, const image<>& expected) {
            CHECK(beyond(2e-6 * largest_magnitude(in.color), f.images(in.layers(), size, {kind})[0], expected) == "");
        };
        check(joint({.radius = 3, .sigma_spatial = 2, .sigma_albedo = wide, .sigma_normal = wide}), average);
        check(plain({.radius = 3, .sigma_spatial = 2, .sigma_color = wide}), average);
        check(joint({.radius = 3, .sigma_spatial = wide, .sigma_albedo = wide, .sigma_normal = wide}), box);
        check(plain({.radius = 3, .sigma_spatial = wide, .sigma_color = wide}), box);
    }
}

TEST_CASE("joint bilateral: with a segmentation as feature, the Gaussian average of each segment") {
    buffers in = make_buffers(size);
    const auto segment = [](int x, int y) { return (x / 5 + y / 4) % 2; };
    in.albedo = fill(size, 3, [&](int x, int y, int) { return segment(x, y); });
    const image<> expected = gaussian_average(
        in.color, 4, 2, [&](int px, int py, int qx, int qy) { return segment(px, py) == segment(qx, qy); });
    for (const float sigma : {0.0f, 0.05f})
        for (const executor_kind kind : kinds) {
            const auto f = joint({.radius = 4, .sigma_spatial = 2, .sigma_albedo = sigma, .sigma_normal = wide});
            CHECK(beyond(2e-6 * largest_magnitude(in.color), f.images(in.layers(), size, {kind})[0], expected) == "");
        }
}
