// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// winnow beside OpenCV on the same work, in one run: 1024x1024, two threads each.  OpenCV's bilateral filters visit a
/// disk of diameter d, winnow's benchmark a square: `ns/pair` divides by the pixels that each visits.
#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>
#include <opencv2/ximgproc/edge_filter.hpp>
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/guided_2010.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/window/disk.hpp>

#include "support/check.hpp"
#include "support/timed.hpp"

namespace {

using namespace winnow;
constexpr int threads = 2;

benchmarks::scene& scene() {
    static benchmarks::scene s({1024, 1024});
    return s;
}

cv::Mat interleave(const image<float>& from) {
    cv::Mat to(from.size().height, from.size().width, CV_32FC3);
    for (int y = 0; y < to.rows; ++y)
        for (int x = 0; x < to.cols; ++x)
            for (int c = 0; c < 3; ++c) to.at<cv::Vec3f>(y, x)[c] = from.at(x, y, c);
    return to;
}

/// Times a call that visits this many offsets around each pixel.
template <class Call>
void time(benchmark::State& state, long long offsets, const Call& call) {
    const double pairs = static_cast<double>(offsets) * static_cast<double>(scene().color.size().pixels());
    state.counters["ns/pair"] = benchmarks::seconds_each(state, call) / pairs * 1e9;
}

/// Times a winnow filter that visits this many offsets, and checks what it made.
template <class Filter>
void run(benchmark::State& state, const Filter& filter, long long offsets) {
    workspace memory;
    const auto in = scene().frame();
    const output out(scene().result);
    const executor::openmp executor{.threads = threads};
    filter(in, out, executor, memory);
    time(state, offsets, [&] { filter(in, out, executor, memory); });
    if (!(benchmarks::largest_error(filter, halo(filter), scene(), scene().result) < 2e-5))
        state.SkipWithError("the result differs from the definition");
}
template <class Filter>
void run(benchmark::State& state, const Filter& filter) {
    run(state, filter, area(filter.window));
}

/// Times an OpenCV call; what it made must at least be less noisy than what it got.
template <class Call>
void run_opencv(benchmark::State& state, const cv::Mat& noisy, long long offsets, const Call& call) {
    cv::setNumThreads(threads);
    cv::Mat out;
    call(out);
    time(state, offsets, [&] { call(out); });
    cv::Scalar mean, before, after;
    cv::meanStdDev(noisy, mean, before);
    cv::meanStdDev(out, mean, after);
    if (!(after[0] < before[0])) state.SkipWithError("OpenCV's result is not smoother than its input");
}

}  // namespace

int main(int argc, char** argv) {
    const cv::Mat color = interleave(scene().color), albedo_guide = interleave(scene().albedo),
                  normal_guide = interleave(scene().normal);
    cv::Mat color8, gray8;
    color.convertTo(color8, CV_8UC3, 100, 50);
    cv::cvtColor(color8, gray8, cv::COLOR_RGB2GRAY);
    const long long disk21 = area(window::disk{.radius = 10});

    const auto add = [](const char* name, auto f) {
        benchmark::RegisterBenchmark(name, f)->Unit(benchmark::kMillisecond)->UseRealTime();
    };
    const auto guided = gaussian(spatial, 5.0f) * gaussian(l2(albedo), 0.1f);
    add("winnow joint bilateral, square 21x21", [=](benchmark::State& s) {
        run(s, filter{guided, window::square{.radius = 10}});
    });
    add("winnow joint bilateral, disk of diameter 21", [=](benchmark::State& s) {
        run(s, filter{guided, window::disk{.radius = 10}});
    });
    add("OpenCV jointBilateralFilter, d = 21", [&](benchmark::State& s) {
        run_opencv(s, color, disk21,
                   [&](cv::Mat& out) { cv::ximgproc::jointBilateralFilter(albedo_guide, color, out, 21, 0.1, 5.0); });
    });
    add("winnow bilateral, disk of diameter 21", [](benchmark::State& s) {
        run(s, paper::make_bilateral({.sigma_spatial = 5, .sigma_color = 0.3f}).with(window::disk{.radius = 10}));
    });
    add("OpenCV bilateralFilter, d = 21", [&](benchmark::State& s) {
        run_opencv(s, color, disk21, [&](cv::Mat& out) { cv::bilateralFilter(color, out, 21, 0.3, 5.0); });
    });
    add("winnow nlm, RGB float with variances, 21x21, patch 7x7",
        [](benchmark::State& s) { run(s, paper::make_nlm({.patch_radius = 3})); });
    add("OpenCV fastNlMeansDenoising, RGB 8 bit, 21x21, patch 7x7", [&](benchmark::State& s) {
        run_opencv(s, color8, 441, [&](cv::Mat& out) { cv::fastNlMeansDenoising(color8, out, 30, 7, 21); });
    });
    add("OpenCV fastNlMeansDenoising, grey 8 bit, 21x21, patch 7x7", [&](benchmark::State& s) {
        run_opencv(s, gray8, 441, [&](cv::Mat& out) { cv::fastNlMeansDenoising(gray8, out, 30, 7, 21); });
    });
    // Neither visits offsets: their ns/pair are ns per pixel.  OpenCV takes three guides at most, and repeats the edge.
    add("winnow guided, r = 8, normal and depth: four guides",
        [](benchmark::State& s) { run(s, paper::guided{{.radius = 8}}, 1); });
    add("winnow guided, r = 8, normal: three guides",
        [](benchmark::State& s) { run(s, paper::guided_of<planes<normal_t>>{{.radius = 8}}, 1); });
    add("OpenCV guidedFilter, r = 8, three guides", [&](benchmark::State& s) {
        run_opencv(s, color, 1, [&](cv::Mat& out) { cv::ximgproc::guidedFilter(normal_guide, color, out, 8, 1e-3); });
    });
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
