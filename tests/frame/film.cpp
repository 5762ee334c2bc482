// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/film.hpp>

#include <limits>
#include <support/catch.hpp>
#include <support/folder.hpp>
#include <support/patterns.hpp>
#include <thread>
#include <winnow/estimator/residual_variance.hpp>
#include <winnow/frame/path_guides.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/paper/rdfc_2013.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

/// All statistics of a colour and of a depth, and the spread of a point.
using statistics = planes<color_t, variance_of<color_t>, half_a<color_t>, half_b<color_t>, variance_of<half_a<color_t>>,
                          variance_of<half_b<color_t>>, depth_t, variance_of<depth_t>, covariance_of<position_t>,
                          position_t, variance_of<position_t>, half_a<position_t>, half_b<position_t>, normal_t>;
using given = planes<color_t, depth_t, position_t, normal_t>;
using full_film = film<statistics>;

enum class data { plain, bright, heavy };

/// Channel c of sample i of a pixel: standard normal; the same upon a million; or now and then ten thousand times it.
float value(data kind, int x, int y, int i, int c) {
    const double noise = normal_deviate(static_cast<std::uint64_t>(i) + 7, x, y, c);
    if (kind == data::bright) return static_cast<float>(1e6 + noise);
    if (kind == data::heavy) return static_cast<float>(noise * (uniform(999, x, y, i) < 0.05 ? 1e4 : 1));
    return static_cast<float>(noise);
}
sample<given> make(data kind, int x, int y, int i) {
    sample<given> s;
    for (int c = 0; c < given::count; ++c) s.values[c] = value(kind, x, y, i, c);
    return s;
}

/// The sum of (u - mean u) (v - mean v) in two passes, and the mean of u.
struct two_pass {
    double n = 0, mean = 0, squares = 0;

    template <class U, class V>
    two_pass(int count, int step, int start, const U& u, const V& v) {
        double mean_v = 0;
        for (int i = start; i < count; i += step) mean += u(i), mean_v += v(i), ++n;
        if (n == 0) return;
        mean /= n, mean_v /= n;
        for (int i = start; i < count; i += step) squares += (u(i) - mean) * (v(i) - mean_v);
    }
};

template <class Planes>
std::string other_bits(const developed<Planes>& a, const developed<Planes>& b) {
    std::string all;
    a.for_each([&](auto g, const image<float>& plane) {
        const std::string here = test::other_bits(plane, b[g]);
        if (!here.empty()) all += g.name() + ": " + here + "\n";
    });
    return all;
}

bool same_bits(const std::span<const std::byte>& a, const std::span<const std::byte>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size()) == 0;
}

full_film filled(extent size, int spp, data kind = data::plain) {
    full_film f(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < spp; ++i) f.add(x, y, i, make(kind, x, y, i));
    return f;
}

template <class... G>
constexpr std::size_t bytes_for = film<planes<G...>>::pixel_bytes;

}  // namespace

// Two numbers count the samples, those of each half one more; beyond that, exactly what is named.
static_assert(bytes_for<color_t> == 8 + 4 * 3);
static_assert(bytes_for<color_t, albedo_t, depth_t> == 8 + 4 * 7);
static_assert(bytes_for<color_t, variance_of<color_t>> == 8 + 4 * 6);
static_assert(bytes_for<variance_of<color_t>> == 8 + 4 * 6);
static_assert(bytes_for<color_t, half_a<color_t>, half_b<color_t>> == 12 + 4 * 6);
static_assert(bytes_for<half_a<color_t>> == 12 + 4 * 6);
static_assert(bytes_for<color_t, variance_of<color_t>, half_a<color_t>, half_b<color_t>> == 12 + 4 * 12);
static_assert(bytes_for<variance_of<half_a<normal_t>>> == 12 + 4 * 12);
static_assert(bytes_for<half_a<color_t>, albedo_t, variance_of<depth_t>> == 12 + 4 * (6 + 3 + 2));
static_assert(bytes_for<covariance_of<position_t>> == 8 + 8 * 9);
static_assert(bytes_for<position_t, variance_of<position_t>, covariance_of<position_t>> == 8 + 8 * 9);
// The squares of a covariance are on its diagonal; the doubles make the pixel a multiple of eight bytes.
static_assert(bytes_for<half_a<position_t>, variance_of<position_t>, covariance_of<position_t>> == 12 + 4 * 6 + 72 + 4);
static_assert(bytes_for<depth_t, gradient_of<depth_t>, depth_t> == 8 + 4);
static_assert(std::is_same_v<film<planes<depth_t, gradient_of<depth_t>, depth_t>>::planes, planes<depth_t>>);
static_assert(std::is_same_v<film<planes<variance_of<half_b<normal_t>>, color_t>>::inputs, planes<normal_t, color_t>>);

TEST_CASE("samples worked by hand") {
    film<planes<depth_t, variance_of<depth_t>, half_a<depth_t>, half_b<depth_t>, variance_of<half_a<depth_t>>,
                variance_of<half_b<depth_t>>, roughness_t, variance_of<roughness_t>, covariance_of<motion_vector_t>>>
        f({5, 1});
    const float values[] = {1, 2, 4, 9};
    // Pixel x has x samples.
    for (int x = 0; x < 5; ++x)
        for (int i = 0; i < x; ++i) {
            const float v[2] = {values[i], -2 * values[i]};
            f.add(x, 0, i, depth = values[i], roughness = 10 + values[i], motion_vector = v);
        }
    const auto images = f.develop();
    const auto at = [&](auto g, int x, int c = 0) { return images[g].at(x, 0, c); };
    for (int x = 0; x < 5; ++x) CHECK(f.samples(x, 0) == x);

    // None.
    images.for_each([](auto g, const image<float>& plane) {
        INFO(g.name());
        CHECK(std::isnan(plane.at(0, 0)));
    });
    // 1
    CHECK(at(depth, 1) == 1);
    CHECK(at(first_half(depth), 1) == 1);
    CHECK(std::isnan(at(second_half(depth), 1)));
    CHECK(std::isnan(at(variance(depth), 1)));
    CHECK(std::isnan(at(variance(roughness), 1)));
    CHECK(at(covariance(motion_vector), 1) == 0);
    // 1, 2: squares 1/2
    CHECK(at(depth, 2) == 1.5f);
    CHECK(at(second_half(depth), 2) == 2);
    CHECK(at(variance(depth), 2) == 0.25f);
    CHECK(at(variance(roughness), 2) == 0.25f);
    CHECK(at(covariance(motion_vector), 2) == 0.25f);
    CHECK(std::isnan(at(variance(first_half(depth)), 2)));
    // 1, 2, 4: mean 7/3, squares 14/3
    CHECK(std::abs(at(depth, 3) - 7.0f / 3) < 1e-6f);
    CHECK(std::abs(at(variance(depth), 3) - 7.0f / 9) < 1e-6f);
    CHECK(std::abs(at(variance(roughness), 3) - 7.0f / 9) < 1e-5f);
    CHECK(at(variance(first_half(depth)), 3) == 2.25f);
    // 1, 2, 4, 9: mean 4, squares 38; halves 1, 4 and 2, 9
    CHECK(at(depth, 4) == 4);
    CHECK(at(roughness, 4) == 14);
    CHECK(std::abs(at(variance(depth), 4) - 38.0f / 12) < 1e-6f);
    CHECK(at(first_half(depth), 4) == 2.5f);
    CHECK(at(second_half(depth), 4) == 5.5f);
    CHECK(at(variance(first_half(depth)), 4) == 2.25f);
    CHECK(at(variance(second_half(depth)), 4) == 12.25f);
    CHECK(std::abs(at(covariance(motion_vector), 4, 0) - 9.5f) < 1e-6f);
    CHECK(std::abs(at(covariance(motion_vector), 4, 1) + 19.0f) < 1e-5f);
    CHECK(std::abs(at(covariance(motion_vector), 4, 2) - 38.0f) < 1e-5f);
}

TEST_CASE("every statistic is that of two passes in double, far from zero and with outliers as well") {
    for (const data kind : {data::plain, data::bright, data::heavy})
        for (const int n : {1, 2, 3, 5, 16, 63, 256}) {
            INFO("kind " << static_cast<int>(kind) << ", " << n << " samples");
            const auto images = filled({4, 3}, n, kind).develop();
            const double scale = kind == data::bright ? 1e6 : kind == data::heavy ? 1e4 : 1;
            double mean_error = 0, squares_error = 0, all_squares = 0, covariance_error = 0;
            int mistaken = 0;
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 4; ++x) {
                    const auto of = [&](int c) { return [=](int i) { return double{value(kind, x, y, i, c)}; }; };
                    const auto check = [&](auto mean, auto noise, int first, int step, int start) {
                        for (int c = 0; c < mean.channels; ++c) {
                            const two_pass expected(n, step, start, of(first + c), of(first + c));
                            mistaken += std::isnan(images[mean].at(x, y, c)) != (expected.n < 1);
                            mistaken += std::isnan(images[noise].at(x, y, c)) != (expected.n < 2);
                            if (expected.n < 1) continue;
                            mean_error = std::max(mean_error, std::abs(images[mean].at(x, y, c) - expected.mean));
                            if (expected.n < 2) continue;
                            const double squares = images[noise].at(x, y, c) * expected.n * (expected.n - 1);
                            squares_error += std::abs(squares - expected.squares);
                            all_squares += expected.squares;
                        }
                    };
                    check(color, variance(color), 0, 1, 0);
                    check(first_half(color), variance(first_half(color)), 0, 2, 0);
                    check(second_half(color), variance(second_half(color)), 0, 2, 1);
                    check(depth, variance(depth), 3, 1, 0);
                    check(position, variance(position), 4, 1, 0);
                    for (int i = 0, slot = 0; i < 3; ++i)
                        for (int j = i; j < 3; ++j, ++slot) {
                            const double spread = two_pass(n, 1, 0, of(4 + i), of(4 + i)).squares +
                                                  two_pass(n, 1, 0, of(4 + j), of(4 + j)).squares;
                            const double error = double{images[covariance(position)].at(x, y, slot)} * n -
                                                 two_pass(n, 1, 0, of(4 + i), of(4 + j)).squares;
                            if (n > 1) covariance_error = std::max(covariance_error, std::abs(error) / spread);
                        }
                    for (int c = 0; c < 3; ++c) {
                        const double a = two_pass(n, 2, 0, of(4 + c), of(4 + c)).mean;
                        const double m = two_pass(n, 1, 0, of(7 + c), of(7 + c)).mean;
                        mean_error = std::max({mean_error, std::abs(images[first_half(position)].at(x, y, c) - a),
                                               std::abs(images[normal].at(x, y, c) - m)});
                    }
                }
            CHECK(mistaken == 0);
            CHECK(mean_error < 4e-7 * scale);
            // A mean of a million is a multiple of 1/16: that much of the noise is not known.
            CHECK(squares_error <= (kind == data::bright ? 0.06 : 2e-6) * all_squares);
            CHECK(covariance_error < 1e-6);
        }
}

TEST_CASE("the difference of large squares, which a film must not take, fails on such data") {
    float sum = 0, squares = 0;
    for (int i = 0; i < 256; ++i) {
        const float v = value(data::bright, 0, 0, i, 0);
        sum += v, squares += v * v;
    }
    CHECK(std::abs((squares - sum * sum / 256) / 256 - 1) > 0.5f);
}

TEST_CASE("one half alone has all the samples") {
    full_film f({1, 1});
    for (int i = 0; i < 8; i += 2) f.add(0, 0, i, make(data::plain, 0, 0, i));
    const auto images = f.develop();
    CHECK(images[color].at(0, 0) == images[first_half(color)].at(0, 0));
    CHECK(images[variance(color)].at(0, 0, 2) == images[variance(first_half(color))].at(0, 0, 2));
    CHECK(std::isnan(images[second_half(color)].at(0, 0)));
    CHECK(std::isnan(images[variance(second_half(color))].at(0, 0)));
    CHECK(f.samples(0, 0) == 4);
}

TEST_CASE("the covariance of points on a slanted plane knows their normal, a thousand units away") {
    film<planes<covariance_of<position_t>>> f({1, 1});
    for (int i = 0; i < 500; ++i) {
        const double u = uniform(1, i, 0), v = uniform(2, i, 0);
        const double p[3] = {1000 + u, -500 + v, 800 + u + 2 * v};  // x + 2 y - z is constant
        f.add(0, 0, i, position = p);
    }
    const auto images = f.develop();
    const auto c = [&](int i) { return double{images[covariance(position)].at(0, 0, i)}; };
    const double along = c(0) + 4 * c(3) + c(5) + 4 * c(1) - 2 * c(2) - 4 * c(4);  // n C n with n = (1, 2, -1)
    CHECK(c(0) > 0.05);
    CHECK(std::abs(along) < 1e-6);
}

TEST_CASE("points of the world are relative to the origin before they become float") {
    const std::array<double, 3> camera = {1e8, -3e8, 5e7};
    film<planes<position_t, rest_position_t, normal_t>> f({1, 1}, camera);
    const double p[3] = {1e8 + 0.001, -3e8 + 2, 5e7 - 0.5}, n[3] = {0, 0.25, 1};
    f.add(0, 0, 0, position = p, rest_position = p, normal = n);
    const auto images = f.develop();
    CHECK(std::abs(images[position].at(0, 0, 0) - 0.001) < 1e-8 + 1.5e-8);  // of a double at 1e8
    CHECK(images[position].at(0, 0, 1) == 2);
    CHECK(images[rest_position].at(0, 0, 2) == -0.5f);
    CHECK(images[normal].at(0, 0, 1) == 0.25f);
    CHECK(f.origin() == camera);
    // A sample has them relative already.
    sample<planes<position_t, rest_position_t, normal_t>> s;
    s.at(position, 1) = 4;
    f.add(0, 0, 1, s);
    CHECK(f.develop()[position].at(0, 0, 1) == 3);
}

TEST_CASE("values are added by name, as the renderer holds them, and more of them than are kept") {
    film<planes<color_t, depth_t>> named({2, 1}), whole({2, 1});
    const std::array<double, 3> radiance = {0.1, 0.2, 0.3};
    const winnow::half n[3] = {winnow::half(0), winnow::half(0), winnow::half(1)};
    named.add(1, 0, 0, depth = 7, normal = n, color = radiance);
    sample<given> s;
    for (int c = 0; c < 3; ++c) s.at(color, c) = static_cast<float>(radiance[c]);
    s.at(depth) = 7;
    whole.add(1, 0, 0, s);
    CHECK(same_bits(named.raw(), whole.raw()));
    named.add(0, 0, 0, color = 0.5f, depth = 1);  // grey
    CHECK(named.develop()[color].at(0, 0, 2) == 0.5f);
}

TEST_CASE("a sample with a value that is no finite float is absent, and is counted") {
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity()};
    full_film clean({2, 1}), f({2, 1});
    for (int i = 0; i < 9; ++i) {
        sample<given> s = make(data::plain, 1, 0, i);
        if (i % 3 == 0) s.values[i] = bad[i / 3];
        f.add(1, 0, i, s);
        if (i % 3 != 0) clean.add(1, 0, i, s);
    }
    CHECK(f.samples(1, 0) == 6);
    CHECK(f.rejected(1, 0) == 3);
    CHECK(f.rejected(0, 0) == 0);
    CHECK(f.rejected() == 3);
    CHECK(other_bits(f.develop(), clean.develop()) == "");
    film<planes<color_t>> narrow({1, 1});
    narrow.add(0, 0, 0, color = 1e300);                  // no finite float
    narrow.add(0, 0, 1, color = 1.0f, normal = bad[0]);  // not looked at
    narrow.add(0, 0, 2, color = 3.0f, depth = -1e300);
    CHECK(narrow.rejected() == 1);
    CHECK(narrow.develop()[color].at(0, 0) == 2);
    full_film more({2, 1});
    more.merge(f);
    more.merge(f);
    CHECK(more.rejected() == 6);
}

TEST_CASE("films of parts of the samples, merged, are the film of all") {
    const extent size{5, 4};
    for (const data kind : {data::plain, data::bright, data::heavy}) {
        full_film all(size), parts[3] = {full_film(size), full_film(size), full_film(size)};
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                for (int i = 0; i < 40; ++i) {
                    all.add(x, y, i, make(kind, x, y, i));
                    parts[i < 11 ? 0 : i < 12 ? 1 : 2].add(x, y, i, make(kind, x, y, i));
                }
        full_film merged(size);
        for (const full_film& part : parts) merged.merge(part);
        const auto expected = all.develop(), found = merged.develop();
        expected.for_each([&](auto g, const image<float>& plane) {
            INFO(g.name() << " " << static_cast<int>(kind));
            const double largest = largest_magnitude(plane);
            if (kind != data::bright) {
                CHECK(beyond(1e-6 * largest, plane, found[g]) == "");
            } else if (largest > 1e5) {
                CHECK(beyond(3e-7 * largest, plane, found[g]) == "");
            } else {
                CHECK(beyond(0.1 * largest, plane, found[g]) == "");
            }
        });
        CHECK(merged.samples(2, 2) == 40);
    }
}

TEST_CASE("the order of two films that are merged does not matter to the bit") {
    const extent size{7, 5};
    for (const data kind : {data::plain, data::bright, data::heavy}) {
        full_film a(size), b(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                // Some pixels have nothing in one or both, some as many in both, some in one half only.
                for (int i = 0; i < x; ++i) a.add(x, y, i, make(kind, x, y, i));
                for (int i = 0; i < 2 * y; i += x % 2 + 1) b.add(x, y, i, make(kind, x, y, 100 + i));
            }
        full_film ab = a, ba = b;
        ab.merge(b);
        ba.merge(a);
        CHECK(same_bits(ab.raw(), ba.raw()));
        full_film empty(size);
        empty.merge(a);
        CHECK(same_bits(empty.raw(), a.raw()));
        empty = a;
        empty.merge(full_film(size));
        CHECK(same_bits(empty.raw(), a.raw()));
        CHECK_FALSE(same_bits(ab.raw(), a.raw()));
    }
}

TEST_CASE("a film merged with itself has every sample twice") {
    full_film f = filled({3, 2}, 5);
    const auto once = f.develop();
    f.merge(f);
    const auto twice = f.develop();
    CHECK(f.samples(1, 1) == 10);
    CHECK(test::other_bits(once[color], twice[color]) == "");
    CHECK(test::other_bits(once[normal], twice[normal]) == "");
    // Squares double, and n (n - 1) becomes 10 x 9 after 5 x 4.
    CHECK(std::abs(twice[variance(depth)].at(2, 1) / once[variance(depth)].at(2, 1) - 4.0f / 9) < 1e-6f);
}

TEST_CASE("tiles, threads and the order of pixels change no bit") {
    const extent size{23, 17};
    const full_film whole = filled(size, 6);
    full_film tiled(size);
    for (int y0 = 0; y0 < size.height; y0 += 5)
        for (int x0 = 0; x0 < size.width; x0 += 8) {
            full_film tile({std::min(8, size.width - x0), std::min(5, size.height - y0)});
            for (int i = 0; i < 6; ++i)
                for (int y = tile.size().height - 1; y >= 0; --y)
                    for (int x = 0; x < tile.size().width; ++x) tile.add(x, y, i, make(data::plain, x0 + x, y0 + y, i));
            tiled.merge(tile, x0, y0);
        }
    CHECK(same_bits(tiled.raw(), whole.raw()));

    full_film threaded(size);
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < 3; ++t)
            threads.emplace_back([&, t] {
                for (int i = 0; i < 6; ++i)
                    for (int y = 0; y < size.height; ++y)
                        for (int x = t; x < size.width; x += 3) threaded.add(x, y, i, make(data::plain, x, y, i));
            });
    }
    CHECK(same_bits(threaded.raw(), whole.raw()));
}

TEST_CASE("a film travels as bytes") {
    const full_film here = filled({6, 3}, 4);
    const std::vector<std::byte> sent(here.raw().begin(), here.raw().end());
    CHECK(sent.size() == full_film::bytes({6, 3}));
    full_film there({6, 3});
    there.restore(sent);
    CHECK(other_bits(there.develop(), here.develop()) == "");
    full_film other({3, 3});
    CHECK(message_of([&] { other.restore(sent); }) == "a film of 3x3 has " + std::to_string(full_film::bytes({3, 3})) +
                                                          " bytes, not " + std::to_string(sent.size()));
}

TEST_CASE("sizes that make no sense are refused before any memory is asked for") {
    using colors = film<planes<color_t>>;
    CHECK(colors::bytes({1920, 1080}) == std::size_t{20} * 1920 * 1080);
    CHECK(message_of([] { colors f({0, 5}); }) == "a film of 0x5 pixels has no pixels");
    CHECK(message_of([] { colors f({5, -1}); }) == "a film of 5x-1 pixels has no pixels");
    CHECK(message_of([] {
              colors f({2147483647, 2147483647});
          }) == "a film of 2147483647x2147483647 pixels at 20 bytes each is more than can be addressed");

    colors f({8, 6});
    const colors tile({4, 4});
    f.merge(tile, 4, 2);
    CHECK(message_of([&] { f.merge(tile, 5, 0); }) == "a film of 4x4 at (5, 0) does not lie in one of 8x6");
    CHECK(message_of([&] { f.merge(tile, 0, 3); }) == "a film of 4x4 at (0, 3) does not lie in one of 8x6");
    CHECK(message_of([&] { f.merge(tile, -1, 0); }) == "a film of 4x4 at (-1, 0) does not lie in one of 8x6");
    CHECK(message_of([&] { f.merge(tile, 0, 2147483647); }) ==
          "a film of 4x4 at (0, 2147483647) does not lie in one of 8x6");
    film<planes<position_t>> a({1, 1}, {1, 2, 3}), b({1, 1}, {1, 2, 4});
    CHECK(message_of([&] { a.merge(b); }) == "two films have points relative to different origins");
}

namespace {

/// A film that a filter asks for, of a noisy image, denoised.
template <class Filter>
void check_film_for(const Filter& denoise) {
    const extent size{16, 12};
    film_for<Filter> f(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < 8; ++i) {
                const double n[3] = {0, 0, 1};
                f.add(x, y, i, color = 1 + 0.3 * normal_deviate(i + 1, x, y), albedo = 0.5, normal = n, depth = 3);
            }
    const auto images = f.develop();
    image<float> out(size, 3);
    denoise(images.frame(), out);
    const auto error = [](const image<float>& of) {
        double sum = 0;
        for (int y = 0; y < of.size().height; ++y)
            for (int x = 0; x < of.size().width; ++x) sum += (of.at(x, y) - 1.0) * (of.at(x, y) - 1.0);
        return sum;
    };
    CHECK(all_finite(out));
    CHECK(error(out) < 0.3 * error(images[color]));
}

}  // namespace

TEST_CASE("the film of a filter has what the filter reads, and no more") {
    check_film_for(paper::make_joint_bilateral());
    check_film_for(paper::make_nlm());
    check_film_for(paper::make_nlm_2012());
    check_film_for(paper::make_nlm_2012_released());
    check_film_for(paper::make_rdfc_candidate());
    static_assert(std::is_same_v<film_for<paper::joint_bilateral>::planes, planes<color_t, albedo_t, normal_t>>);
    static_assert(std::is_same_v<film_for<const paper::nlm>::planes, planes<color_t, variance_of<color_t>>>);
    static_assert(std::is_same_v<film_for<paper::nlm, paper::joint_bilateral>::planes,
                                 planes<color_t, variance_of<color_t>, albedo_t, normal_t>>);
    static_assert(film_for<paper::rdfc_candidate>::pixel_bytes == 8 + 4 * 2 * 10);
    static_assert(film_for<paper::nlm_2012>::pixel_bytes == 12 + 4 * 12);
}

TEST_CASE("an estimator that needs halves gets them") {
    const auto denoise = paper::make_nlm().with(estimator::residual_variance{});
    film_for<decltype(denoise)> f({6, 5});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 6; ++x)
            for (int i = 0; i < 4; ++i) f.add(x, y, i, color = normal_deviate(i + 1, x, y));
    const auto images = f.develop();
    image<float> out({6, 5}, 3), error({6, 5}, 3);
    denoise(images.frame(), output(out).error(error.view()));
    CHECK(all_finite(error));
    CHECK(largest_magnitude(error) > 0);
}
