// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <cstring>
#include <support/catch.hpp>
#include <support/simulated.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

constexpr extent size{23, 17};  // no multiple of a tile
using watched = planes<color_t, variance_of<color_t>, half_a<color_t>, half_b<color_t>, depth_t>;

/// A lamp above a table and, where the effects have it, a ball of glass.
template <class Effects>
auto table() {
    scene<Effects, quad, ellipsoid> s;
    s.camera_at = [](double) { return camera{.eye = {0, -4, 2}, .target = {0, 0, 0.5}, .field_of_view = 40}; };
    s.photons_per_sample = 4;
    s.add(quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}), s.add({.name = "table", .albedo = grey(0.4)}));
    s.add(quad({-1, -1, 3}, {0, 1, 0}, {1, 0, 0}), s.add({.name = "lamp", .emission = grey(9)}));
    if constexpr (Effects::template has<effect::mirror>)
        s.add(sphere({0.2, -0.5, 0.6}, 0.5), s.add({.name = "glass", .ior = 1.5}));
    return world(s);
}
const auto bare_table = table<effects<effect::area_light>>();
const auto with_glass = table<effects<effect::area_light, effect::mirror, effect::caustics>>();

template <class Planes>
bool same(const film<Planes>& a, const film<Planes>& b) {
    return a.raw().size() == b.raw().size() && std::memcmp(a.raw().data(), b.raw().data(), a.raw().size()) == 0;
}

/// From none to 22 samples, in no order; more than one map of photons.
sample_counts uneven(int more = 0) {
    sample_counts n(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) n.at(x, y) = (7 * x + 5 * y + x * y + more) % 23;
    return n;
}

/// Counts what it is asked to run.
struct counting_pool {
    int& runs;

    int size() const { return 2; }
    template <class Task>
    void run(int count, const Task& task) const {
        ++runs;
        executor::fresh_threads{2}.run(count, task);
    }
};

template <class World>
film<watched> rendered(const World& w, const sample_counts& first, const sample_counts& count,
                       render_settings settings = {}, int threads = 2) {
    film<watched> f(size);
    render(w, f, {.first = first, .count = count}, settings, executor::fresh_threads{threads});
    return f;
}

}  // namespace

TEST_CASE("counts that are all the same give the bits of the plain render") {
    const auto check = [](const auto& w) {
        for (const auto& [first, samples] : {std::pair{0, 1}, std::pair{0, 20}, std::pair{3, 20}, std::pair{16, 33}})
            CHECK(
                same(rendered(w, sample_counts(size, first), sample_counts(size, samples), {.samples = 99, .first = 7}),
                     test::rendered<watched>(w, size, {.samples = samples, .first = first})));
    };
    check(bare_table);
    check(with_glass);
}

TEST_CASE("each pixel gets the samples of its numbers, and no others") {
    const sample_counts count = uneven(), first = uneven(11);
    const auto f = rendered(bare_table, first, count);
    const auto images = f.develop();
    REQUIRE(count.fewest() == 0);
    int wrong = 0;
    for (int y = 0; y < size.height; y += 4)
        for (int x = 0; x < size.width; x += 3) {
            if (count.at(x, y) == 0) continue;
            const auto wanted =
                test::rendered<watched>(bare_table, size, {.samples = count.at(x, y), .first = first.at(x, y)})
                    .develop();
            images.for_each([&](auto g, const image<>& i) {
                for (int c = 0; c < i.channels(); ++c)
                    wrong += std::memcmp(&i.at(x, y, c), &wanted[g].at(x, y, c), sizeof(float)) != 0;
            });
        }
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) wrong += f.samples(x, y) + f.rejected(x, y) != count.at(x, y);
    CHECK(wrong == 0);
}

TEST_CASE("a render that goes on where each pixel has stopped is the render in one go, its halves in balance") {
    film<watched> f(size);
    sample_counts had(size);
    for (int k = 0; k < 4; ++k) {
        const sample_counts more = uneven(k);
        render(bare_table, f, {.first = had, .count = more}, {}, executor::fresh_threads{2});
        had += more;
    }
    CHECK(same(f, rendered(bare_table, sample_counts(size), had)));
    // The halves by parity of the number: their means, weighted by their shares of the samples, are the whole.
    const auto images = f.develop();
    int wrong = 0, odd = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int n = had.at(x, y), n_b = n / 2;
            if (n < 2) continue;
            odd += n % 2;
            const double a = images[first_half(color)].at(x, y), b = images[second_half(color)].at(x, y);
            const double mean = (a * (n - n_b) + b * n_b) / n, found = images[color].at(x, y);
            wrong += std::abs(mean - found) > 1e-5 * found;
        }
    CHECK(wrong == 0);
    CHECK(odd > 20);
}

TEST_CASE("the same bits by 1, 2 and 7 threads and tiles of three sizes, photons and all", "[threads]") {
    const auto reference = rendered(with_glass, uneven(5), uneven(), {}, 1);
    for (const int threads : {1, 2, 7})
        for (const int tile : {1, 8, 64})
            CHECK(same(reference, rendered(with_glass, uneven(5), uneven(), {.tile = tile}, threads)));
    CHECK_FALSE(same(reference, rendered(with_glass, uneven(5), uneven(), {.seed = 2})));
}

TEST_CASE("parts of other pixels, rendered apart, merge into the render") {
    sample_counts left = uneven(), right = uneven();
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) (x < 9 ? right : left).at(x, y) = 0;
    const sample_counts none(size);
    film<watched> merged = rendered(bare_table, none, left);
    merged.merge(rendered(bare_table, none, right));
    CHECK(same(merged, rendered(bare_table, none, uneven())));
}

TEST_CASE("the photons that a pixel sees do not depend on what others get") {
    using with_photons = planes<color_t, caustic_t>;
    const sample_counts none(size);
    const auto shown = [&](const sample_counts& first, const sample_counts& count) {
        film<with_photons> f(size);
        render(with_glass, f, {.first = first, .count = count}, {}, executor::fresh_threads{2});
        return f.develop();
    };
    constexpr int x = 18, y = 11;
    const auto together = shown(none, sample_counts(size, 16));
    REQUIRE(together[caustic].at(x, y) > 0);
    // Another pixel wants many more.
    sample_counts more(size, 16);
    more.at(x + 1, y) = 40;
    const auto beside = shown(none, more);
    int other = 0;
    for (int j = 0; j < size.height; ++j)
        for (int i = 0; i < size.width; ++i) other += together[color].at(i, j) != beside[color].at(i, j);
    CHECK(other == 1);
    CHECK(beside[caustic].at(x + 1, y) != together[caustic].at(x + 1, y));
    // Alone, from the first number on and from another.
    for (const int from : {0, 3}) {
        sample_counts one(size), first(size);
        one.at(x, y) = 16, first.at(x, y) = from;
        const auto alone = shown(first, one), all = shown(sample_counts(size, from), sample_counts(size, 16));
        CHECK(alone[color].at(x, y) == all[color].at(x, y));
        CHECK(alone[caustic].at(x, y) == all[caustic].at(x, y));
    }
}

TEST_CASE("numbers that no pixel asks for cost no photons") {
    // One pixel begins with number 0, one with number 1600: a hundred maps would lie between them.
    sample_counts first(size), count(size);
    count.at(2, 2) = 2, first.at(3, 3) = 1600, count.at(3, 3) = 2;
    film<watched> f(size);
    int runs = 0;
    render(with_glass, f, {.first = first, .count = count}, {}, counting_pool{runs});
    CHECK(runs == 2 * (2 + 1));  // the photons of two halves, then the samples
    CHECK(f.samples(2, 2) == 2);
    CHECK(f.samples(3, 3) == 2);
}

TEST_CASE("no samples for anybody are no samples; progress counts those that are asked for") {
    film<watched> f(size);
    render_progress progress;
    render(bare_table, f, {.first = sample_counts(size), .count = sample_counts(size)}, {}, executor::fresh_threads{2},
           progress);
    CHECK(same(f, film<watched>(size)));
    CHECK(progress.done == 0);
    render(bare_table, f, {.first = uneven(), .count = uneven()}, {}, executor::fresh_threads{2}, progress);
    CHECK(progress.done == uneven().total());
}

TEST_CASE("counts that make no sense are refused with their pixel") {
    const sample_counts none(size);
    CHECK_THROWS_WITH(rendered(bare_table, none, sample_counts({17, 23})),
                      "the map of sample counts is 17x23, the film is 23x17");
    CHECK_THROWS_WITH(rendered(bare_table, sample_counts(), none),
                      "the map of sample counts is 0x0, the film is 23x17");
    sample_counts bad(size, 2);
    bad.at(4, 5) = -1;
    CHECK_THROWS_WITH(rendered(bare_table, none, bad), "pixel (4, 5) is to get -1 samples from number 0 on");
    CHECK_THROWS_WITH(rendered(bare_table, bad, none), "pixel (4, 5) is to get 0 samples from number -1 on");
    bad.at(4, 5) = std::numeric_limits<int>::max();
    CHECK_THROWS_AS(rendered(bare_table, sample_counts(size, 1), bad), invalid_input);
    CHECK_THROWS_WITH(rendered(bare_table, none, none, {.tile = 0}), "tiles of 0 pixels: there must be at least one");
}
