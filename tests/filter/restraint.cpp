// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <limits>
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <support/statistics.hpp>
#include <winnow/filter/restraint.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

/// A buffer with its halves, and what a filter made of them.
struct before_and_after {
    image<> g, a, b, mean, half_a, half_b;

    void restrain(float sigma = 2) {
        workspace memory;
        const executor::serial<> serial;
        const pass_runner passes(serial, memory);
        winnow::restrain(passes, g.view(), a.view(), b.view(), mean.view(), half_a.view(), half_b.view(), sigma,
                         scratch_images(memory.images, g.size(), 4));
    }
};

image<> constant(extent size, double value) {
    return fill(size, 3, [&](int, int, int c) { return value + c; });
}

}  // namespace

TEST_CASE("the share of the filtered, by hand") {
    const extent size{9, 7};
    // The halves are .4 apart, of which the filter leaves .1, and it has moved the mean by .5:
    // .4 (.4 - .1) / 4 = .03 of variance gained, .25 of change.
    before_and_after x{constant(size, 1),   constant(size, 1.2),  constant(size, 0.8),
                       constant(size, 1.5), constant(size, 1.55), constant(size, 1.45)};
    x.restrain();
    const double share = 0.03 / 0.25;
    CHECK(beyond(1e-6, x.mean, constant(size, 1 + share * 0.5)) == "");
    CHECK(beyond(1e-6, x.half_a, constant(size, 1.2 + share * 0.35)) == "");
    CHECK(beyond(1e-6, x.half_b, constant(size, 0.8 + share * 0.65)) == "");
    // More is gained than changed: all of it is kept.
    before_and_after y{constant(size, 1),   constant(size, 1.2),  constant(size, 0.8),
                       constant(size, 1.1), constant(size, 1.12), constant(size, 1.08)};
    const image<> kept = y.mean;
    y.restrain();
    CHECK(beyond(0, y.mean, kept) == "");
}

TEST_CASE("without noise, or where a filter adds some, everything is as before") {
    const extent size{15, 12};
    const image<> g = fill(size, 3, structure), blurred = constant(size, 0.5);
    before_and_after x{g, g, g, blurred, blurred, blurred};
    x.restrain();
    CHECK(beyond(0, x.mean, g) == "");
    CHECK(beyond(0, x.half_a, g) == "");
    before_and_after louder{constant(size, 1), constant(size, 1.1), constant(size, 0.9),
                            constant(size, 2), constant(size, 2.3), constant(size, 1.7)};
    louder.restrain();
    CHECK(beyond(0, louder.mean, constant(size, 1)) == "");
}

TEST_CASE("a filter that blurs an edge is kept where it is flat; the error is less than with or without it") {
    const extent size{64, 48};
    const auto truth = [](int x, int y, int c) { return (x < 32 ? 0.2 : 0.8) + 0.05 * c + 0.001 * y; };
    statistic of_input, of_filtered, of_result;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto noisy = [&](std::uint64_t stream) {
            return fill(size, 3, [&](int x, int y, int c) {
                return truth(x, y, c) + 0.1 * normal_deviate(2 * seed + stream, x, y, c);
            });
        };
        const image<> a = noisy(0), b = noisy(1);
        const auto mean_of = [&](const image<>& p, const image<>& q) {
            return fill(size, 3, [&](int x, int y, int c) { return (p.at(x, y, c) + q.at(x, y, c)) / 2; });
        };
        const auto blurred = [&](const image<>& i) {
            image<> to(size, 3);
            scratch_memory memory;
            gaussian_blur(i.view(), to.view(), 2.0f, executor::serial<>{}, memory);
            return to;
        };
        before_and_after x{mean_of(a, b), a, b, {}, blurred(a), blurred(b)};
        x.mean = mean_of(x.half_a, x.half_b);
        const auto error = [&](const image<>& i) {
            double sum = 0;
            for (int c = 0; c < 3; ++c)
                for (int y = 0; y < size.height; ++y)
                    for (int u = 0; u < size.width; ++u) {
                        const double d = i.at(u, y, c) - truth(u, y, c);
                        sum += d * d;
                    }
            return sum / (3.0 * static_cast<double>(size.pixels()));
        };
        of_input.add(error(x.g));
        of_filtered.add(error(x.mean));
        x.restrain(3);
        of_result.add(error(x.mean));
    }
    CAPTURE(of_input, of_filtered, of_result);
    CHECK(of_result.mean < of_input.mean - 4 * of_input.standard_error());
    CHECK(of_result.mean < of_filtered.mean - 4 * of_filtered.standard_error());
}

TEST_CASE("bad pixels are contained") {
    const extent size{17, 11};
    before_and_after x{constant(size, 1),   constant(size, 1.2),  constant(size, 0.8),
                       constant(size, 1.5), constant(size, 1.55), constant(size, 1.45)};
    const image<> expected = [&] {
        before_and_after y = x;
        y.restrain();
        return y.mean;
    }();
    x.g.at(8, 5, 1) = std::numeric_limits<float>::quiet_NaN();
    x.a.at(3, 3, 0) = std::numeric_limits<float>::infinity();
    x.restrain();
    CHECK(beyond(1e-6, x.mean, expected) == "");
}
