// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The whole of RDFC; its candidates and its selections have tests of their own.
#include <deque>
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/rdfc_2013.hpp>
#include "executor/agreement.hpp"
#include "paper/laws.hpp"
#include "support/counting_new.hpp"

using namespace winnow;
using namespace winnow::test;
using paper::rdfc;
using blended_rdfc = paper::rdfc_of<rdfc::features, paper::convex_blend>;

static_assert(std::is_same_v<rdfc::features, planes<albedo_t, normal_t, depth_t, visibility_t>>);

namespace {

constexpr float off = 1e6f;  // a k at which a distance no longer matters

/// All that the filter can read, by name.
struct inputs {
    std::deque<std::pair<std::string, image<>>> all;  // whose elements stay where they are

    image<>& operator[](const std::string& name) {
        for (auto& [known, image] : all)
            if (known == name) return image;
        return all.emplace_back(name, image<>()).second;
    }
    extent size() const { return all[0].second.size(); }
    named_layers layers(rectangle r) const {
        named_layers in;
        for (const auto& [name, image] : all) in.bind(name, source(image.view().crop(r)));
        return in;
    }
    named_layers layers() const { return layers({0, 0, size().width, size().height}); }
    inputs without(const std::string& part) const {
        inputs some;
        for (const auto& [name, image] : all)
            if (name.find(part) == std::string::npos) some[name] = image;
        return some;
    }
    /// f(image) for all buffers whose name holds this.
    template <class F>
    void each(const std::string& part, const F& f) {
        for (auto& [name, image] : all)
            if (name.find(part) != std::string::npos) f(image);
    }
};

/// Structure with Gaussian noise: much in the colour, little in the features.  Means are those of the halves.
inputs make_inputs(extent size, std::uint64_t seed = 0) {
    inputs in;
    std::uint64_t stream = 500 + 1000 * seed;
    const auto add = [&](const std::string& name, int channels, double scale, double noise) {
        stream += 10;
        const auto variance = [=](int x, int y, int c) {
            return noise * noise * (0.5 + uniform(stream + 2, x, y, c));  // of the mean of both halves
        };
        const auto half = [&](std::uint64_t which) {
            return fill(size, channels, [&](int x, int y, int c) {
                return scale * structure(2 * x, 2 * y, c) +
                       std::sqrt(2 * variance(x, y, c)) * normal_deviate(stream + which, x, y, c);
            });
        };
        const image<> a = half(0), b = half(1);
        in[name] = fill(size, channels, [&](int x, int y, int c) { return (a.at(x, y, c) + b.at(x, y, c)) / 2; });
        in[name + ".halfA"] = a, in[name + ".halfB"] = b;
        in[name + ".variance"] = fill(size, channels, variance);
    };
    add("color", 3, 1, 0.1);
    add("albedo", 3, 0.5, 0.01);
    add("normal", 3, 0.4, 0.01);
    add("depth", 1, 0.6, 0.005);
    add("visibility", 1, 0.7, 0.05);
    return in;
}

/// Features without halves that are the same everywhere.
void make_features_constant(inputs& in) {
    in = in.without("albedo").without("normal").without("depth").without("visibility");
    const extent size = in.size();
    for (const auto& [name, channels] :
         {std::pair{"albedo", 3}, std::pair{"normal", 3}, std::pair{"depth", 1}, std::pair{"visibility", 1}})
        in[name] = fill(size, channels, [](int, int, int) { return 0.5; });
}

struct results {
    image<> mean, half_a, half_b, error, derivative, support, selected;

    explicit results(extent size)
        : mean(size, 3),
          half_a(size, 3),
          half_b(size, 3),
          error(size, 3),
          derivative(size, 3),
          support(size, 1),
          selected(size, 3) {}
    output all() {
        return output{mean}
            .halves(half_a.view(), half_b.view())
            .error(error.view())
            .derivative(derivative.view())
            .support(support.view());
    }
    template <class F>
    static void each(const F& f) {
        f("mean", &results::mean), f("half A", &results::half_a), f("half B", &results::half_b);
        f("error", &results::error), f("derivative", &results::derivative), f("support", &results::support);
        f("selected", &results::selected);
    }
    std::string other_bits_than(const results& o) const {
        std::string text;
        each([&](const char* name, image<> results::*i) {
            if (const std::string d = other_bits(this->*i, o.*i); d != "") text += std::string(name) + ": " + d + "; ";
        });
        return text;
    }
    std::string not_finite() const {
        std::string text;
        each([&](const char* name, image<> results::*i) { text += all_finite(this->*i) ? "" : name; });
        return text;
    }
};

/// The two executors that these tests need: the definition, and lanes on threads.  Filters are compiled here alone.
template <class Filter>
void run(const Filter& f, const named_layers& in, const output& out, const how& h, workspace& memory,
         const target& selected = {}) {
    if (h.kind == executor_kind::serial_double) f(in, out, executor::serial<double>{}, memory, selected);
    else f(in, out, executor::openmp{.threads = h.threads, .inner = {.tile = h.tile}}, memory, selected);
}
template <class Filter>
results all_of(const Filter& f, const inputs& in, const how& h = {executor_kind::openmp}) {
    results r(in.size());
    workspace memory;
    run(f, in.layers(), r.all(), h, memory, r.selected.view());
    return r;
}

constexpr how hows[] = {{executor_kind::serial_double}, {executor_kind::openmp}};
constexpr paper::rdfc_numbers small{.radius = 3, .feature_radius = 2};
const rdfc f{small, {.error_radius = 1, .map_radius = 2}};
const blended_rdfc blended{small, {.error_radius = 2, .map_radius = 0}};
constexpr extent size{27, 19};

/// What three passes of lanes may be off, with windows and patches as above; the halves go further than the mean.
double rounding(const inputs& in) {
    double largest = 0;
    for (const auto& [name, image] : in.all)
        if (name.starts_with("color") && name.find("variance") == std::string::npos)
            largest = std::max(largest, largest_magnitude(image));
    return 3 * rounding_bound({.radius = 3, .patch_radius = 3}) * largest;
}

}  // namespace

TEST_CASE("RDFC: lanes agree with the definition") {
    const inputs in = make_inputs(size);
    const auto check = [&](const auto& filter) {
        const results expected = all_of(filter, in, hows[0]), found = all_of(filter, in, hows[1]);
        CHECK(beyond(rounding(in), found.mean, expected.mean) == "");
        CHECK(beyond(rounding(in), found.half_a, expected.half_a) == "");
        CHECK(beyond(rounding(in), found.half_b, expected.half_b) == "");
    };
    check(f);
    const results expected = all_of(f, in, hows[0]), found = all_of(f, in, hows[1]);
    // Estimates are of order Var, shares of order 1.
    CHECK(beyond(0.01 * 0.01, found.error, expected.error) == "");
    CHECK(beyond(0.01, found.derivative, expected.derivative) == "");
    CHECK(beyond(0.01, found.selected, expected.selected) == "");
    CHECK(beyond_relative(1e-3, found.support, expected.support) == "");
}

namespace {

/// The algorithm once more, one filter after the other, with what the library offers to everybody.
template <class Filter>
results step_by_step(const Filter& g, inputs in) {
    const extent s = in.size();
    const executor::openmp lanes{.threads = 1};
    const auto squared_difference = [&](const image<>& a, const image<>& b, double share) {
        const image<> raw = fill(s, a.channels(), [&](int x, int y, int c) {
            return share * std::pow(double{a.at(x, y, c)} - double{b.at(x, y, c)}, 2);
        });
        image<> blurred(s, a.channels());
        filter{gaussian(spatial, 0.5f), window::square{.radius = 2}}(frame{},
                                                                     output{}.layer(raw.view(), blurred.view()), lanes);
        return blurred;
    };
    // Lines 1 to 8.
    inputs guides;
    guides["color"] = in["color"], guides["color.halfA"] = in["color.halfA"], guides["color.halfB"] = in["color.halfB"];
    const auto noise_of = [&](const std::string& name) {
        image<> noise(s, in[name].channels());
        scale_variance_to_halves(in[name + ".variance"].view(), in[name + ".halfA"].view(), in[name + ".halfB"].view(),
                                 noise.view());
        return noise;
    };
    guides["color.variance"] = noise_of("color");
    Filter::features::for_each([&](auto feature) {
        const std::string name = feature.name();
        inputs noisy = in;
        noisy[name + ".variance"] = noise_of(name);
        image<> mean(s, feature.channels), a(s, feature.channels), b(s, feature.channels);
        const named_layers layers = noisy.layers();
        g.cleaning().feature_filter(feature)(filtering(feature, layers), output{mean}.halves(a.view(), b.view()),
                                             lanes);
        guides[name] = mean, guides[name + ".variance"] = squared_difference(a, b, 1);
    });
    // Lines 9 to 14.
    const named_layers layers = guides.layers();
    std::vector<results> candidate(3, results(s));
    g.first()(layers, candidate[0].all(), lanes);
    g.second()(layers, candidate[1].all(), lanes);
    g.third()(layers, candidate[2].all(), lanes);
    // Lines 15 to 25.
    using selection = std::remove_const_t<decltype(g.selection)>;
    constexpr int statistics = selection::statistics;
    const auto pixel = [&](int x, int y) {
        paper::rdfc_candidates_pixel p;
        for (int c = 0; c < 3; ++c) {
            p.input[c] = guides["color"].at(x, y, c), p.variance[c] = guides["color.variance"].at(x, y, c);
            for (int k = 0; k < 3; ++k)
                p.filtered[k][c] = candidate[k].mean.at(x, y, c),
                p.derivative[k][c] = candidate[k].derivative.at(x, y, c);
        }
        return p;
    };
    const image<> raw = fill(s, statistics, [&](int x, int y, int c) { return selection::gather(pixel(x, y))[c]; });
    image<> smooth(s, statistics);
    g.smoothing(g.selection.error_radius)(layers, output{}.layer(raw.view(), smooth.view()), lanes);
    const auto smoothed = [&](int x, int y) {
        std::array<float, statistics> all;
        for (int c = 0; c < statistics; ++c) all[c] = smooth.at(x, y, c);
        return all;
    };
    const image<> map =
        fill(s, 3, [&](int x, int y, int c) { return selection::decide(smoothed(x, y), pixel(x, y))[c]; });
    results r(s);
    g.smoothing(g.selection.map_radius)(layers, output{}.layer(map.view(), r.selected.view()), lanes);
    const auto mixed = [&](image<> results::*part, int x, int y, int c) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) sum += double{r.selected.at(x, y, k)} * (candidate[k].*part).at(x, y, c);
        return sum;
    };
    const auto mix = [&](image<> results::*part) {
        return fill(s, (r.*part).channels(), [&](int x, int y, int c) { return mixed(part, x, y, c); });
    };
    r.derivative = mix(&results::derivative), r.support = mix(&results::support);
    r.error = fill(s, 3, [&](int x, int y, int) {
        return selection::error(smoothed(x, y),
                                {r.selected.at(x, y, 0), r.selected.at(x, y, 1), r.selected.at(x, y, 2)});
    });
    // Lines 26 to 29.
    const image<> mean = mix(&results::mean), a = mix(&results::half_a), b = mix(&results::half_b);
    const image<> left = squared_difference(a, b, 0.25);
    g.last()(frame{color = mean.view(), variance(color) = left.view(), first_half(color) = a.view(),
                   second_half(color) = b.view()},
             output{r.mean}.halves(r.half_a.view(), r.half_b.view()), lanes);
    return r;
}

}  // namespace

TEST_CASE("RDFC: it is made of the paper's filters") {
    const auto color_weight = [](float k, int radius) {
        return exponential(patch(noise_normalized(color, {.k = k}), {.radius = radius}));
    };
    const auto feature_weight = [](float tau) {
        return exponential(max(cross(albedo, {.tau = tau}), cross(normal, {.tau = tau}), cross(depth, {.tau = tau}),
                               cross(visibility, {.tau = tau})));
    };
    const rdfc g{{.tau = 0.03f, .tau_third = 0.02f}};
    const window::square window{.radius = 10};
    const window::space_time candidates_window{.radius = 10, .frames = 0};
    const estimator::sure sure;
    CHECK(g.first() == filter{min(color_weight(0.45f, 1), feature_weight(0.03f)), candidates_window, sure});
    CHECK(g.second() == filter{min(color_weight(0.45f, 3), feature_weight(0.03f)), candidates_window, sure});
    CHECK(g.third() == filter{feature_weight(0.02f), candidates_window, sure});
    CHECK(g.last() == filter{color_weight(0.45f, 1), window});
    CHECK(g.smoothing(5) == filter{color_weight(1, 1), window::square{.radius = 5}});
    CHECK(g.cleaning().feature_filter(depth) ==
          filter{exponential(patch(noise_normalized(depth, {.k = 1}), {.radius = 3})), window::square{.radius = 5}});
}

TEST_CASE("RDFC: the whole is its parts, run one after the other") {
    const inputs in = make_inputs(size);
    const auto check = [&](const auto& g) {
        const results found = all_of(g, in), expected = step_by_step(g, in);
        results::each([&](const char* name, image<> results::*i) {
            CAPTURE(name);
            // The work between the filters is done in floats here, in doubles there: a few roundings of values up to 2,
            // which weights pass on a thousand times larger at most (see rounding_bound).
            if (i == &results::support) CHECK(beyond_relative(1e-4, found.*i, expected.*i) == "");
            else CHECK(beyond(1e-4, found.*i, expected.*i) == "");
        });
        CHECK(largest_magnitude(expected.error) > 20 * 1e-4);
    };
    check(f);
    check(blended);
}

TEST_CASE("RDFC: neither the identity nor the plain mean, with either selection") {
    const inputs in = make_inputs({53, 38});
    const image<> clean = fill(in.size(), 3, [](int x, int y, int c) { return structure(2 * x, 2 * y, c); });
    inputs noisy = in;
    const double before = mean_square(noisy["color"], clean), box = mean_square(box_mean(noisy["color"], 3), clean);
    for (const image<>& found : {all_of(f, in).mean, all_of(blended, in).mean}) {
        CHECK(mean_square(found, clean) < 0.6 * before);
        CHECK(mean_square(found, clean) < 0.6 * box);
    }
}

TEST_CASE("RDFC: with colour and features off, the box mean of the box mean") {
    rdfc plain = f;
    plain.numbers.k_color = plain.numbers.k_feature = off;
    inputs in = make_inputs(size);
    for (const how& h : hows) {
        const results r = all_of(plain, in, h);
        CHECK(beyond(1e-5 * largest_magnitude(in["color"]), r.mean, box_mean(box_mean(in["color"], 3), 3)) == "");
        CHECK(beyond_relative(1e-5, r.support, fill(size, 1, [](int x, int y, int) {
                                  const auto side = [](int i, int n) {
                                      return std::min(n - 1, i + 3) - std::max(0, i - 3) + 1;
                                  };
                                  return side(x, size.width) * side(y, size.height);
                              })) == "");
    }
}

TEST_CASE("RDFC: without noise and without equal patches, the input, bit for bit, and no error") {
    inputs in = make_inputs(size);
    for (const char* name : {"color", "albedo", "normal", "depth", "visibility"})
        in[std::string(name) + ".halfA"] = in[std::string(name) + ".halfB"] = in[name];
    const inputs bare = in.without("variance");
    for (const how& h : hows) {
        const results r = all_of(f, bare, h);
        CHECK(other_bits(r.mean, in["color"]) == "");
        CHECK(other_bits(r.half_a, in["color"]) == "");
        CHECK(other_bits(all_of(blended, bare).mean, in["color"]) == "");
        CHECK(beyond(1e-12, r.error, image<>(size, 3)) == "");
        CHECK(beyond(1e-6, r.derivative, fill(size, 3, [](int, int, int) { return 1; })) == "");
    }
}

TEST_CASE("RDFC: the mean of the filtered halves is the filtered mean") {
    const inputs in = make_inputs(size);
    for (const how& h : hows) {
        const results r = all_of(f, in, h);
        const image<> mean = fill(
            size, 3, [&](int x, int y, int c) { return (double{r.half_a.at(x, y, c)} + r.half_b.at(x, y, c)) / 2; });
        CHECK(beyond(rounding(in), r.mean, mean) == "");
    }
}

TEST_CASE("RDFC: the shares of the candidates lie in [0, 1] and add up to 1") {
    const inputs in = make_inputs({45, 31});
    const auto check = [&](const results& r) {
        std::array<bool, 3> used{};
        for (int y = 0; y < 31; ++y)
            for (int x = 0; x < 45; ++x) {
                float sum = 0;
                for (int k = 0; k < 3; ++k) {
                    const float s = r.selected.at(x, y, k);
                    CHECK((s >= 0 && s <= 1));
                    used[static_cast<std::size_t>(k)] |= s > 0.5f;
                    sum += s;
                }
                CHECK(std::abs(sum - 1) <= 3 * 0x1p-23f);
            }
        CHECK((used[0] || used[1]));
        CHECK(used[2]);
    };
    check(all_of(f, in, hows[0]));
    check(all_of(f, in, hows[1]));
    check(all_of(blended, in));
    // Without smoothing one candidate has it all.
    rdfc sharp = f;
    sharp.selection.map_radius = 0;
    const results r = all_of(sharp, in);
    for (int y = 0; y < 31; ++y)
        for (int x = 0; x < 45; ++x)
            for (int k = 0; k < 3; ++k) CHECK((r.selected.at(x, y, k) == 0 || r.selected.at(x, y, k) == 1));
}

TEST_CASE("RDFC: where all candidates are the same, the first pass is that candidate, whatever is selected") {
    // Colour off and one tau: all three are the features' weights.  The last pass, with colour off, is the box mean.
    rdfc same = f;
    same.numbers.k_color = off;
    same.numbers.tau = same.numbers.tau_third = 0.05f;
    blended_rdfc same_blended{same.numbers, blended.selection};
    inputs in = make_inputs(size);
    // Features without halves are taken as they are.
    for (const char* name : {"albedo", "normal", "depth", "visibility"}) {
        in = in.without(std::string(name) + ".");
        in[std::string(name) + ".variance"] = image<>(size, in[name].channels());
    }
    results alone(size);
    inputs guides = in;
    same.third()(guides.layers(), output{alone.mean}.derivative(alone.derivative.view()).support(alone.support.view()),
                 executor::openmp{.threads = 1});
    const auto check = [&](const results& r) {
        CHECK(beyond(2e-5, r.mean, box_mean(alone.mean, 3)) == "");
        CHECK(beyond(2e-5, r.derivative, alone.derivative) == "");
        CHECK(beyond_relative(2e-5, r.support, alone.support) == "");
    };
    for (const how& h : hows) check(all_of(same, in, h));
    check(all_of(same_blended, in));
}

TEST_CASE("RDFC: THIRD does not blur across an edge of a feature, though the colours on both sides are the same") {
    inputs in = make_inputs({41, 25});
    const extent s = in.size();
    make_features_constant(in);
    const auto left = [](int x) { return x < 20; };
    in["color"] = fill(s, 3, [](int x, int y, int c) { return 0.5 + 0.1 * normal_deviate(9, x, y, c); });
    in["albedo"] = fill(s, 3, [&](int x, int, int) { return left(x) ? 0.2 : 0.6; });
    for (const char* name : {"albedo", "normal", "depth", "visibility"})
        in[std::string(name) + ".variance"] = image<>(s, in[name].channels());
    const image<> side = fill(s, 1, [&](int x, int, int) { return left(x); });
    const image<> flat = fill(s, 3, [](int, int, int) { return 0.5; });
    const auto third = f.third();
    const auto check = [&](const auto& executor) {
        image<> mean(s, 3), shares(s, 1);
        third(in.layers(), output{mean}.layer(side.view(), shares.view()), executor);
        CHECK(beyond(1e-30, shares, side) == "");
        CHECK(mean_square(mean, flat) < 0.1 * mean_square(in["color"], flat));
    };
    check(executor::serial<double>{});
    check(executor::openmp{.threads = 1});
}

TEST_CASE("RDFC: the variance of the samples counts by its shape alone") {
    // Stratified samples show too much: four times is the same, bit for bit.
    inputs in = make_inputs(size), too_much = in;
    too_much.each(".variance", [&](image<>& i) {
        i = fill(size, i.channels(), [before = i](int x, int y, int c) { return 4 * before.at(x, y, c); });
    });
    CHECK(all_of(f, too_much).other_bits_than(all_of(f, in)) == "");
    // Its shape does count.
    too_much["color.variance"].at(9, 9, 1) *= 8;
    CHECK(all_of(f, too_much).other_bits_than(all_of(f, in)) != "");
}

TEST_CASE("RDFC: a constant is a fixed point") {
    inputs in = make_inputs(size);
    const image<> constant = fill(size, 3, [](int, int, int c) { return 0.37 + c; });
    in["color"] = in["color.halfA"] = in["color.halfB"] = constant;
    for (const how& h : hows) CHECK(beyond_relative(3 * 4 * 0x1p-24 * 49, all_of(f, in, h).mean, constant) == "");
}

TEST_CASE("RDFC: results stay within the values of both windows") {
    const inputs in = make_inputs({33, 21});
    const extent s = in.size();
    const image<> layer = fill(s, 1, [](int x, int y, int) { return uniform(77, x, y); });
    for (const how& h : hows) {
        image<> mean(s, 3), found(s, 1);
        workspace memory;
        run(f, in.layers(), output{mean}.layer(layer.view(), found.view()), h, memory);
        const int reach = 2 * f.numbers.radius;
        for (int y = 0; y < s.height; ++y)
            for (int x = 0; x < s.width; ++x) {
                float low = 1, high = 0;
                for (int j = std::max(0, y - reach); j <= std::min(s.height - 1, y + reach); ++j)
                    for (int i = std::max(0, x - reach); i <= std::min(s.width - 1, x + reach); ++i)
                        low = std::min(low, layer.at(i, j)), high = std::max(high, layer.at(i, j));
                CHECK(found.at(x, y) >= low - 1e-6f);
                CHECK(found.at(x, y) <= high + 1e-6f);
            }
    }
}

TEST_CASE("RDFC: flips, transposition and turns commute") {
    const extent turned{size.height, size.width};
    const inputs in = make_inputs(size);
    const auto check = [&](extent to, const auto& from) {
        inputs other = in;
        const auto moved = [&](const image<>& i) {
            return fill(to, i.channels(), [&](int x, int y, int c) {
                const auto [fx, fy] = from(x, y);
                return i.at(fx, fy, c);
            });
        };
        other.each("", [&](image<>& i) { i = moved(i); });
        for (const how& h : hows) CHECK(beyond(1e-5 * 2, all_of(f, other, h).mean, moved(all_of(f, in, h).mean)) == "");
    };
    check(size, [](int x, int y) { return std::pair{size.width - 1 - x, y}; });
    check(size, [](int x, int y) { return std::pair{x, size.height - 1 - y}; });
    check(turned, [](int x, int y) { return std::pair{y, x}; });
    check(turned, [](int x, int y) { return std::pair{y, size.height - 1 - x}; });
}

TEST_CASE("RDFC: the unit of radiance does not matter, where epsilon is in that unit") {
    const inputs in = make_inputs(size);
    const image<> expected = all_of(f, in).mean;
    for (const double a : {1e-3, 1e3}) {
        inputs scaled = in;
        scaled.each("color", [&](image<>& i) {
            const double by = &i == &scaled["color.variance"] ? a * a : a;
            i = fill(size, 3, [&, before = i](int x, int y, int c) { return before.at(x, y, c) * by; });
        });
        rdfc g = f;
        g.numbers.epsilon = static_cast<float>(f.numbers.epsilon * a * a);
        image<> found = all_of(g, scaled).mean;
        found = fill(size, 3, [before = found, a](int x, int y, int c) { return before.at(x, y, c) / a; });
        CAPTURE(a);
        CHECK(beyond(4e-5, found, expected) == "");
    }
}

TEST_CASE("RDFC: a crop with its halo gives the bits of the whole image") {
    rdfc narrow = f;
    narrow.numbers.radius = 1, narrow.numbers.feature_radius = 6;
    const int reach = halo(narrow);
    const inputs in = make_inputs({2 * reach + 23, 7});
    const results whole = all_of(narrow, in);
    for (const int x0 : {0, 9, 22, reach + 11, in.size().width - 1}) {
        const int x1 = x0 + 1;
        const rectangle crop{std::max(0, x0 - reach), 0, std::min(in.size().width, x1 + reach), 7};
        results part(crop.size());
        workspace memory;
        run(narrow, in.layers(crop), part.all(), {executor_kind::openmp}, memory, part.selected.view());
        results::each([&](const char* name, image<> results::*i) {
            CAPTURE(x0, reach, name);
            CHECK(other_bits((part.*i).view().crop({x0 - crop.x0, 0, x1 - crop.x0, 7}),
                             (whole.*i).view().crop({x0, 0, x1, 7})) == "");
        });
    }
}

TEST_CASE("RDFC: the bits do not depend on tiles or threads", "[openmp]") {
    const inputs in = make_inputs({67, 29});
    const results expected = all_of(f, in), expected_blend = all_of(blended, in);
    std::vector<how> all;
    for (const int threads : {1, 2, 3, 7})
        all.push_back({.kind = executor_kind::openmp, .threads = threads, .tile = {16, 4}});
    for (const extent tile : {extent{1, 1}, extent{48, 5}, extent{1000, 1000}})
        all.push_back({.kind = executor_kind::openmp, .tile = tile});
    for (const how& h : all) {
        CAPTURE(to_string(h));
        CHECK(all_of(f, in, h).other_bits_than(expected) == "");
        CHECK(all_of(blended, in, h).other_bits_than(expected_blend) == "");
    }
}

TEST_CASE("RDFC: layers that add up to the colour still do, and a second run allocates nothing") {
    inputs in = make_inputs(size);
    const image<> diffuse = fill(size, 3, [](int x, int y, int c) { return uniform(31, x, y, c); });
    const image<> rest = fill(
        size, 3, [&](int x, int y, int c) { return double{in["color"].at(x, y, c)} - double{diffuse.at(x, y, c)}; });
    const named_layers layers = in.layers();
    for (const how& h : hows) {
        results r(size);
        image<> filtered_diffuse(size, 3), filtered_rest(size, 3), expected_bits;
        output out = r.all();
        out.layer(diffuse.view(), filtered_diffuse.view()).layer(rest.view(), filtered_rest.view());
        workspace memory;
        run(f, layers, out, h, memory, r.selected.view());
        const image<> sum = fill(size, 3, [&](int x, int y, int c) {
            return double{filtered_diffuse.at(x, y, c)} + double{filtered_rest.at(x, y, c)};
        });
        CHECK(beyond(rounding(in), sum, r.mean) == "");
        CHECK(other_bits(r.mean, all_of(f, in, h).mean) == "");

        const results first = r;
        const long long before = allocations_so_far().count;
        run(f, layers, out, h, memory, r.selected.view());
        CHECK(allocations_so_far().count - before == 0);
        CHECK(r.other_bits_than(first) == "");
    }
}

TEST_CASE("RDFC: a bad pixel in any buffer is contained") {
    const inputs in = make_inputs({95, 9});
    const extent s = in.size();
    rdfc narrow = f;
    narrow.numbers.radius = 2, narrow.numbers.feature_radius = 1;
    const int reach = halo(narrow);
    REQUIRE(reach < 45);
    const results before = all_of(narrow, in);
    for (const auto& [name, image] : in.all)
        for (const float bad : {NAN, INFINITY}) {
            inputs spoilt = in;
            spoilt[name].at(47, 4, spoilt[name].channels() - 1) = bad;
            const results after = all_of(narrow, spoilt);
            CAPTURE(name, bad);
            CHECK(after.not_finite() == "");
            results::each([&](const char* which, winnow::image<> results::*i) {
                CAPTURE(which);
                for (const rectangle far :
                     {rectangle{0, 0, 47 - reach, s.height}, rectangle{48 + reach, 0, s.width, s.height}})
                    CHECK(other_bits((before.*i).view().crop(far), (after.*i).view().crop(far)) == "");
            });
        }
}

TEST_CASE("RDFC: what renderers deliver at their worst comes out finite") {
    const auto check = [](const char* hazard, const auto& spoil, extent of = size, int radius = 3) {
        inputs in = make_inputs(of);
        spoil(in);
        rdfc wide = f;
        wide.numbers.radius = radius;
        CAPTURE(hazard, to_string(of));
        for (const how& h : hows) {
            const results r = all_of(wide, in, h);
            CHECK(all_finite(r.mean));
            CHECK(all_finite(r.half_a));
            CHECK(all_finite(r.half_b));
            CHECK(all_finite(r.derivative));
            CHECK(all_finite(r.support));
            CHECK(all_finite(r.selected));
            CHECK(all_finite(r.error));
        }
        CHECK(all_of(blended, in).not_finite() == "");
    };
    const auto set = [](double value) {
        return [value](image<>& i) { i = fill(i.size(), i.channels(), [&](int, int, int) { return value; }); };
    };
    check("as it is", [](inputs&) {});
    check("no variance of the samples anywhere", [&](inputs& in) { in.each(".variance", set(0)); });
    check("no variance given", [](inputs& in) { in = in.without("variance"); });
    check("equal halves", [](inputs& in) {
        for (const char* name : {"color", "albedo", "normal", "depth", "visibility"})
            in[std::string(name) + ".halfA"] = in[std::string(name) + ".halfB"] = in[name];
    });
    check("constant features", [](inputs& in) { make_features_constant(in); });
    check("features without variance or halves", [](inputs& in) {
        const inputs all = in;
        in = all.without(".");
        for (const auto& [name, image] : all.all)
            if (name.starts_with("color")) in[name] = image;
    });
    check("all black", [&](inputs& in) { in.each("", set(0)); });
    check("constant everything", [&](inputs& in) { in.each("", set(0.25)); });
    check("one pixel of 1e30 in one half",
          [](inputs& in) { in["color.halfA"].at(9, 9, 1) = 1e30f, in["color"].at(9, 9, 1) = 5e29f; });
    check("one pixel of 1e30 everywhere", [](inputs& in) { in.each("", [](image<>& i) { i.at(9, 9) = 1e30f; }); });
    check("one pixel of half's largest number",
          [](inputs& in) { in["color.halfA"].at(3, 4) = in["color"].at(3, 4) = in["color.halfB"].at(3, 4) = 65504; });
    check("negative radiance", [](inputs& in) {
        for (const char* name : {"color", "color.halfA", "color.halfB"})
            in[name] = fill(size, 3, [before = in[name]](int x, int y, int c) { return -before.at(x, y, c); });
    });
    check("bad pixels all over", [&](inputs& in) { in.each("", set(NAN)); });
    for (const extent tiny : {extent{1, 1}, extent{1, 9}, extent{9, 1}, extent{2, 3}}) {
        check(
            "smaller than the window", [](inputs&) {}, tiny);
        check(
            "much smaller than the window", [](inputs&) {}, tiny, 12);
    }
}

TEST_CASE("RDFC: results may go where the input was") {
    inputs in = make_inputs(size), in_place = in;
    const results expected = all_of(f, in);
    image<> error(size, 3);
    workspace memory;
    run(f, in_place.layers(),
        output{in_place["color"]}
            .halves(in_place["color.halfA"].view(), in_place["color.halfB"].view())
            .error(error.view()),
        {executor_kind::openmp}, memory);
    CHECK(other_bits(in_place["color"], expected.mean) == "");
    CHECK(other_bits(in_place["color.halfA"], expected.half_a) == "");
    CHECK(other_bits(in_place["color.halfB"], expected.half_b) == "");
    CHECK(other_bits(error, expected.error) == "");
}

TEST_CASE("RDFC: a single pixel is its own mean") {
    inputs in = make_inputs({1, 1});
    const results r = all_of(f, in);
    CHECK(other_bits(r.mean, in["color"]) == "");
    CHECK(r.support.at(0, 0) == 1);
    CHECK(r.derivative.at(0, 0, 2) == 1);
}

TEST_CASE("RDFC: a feature without both halves is exact, whatever its variance") {
    const inputs in = make_inputs(size);
    const results expected = all_of(f, in.without("visibility."));
    inputs one = in.without("visibility.halfB");
    CHECK(all_of(f, one).other_bits_than(expected) == "");
    CHECK(all_of(f, in.without("visibility.half")).other_bits_than(expected) == "");
    CHECK(all_of(f, in).other_bits_than(expected) != "");
}

namespace {

/// What the filter complains about; empty if it does not.
std::string complaint(const named_layers& in, const output& out, const target& selected = {}) {
    workspace memory;
    try {
        run(f, in, out, {executor_kind::openmp}, memory, selected);
    } catch (const invalid_input& e) {
        return e.what();
    }
    return "";
}
bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("RDFC: what is missing is named before any work") {
    const inputs in = make_inputs(size);
    results r(size);
    for (const char* half : {"color.halfA", "color.halfB"}) {
        const std::string said = complaint(in.without(half).layers(), r.all());
        CHECK(says(said, "rdfc needs color.halfA and color.halfB"));
        CHECK(says(said, "render the frame twice"));
    }
    for (const char* name : {"albedo", "normal", "depth", "visibility"})
        CHECK(says(complaint(in.without(name).layers(), r.all()), std::string("needs ") + name));
    CHECK(says(complaint(named_layers{}, r.all()), "needs color"));
    CHECK(r.other_bits_than(results(size)) == "");
}

TEST_CASE("RDFC: a buffer of another size or number of channels is named before any work") {
    const inputs in = make_inputs(size);
    results r(size);
    for (const auto& [name, image] : in.all) {
        if (name == "color") continue;
        CAPTURE(name);
        named_layers layers = in.layers();
        const winnow::image<> narrow({26, 19}, image.channels()), two(size, 2);
        layers.bind(name, narrow.view());
        const std::string said = complaint(layers, r.all(), r.selected.view());
        CHECK(says(said, name + " is 26x19"));
        CHECK(says(said, "color is 27x19"));
        layers.bind(name, two.view());
        CHECK(says(complaint(layers, r.all(), r.selected.view()),
                   name + " has 2 channels, it needs " + std::to_string(image.channels())));
    }
    named_layers layers = in.layers();
    layers.bind("color", in.all[4].second.view().channel(0));
    CHECK(says(complaint(layers, r.all()), "color has 1 channels, it needs 3"));
    float somewhere = 0;
    layers.bind("color", planar(&somewhere, {0, 19}, 3));
    CHECK(says(complaint(layers, r.all()), "color is 0x19"));
    CHECK(r.other_bits_than(results(size)) == "");
}

TEST_CASE("RDFC: a result of another size or number of channels is named before any work") {
    const inputs in = make_inputs(size);
    results r(size);
    image<> narrow({27, 18}, 3), two(size, 2), layer(size, 3), narrow_grey({27, 18}, 1);
    const auto refused = [&](const output& out, const std::string& name, const target& selected = {}) {
        return says(complaint(in.layers(), out, selected), name);
    };
    CHECK(refused(narrow, "the output is 27x18"));
    CHECK(refused(two, "the output has 2 channels"));
    for (image<>* bad : {&narrow, &two}) {
        const std::string is = bad == &narrow ? " is 27x18" : " has 2 channels, it needs 3";
        CHECK(refused(output{r.mean}.halves(bad->view(), r.half_b.view()), "the output of the first half" + is));
        CHECK(refused(output{r.mean}.halves(r.half_a.view(), bad->view()), "the output of the second half" + is));
        CHECK(refused(output{r.mean}.error(bad->view()), "the output of the error" + is));
        CHECK(refused(output{r.mean}.derivative(bad->view()), "the output of the derivative" + is));
        CHECK(refused(output{r.mean}.layer(layer.view(), bad->view()), "the output of a further layer" + is));
        CHECK(refused(r.mean, "the output of the selection" + is, bad->view()));
    }
    CHECK(refused(output{r.mean}.support(narrow_grey.view()), "the output of the sum of weights is 27x18"));
    CHECK(refused(output{r.mean}.support(two.view()), "the output of the sum of weights has 2 channels, it needs 1"));
    CHECK(refused(output{r.mean}.layer(narrow.view(), layer.view()), "a further layer is 27x18"));
    CHECK(r.other_bits_than(results(size)) == "");
}

TEST_CASE("RDFC: numbers out of range are refused before anything is written") {
    const inputs in = make_inputs(size);
    const auto refused = [&](const rdfc& g) {
        results r(size);
        workspace memory;
        CHECK_THROWS_AS(run(g, in.layers(), r.all(), {executor_kind::openmp}, memory, r.selected.view()),
                        invalid_input);
        CHECK(r.other_bits_than(results(size)) == "");
    };
    const auto with = [](auto change) {
        rdfc g = f;
        change(g);
        return g;
    };
    refused(with([](rdfc& g) { g.numbers.radius = -1; }));
    refused(with([](rdfc& g) { g.numbers.k_color = 0; }));
    refused(with([](rdfc& g) { g.numbers.k_feature = NAN; }));
    refused(with([](rdfc& g) { g.numbers.tau = -1; }));
    refused(with([](rdfc& g) { g.numbers.tau_third = 0; }));
    refused(with([](rdfc& g) { g.numbers.epsilon = 0; }));
    refused(with([](rdfc& g) { g.numbers.feature_radius = -1; }));
    refused(with([](rdfc& g) { g.selection.error_radius = -1; }));
    refused(with([](rdfc& g) { g.selection.map_radius = -1; }));
}

TEST_CASE("RDFC: frames around that show the same take away noise, and a sequence is only looked at if asked for") {
    // The same still picture three times, with noise of its own in each.
    std::vector<inputs> renders;
    for (std::uint64_t seed = 0; seed < 3; ++seed) renders.push_back(make_inputs(size, seed));
    std::vector<named_layers> frames;
    for (const inputs& in : renders) frames.push_back(in.layers());
    const frame_sequence<named_layers> in{frames[1], std::span(frames).first(1), std::span(frames).last(1)};
    const executor::openmp lanes{.threads = 2};

    image<> still(size, 3), alone(size, 3), several(size, 3);
    f(frames[1], output(still), lanes);
    f(in, output(alone), lanes);
    CHECK(other_bits(alone, still) == "");
    rdfc around = f;
    around.numbers.frames = 1;
    around(in, output(several), lanes);
    const auto error = [&](const image<>& found) {
        double sum = 0;
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const double apart = found.at(x, y, c) - structure(2 * x, 2 * y, c);
                    sum += apart * apart;
                }
        return sum;
    };
    CHECK(error(several) < 0.8 * error(still));

    // A frame of another size is told before any work.
    frames[2].bind("albedo", image_view<const float>(several.view()).crop({0, 0, 5, 5}));
    image<> untouched(size, 3);
    CHECK_THROWS_WITH(around(in, output(untouched), lanes), Catch::Contains("albedo is 5x5"));
    CHECK(largest_magnitude(untouched) == 0);
}

TEST_CASE("RDFC: the released numbers make the filters that they name") {
    const rdfc released{paper::rdfc_numbers_as_released()};
    CHECK(released.first() == rdfc{{.tau = 1e-3f}}.first());
    CHECK(released.third() == rdfc{{.tau_third = 1e-4f}}.third());
    CHECK(released.smoothing(5) ==
          filter{exponential(patch(noise_normalized(color, {.k = 1}), {.radius = 3})), window::square{.radius = 5}});
    CHECK(released.last() == paper::make_nlm({.radius = 5, .patch_radius = 3}));
    CHECK(released.cleaning().numbers.feature_share == 0.25f);
    const inputs in = make_inputs(size);
    CHECK(all_of(released, in).not_finite() == "");
}
