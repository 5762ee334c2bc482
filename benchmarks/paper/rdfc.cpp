// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Where the time of RDFC goes, stage by stage:  benchmark-rdfc [SIDE] [THREADS].
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/rdfc_2013.hpp>

#include "support/counted.hpp"
#include "support/machine.hpp"

namespace {

using namespace winnow;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// An executor that remembers when each of its passes began and ended.
struct watched {
    using role = role::executor;
    struct pass {
        double begin, end;
    };

    executor::openmp inner;
    std::vector<pass>* passes;

    auto kernel() const { return inner.kernel(); }
    int workers() const { return inner.workers(); }
    template <class Work>
    void dispatch(int count, const Work& work) const {
        const double begin = now();
        inner.dispatch(count, work);
        passes->push_back({begin, now()});
    }
};

/// A buffer with halves and variance.
struct noisy {
    image<float> mean, half_a, half_b, variance;

    template <class Truth>
    noisy(extent size, int channels, float noise, const Truth& truth)
        : mean(size, channels), half_a(size, channels), half_b(size, channels), variance(size, channels) {
        std::mt19937 random(1);
        std::normal_distribution<float> normal;
        for (int c = 0; c < channels; ++c)
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const float sigma = noise * (0.5f + 0.5f * static_cast<float>((x + 2 * y + c) % 7) / 7);
                    half_a.at(x, y, c) = truth(x, y, c) + 1.414f * sigma * normal(random);
                    half_b.at(x, y, c) = truth(x, y, c) + 1.414f * sigma * normal(random);
                    mean.at(x, y, c) = (half_a.at(x, y, c) + half_b.at(x, y, c)) / 2;
                    variance.at(x, y, c) = sigma * sigma;
                }
    }
    template <guide G>
    void bind(named_layers& to, G) const {
        to.bind(G::name(), mean.view());
        to.bind(G::name() + ".halfA", half_a.view());
        to.bind(G::name() + ".halfB", half_b.view());
        to.bind(G::name() + ".variance", variance.view());
    }
};

struct scene {
    noisy c, a, n, d, v;

    explicit scene(extent size)
        : c(size, 3, 0.3f, [](int x, int y, int) { return (x / 40 + y / 30) % 2 ? 0.8f : 0.3f; }),
          a(size, 3, 0.02f, [](int x, int y, int) { return (x / 40 + y / 30) % 2 ? 0.8f : 0.3f; }),
          n(size, 3, 0.02f, [](int x, int, int i) { return 0.5f + 0.2f * static_cast<float>((x / 64 + i) % 3); }),
          d(size, 1, 0.01f,
            [w = size.width](int x, int, int) { return static_cast<float>(x) / static_cast<float>(w); }),
          v(size, 1, 0.1f, [](int x, int, int) { return (x / 100) % 2 ? 1.0f : 0.0f; }) {}
    named_layers frame() const {
        named_layers f;
        c.bind(f, color), a.bind(f, albedo), n.bind(f, normal), d.bind(f, depth), v.bind(f, visibility);
        return f;
    }
};

/// Everything that RDFC can be asked for.
struct results {
    image<float> mean, half_a, half_b, error, selection;

    explicit results(extent size)
        : mean(size, 3), half_a(size, 3), half_b(size, 3), error(size, 3), selection(size, 3) {}
    output all() { return output(mean).halves(half_a.view(), half_b.view()).error(error.view()); }
};

constexpr int input_planes = 11 * 4;  // colour, albedo, normal, depth, visibility: mean, halves, variance

}  // namespace

int main(int argc, char** argv) {
    const int side = argc > 1 ? std::atoi(argv[1]) : 1024, threads = argc > 2 ? std::atoi(argv[2]) : 2;
    if (side < 1 || threads < 1) return std::printf("benchmark-rdfc [SIDE] [THREADS]\n"), 2;
    const extent size{side, side};
    const paper::rdfc rdfc;
    const double pixels = static_cast<double>(size.pixels());

    const scene s(size);
    const named_layers in = s.frame();
    results out(size);
    workspace memory;
    std::vector<watched::pass> passes;
    const watched executor{{.threads = threads}, &passes};
    struct run {
        double begin, end;
        std::vector<watched::pass> passes;
    };
    std::vector<run> runs;
    for (int i = 0; i < 6; ++i) {
        passes.clear();
        const double begin = now();
        rdfc(in, out.all(), executor, memory, out.selection.view());
        if (i > 0) runs.push_back({begin, now(), passes});  // the first one allocates
    }
    std::sort(runs.begin(), runs.end(), [](const run& x, const run& y) { return x.end - x.begin < y.end - y.begin; });
    const run& median = runs[runs.size() / 2];
    const double total = median.end - median.begin;

    // Passes in their order; between two passes the variances are scaled.
    struct stage {
        const char* name;
        std::size_t passes;
        double operations;  ///< per pixel, of its large sweep
    };
    const auto by_name = [](const auto& filter, int values) {
        return benchmarks::operations_per_pair(filter, values) * static_cast<double>(area(filter.window));
    };
    const auto three = candidates{rdfc.first(), rdfc.second(), rdfc.third()};
    const double sweep = benchmarks::operations_of_sweep(three.as_sweep(), 9);
    const double offsets = static_cast<double>(area(rdfc.first().window));
    const std::vector<stage> stages = {
        {"albedo: prefilter, residual variance", 3, by_name(rdfc.cleaning().feature_filter(albedo), 9)},
        {"normal: the same", 3, by_name(rdfc.cleaning().feature_filter(normal), 9)},
        {"depth: the same", 3, by_name(rdfc.cleaning().feature_filter(depth), 3)},
        {"visibility: the same", 3, by_name(rdfc.cleaning().feature_filter(visibility), 3)},
        {"candidates, with derivatives", 1, sweep * offsets},
        {"errors, selection maps", 5, by_name(rdfc.smoothing(5), 3) + by_name(rdfc.smoothing(1), 3)},
        {"averages, estimates", 6, 0},
        {"residual variance, second pass", 3, by_name(rdfc.last(), 9)},
    };
    const double peak = benchmarks::peak_gflops(threads);
    std::printf("RDFC, radius 10, 8 feature planes, all halves, %dx%d, %d threads: %.3f s (%.3f to %.3f in %zu runs)\n",
                side, side, threads, total, runs.front().end - runs.front().begin, runs.back().end - runs.back().begin,
                runs.size());
    std::printf(
        "peak of fused multiply-adds: %.0f GFLOP/s\n\n| stage | s | share | operations/pixel | of the peak |\n"
        "|---|---|---|---|---|\n",
        peak);
    std::size_t at = 0;
    double passing = 0;
    for (const stage& g : stages) {
        double seconds = 0;
        for (std::size_t i = 0; i < g.passes && at < median.passes.size(); ++i, ++at)
            seconds += median.passes[at].end - median.passes[at].begin;
        passing += seconds;
        std::printf("| %s | %.3f | %.1f %% |", g.name, seconds, 100 * seconds / total);
        if (g.operations > 0)
            std::printf(" %.0f | %.0f %% |\n", g.operations, g.operations * pixels / seconds * 1e-7 / peak);
        else std::printf(" | |\n");
    }
    std::printf("| variances scaled to halves, one thread | %.3f | %.1f %% | | |\n\n", total - passing,
                100 * (total - passing) / total);
    if (at != median.passes.size()) std::printf("the stages have changed: %zu passes\n", median.passes.size());
    std::printf("candidates: %.0f operations and %.2f ns per pixel and offset\n", sweep,
                (median.passes[12].end - median.passes[12].begin) / pixels / offsets * 1e9);
    std::printf("memory: input %.0f MB, images between passes %.0f MB, tiles %.1f MB\n",
                input_planes * 4 * pixels * 1e-6, static_cast<double>(memory.images.size()) * 1e-6,
                static_cast<double>(memory.tiles.size()) * 1e-6);

    // The definition, on a small frame: how much slower it is, and that it gives the same.
    const extent little{48, 48};
    const scene few(little);
    results fast(little), slow(little);
    rdfc(few.frame(), fast.all(), executor::openmp{.threads = threads}, memory);
    const double begin = now();
    rdfc(few.frame(), slow.all(), executor::serial<>{}, memory);
    const double of_serial = (now() - begin) / static_cast<double>(little.pixels());
    double apart = 0;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < little.height; ++y)
            for (int x = 0; x < little.width; ++x)
                apart = std::max(apart, std::abs(double{fast.mean.at(x, y, c)} - slow.mean.at(x, y, c)));
    std::printf("serial: %.1f us per pixel, %.0f times as long; results differ by %.1g at most\n", of_serial * 1e6,
                of_serial * pixels / total, apart);
    return apart < 1e-3 && at == median.passes.size() ? 0 : 1;
}
