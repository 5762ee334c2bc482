// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Where the time of WLR goes, and how far it is from the definition's:  benchmark-wlr [SIDE] [THREADS].
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/wlr_2014.hpp>

#include "support/machine.hpp"
#include "support/scene.hpp"

namespace {

using namespace winnow;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Seconds of the median of five calls, after one that allocates.
template <class Call>
double seconds(const Call& call) {
    std::array<double, 5> times;
    call();
    for (double& t : times) {
        t = now();
        call();
        t = now() - t;
    }
    std::sort(times.begin(), times.end());
    return times[2];
}

/// Operations for each pixel and neighbour, an fma counted as 2, with d coordinates of n regressors; counted by hand.
namespace operations {
double moments(double n) { return n * (n + 1) + 2 * n + 5 * (n - 2) + 4; }
double coordinates(double n, double d) { return 2 * n + 2 * n * d + 18; }
double kernel(double d) { return 4 * d + 1; }
double products(double unknowns) { return unknowns * (unknowns + 1) + unknowns; }
double curvature(double d) { return kernel(d) + d + 6 + 2 * (2 * d + 1) + products(2 * d + 1); }
double trial(double d) { return kernel(d) + products(d + 1) + 2 * d + 16; }
double fit(double n, double d, double values) {
    return coordinates(n, d) + 2 * kernel(d) + products(d + 1) + 2 * d + 8 + 2 * values;
}
}  // namespace operations

}  // namespace

int main(int argc, char** argv) {
    const int side = argc > 1 ? std::atoi(argv[1]) : 1024, threads = argc > 2 ? std::atoi(argv[2]) : 2;
    if (side < 1 || threads < 1) return std::printf("benchmark-wlr [SIDE] [THREADS]\n"), 2;
    const extent size{side, side};
    const paper::wlr wlr;
    constexpr int regressors = paper::wlr_regressors<paper::wlr::features>::count;
    const double pixels = static_cast<double>(size.pixels()), peak = benchmarks::peak_gflops(threads);
    const double neighbours = std::pow(2 * wlr.numbers.radius + 1, 2);

    benchmarks::scene s(size);
    workspace memory;
    const executor::openmp all{.threads = threads};
    const double total = seconds([&] { wlr(s.frame(), s.result, all, memory); });
    std::printf("WLR, radius %d, %d regressors, %dx%d, %d threads: %.3f s, %.2f us per pixel and thread\n",
                wlr.numbers.radius, regressors, side, side, threads, total, total / pixels * threads * 1e6);
    std::printf("peak of fused multiply-adds: %.0f GFLOP/s; memory of the tiles %.1f MB\n", peak,
                static_cast<double>(memory.tiles.size()) * 1e-6);

    // How often each number of coordinates is worked with: an upper and a lower bound of what all this is.
    std::printf("\n| coordinates | operations/pixel | of the peak, if all pixels had them |\n|---|---|---|\n");
    const extent tile = all.inner.tile;
    const double rim = (tile.width + 6.0) * (tile.height + 6.0) / (tile.width * tile.height);  // bandwidths are blurred
    for (const double d : {3.0, 5.0, 7.0, 9.0}) {
        using namespace operations;
        const double eigen = 4 * 36 * (25 + 6 * 9 + 6 * 7) + 36 * 21;  // about four sweeps
        const double choose = neighbours * (moments(regressors) + coordinates(regressors, d) + curvature(d) +
                                            paper::wlr_trials * trial(d) + 9) +
                              eigen;
        const double each = rim * choose + neighbours * fit(regressors, d, 6);
        std::printf("| %.0f | %.0f | %.0f %% |\n", d, each, each * pixels / total * 1e-7 / peak);
    }

    // Parts of the work on one batch of pixels, by themselves.
    {
        using features = paper::wlr::features;
        using planes_of = joined<planes<color_t, variance_of<color_t>>, features,
                                 planes<variance_of<albedo_t>, variance_of<normal_t>, variance_of<depth_t>>>;
        using window = paper::wlr_window<lanes, features, planes_of>;
        const int reach = wlr.numbers.radius, real = static_cast<int>(neighbours), padded = (real + 3) / 4 * 4;
        const pitch step{lanes::size + 2 * reach, (lanes::size + 2 * reach) * std::ptrdiff_t{1 + planes_of::count}};
        std::vector<float> staged(static_cast<std::size_t>(step.row * (2 * reach + 1) + 64));
        for (std::size_t i = 0; i < staged.size(); ++i)
            staged[i] = 0.5f + 0.4f * std::sin(static_cast<float>((i * 7919) % 1000));
        for (int y = 0; y <= 2 * reach; ++y)
            std::fill_n(staged.begin() + y * step.row, step.plane, 1.0f);  // the coverage
        std::vector<paper::wlr_neighbour> offsets;
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) offsets.push_back({dy * step.row + dx, dx, dy});
        offsets.resize(static_cast<std::size_t>(padded), {0, 0, 0});
        scratch_memory work;
        lanes* const reals = reinterpret_cast<lanes*>(work.reserve(window::reals(padded) * sizeof(lanes)));
        window w(wlr.numbers, offsets.data(), real, padded, step, reals);
        const float* const p = staged.data() + reach * step.row + reach;
        constexpr int times = 200;
        const auto of_batch = [&](const char* name, double count, const auto& call) {
            const double each = seconds([&] {
                                    for (int i = 0; i < times; ++i) call();
                                }) /
                                (times * lanes::size);
            std::printf("| %s | %.3f | %.0f | %.0f %% |\n", name, each * 1e6, count,
                        count / each * 1e-7 / (peak / threads));
        };
        auto moments = w.moments(p);
        paper::wlr_subspace<lanes, regressors> subspace(moments, wlr.numbers.least_component);
        std::printf("\n| part, one thread | us per pixel | operations | of the peak |\n|---|---|---|---|\n");
        of_batch("moments of the window", neighbours * operations::moments(regressors),
                 [&] { moments = w.moments(p); });
        of_batch("principal components, four sweeps", 4 * 36 * (25 + 6 * 9 + 6 * 7) + 36 * 21, [&] {
            subspace = {moments, wlr.numbers.least_component};
        });
        of_batch("coordinates",
                 neighbours * operations::coordinates(regressors, batch_of<lanes>::largest(subspace.rank)),
                 [&] { w.gather(p, subspace); });
        of_batch("products of ten unknowns", neighbours * (operations::products(10) + operations::kernel(9)), [&] {
            normal_equations<lanes, 10> a;
            const lanes narrow[9] = {lanes(0.1f), lanes(0.1f), lanes(0.1f), lanes(0.1f), lanes(0.1f),
                                     lanes(0.1f), lanes(0.1f), lanes(0.1f), lanes(0.1f)};
            for (int i = 0; i < padded; i += 4) {
                lanes weights[4];
                for (int n = 0; n < 4; ++n) weights[n] = w.weight<9>(i + n, narrow);
                a.add(weights, w.x(i), regressors + 1);
            }
            moments.pixels = moments.pixels + a.sums.at(9, 9) * lanes(0.0f);
        });
    }

    // The definition, on a small frame: how much slower it is, and that it gives the same.
    const extent little{48, 48};
    benchmarks::scene few(little);
    image<float> slow(little, 3);
    wlr(few.frame(), few.result, all, memory);
    const double begin = now();
    wlr(few.frame(), slow, executor::serial<>{}, memory);
    const double of_serial = (now() - begin) / static_cast<double>(little.pixels());
    double apart = 0;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < little.height; ++y)
            for (int x = 0; x < little.width; ++x)
                apart = std::max(apart, std::abs(double{few.result.at(x, y, c)} - slow.at(x, y, c)));
    std::printf("\nserial: %.1f us per pixel, %.0f times as long; results differ by %.1g at most\n", of_serial * 1e6,
                of_serial * pixels / total, apart);
    return apart < 5e-3 ? 0 : 1;
}
