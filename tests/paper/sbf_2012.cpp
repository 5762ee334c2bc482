// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/executor/openmp.hpp>
#include <winnow/paper/sbf_2012.hpp>
#include "paper/laws.hpp"
#include "support/counting_new.hpp"

using namespace winnow;
using namespace winnow::test;
using paper::sbf;

// The typedef is the expression.
static_assert(std::is_same_v<decltype(sbf{}.bank.candidate(0)),
                             decltype(filter{gaussian(spatial, 1) * cutoff(chessboard, 2) *
                                                 shared((gaussian(standardized(albedo), 0.25f) *
                                                         (gaussian(standardized(normal), 0.8f) *
                                                          gaussian(standardized(depth), 0.6f)))),
                                             window::square{.radius = 8}})>);

namespace {

constexpr extent size{35, 23};

sbf small(float finest = 0.5f) {
    sbf f;
    f.bank.scales = {finest, 2 * finest, 4 * finest};
    f.bank.smoothing_scale = 2;
    return f;
}
const any_filter f = erased(small());

struct results {
    image<> mean{size, 3}, half_a{size, 3}, half_b{size, 3}, error{size, 3}, derivative{size, 3};
    image<> support{size, 1}, layer{size, 1}, chosen{size, 1};

    output all(const buffers& in) {
        output out{mean};
        return out.halves(half_a.view(), half_b.view())
            .error(error.view())
            .derivative(derivative.view())
            .support(support.view())
            .layer(in.depth.view(), layer.view());
    }
};

}  // namespace

TEST_CASE("SBF: a constant is a fixed point") { check_constant(f); }
TEST_CASE("SBF: no weight exceeds the centre's") { check_weights(f, 4); }
TEST_CASE("SBF: results stay within the values of the window") { check_convex(f, 4); }
TEST_CASE("SBF: flips, transposition and turns commute") { check_equivariant(f); }
TEST_CASE("SBF: the unit of radiance does not matter") {
    check_scaling([](double) { return f; });
}
TEST_CASE("SBF: neither the identity nor the plain mean") {
    sbf forgiving = small();
    forgiving.bank.like[0].spread = 1000;
    check_useful(erased(forgiving), 4);
}
TEST_CASE("SBF: hazards") { check_hazards(f); }

TEST_CASE("SBF: everything comes from the candidate with the least smoothed error, in each pixel") {
    // From left to right ever more detail in the same noise, and features that say little.
    buffers in = make_buffers(size);
    in.color = fill(size, 3, [](int x, int y, int c) {
        return 0.001 * x * x * std::sin(1.3 * x + y) + 0.1 * normal_deviate(5, x, y, c);
    });
    sbf filter = small();
    filter.bank.like[0].spread = 1e5f;
    const named_layers frame = in.layers();
    workspace memory;
    results r, one[3];
    filter(frame, r.all(in), executor::serial<>{}, memory, r.chosen.view());

    image<> smooth[3];
    for (std::size_t k = 0; k < 3; ++k) {
        filter.bank.candidate(k).with(estimator::sure{})(frame, one[k].all(in));
        const image<> mean = fill(size, 1, [&](int x, int y, int) {
            return (one[k].error.at(x, y, 0) + one[k].error.at(x, y, 1) + one[k].error.at(x, y, 2)) / 3;
        });
        smooth[k] = image<>(size);
        filter.bank.smoothing()(frame, output{}.layer(mean.view(), smooth[k].view()));
    }
    int count[3] = {}, wrong = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const auto k = static_cast<std::size_t>(r.chosen.at(x, y));
            ++count[k];
            for (const image<>& other : smooth) wrong += !(smooth[k].at(x, y) <= other.at(x, y) + 1e-6f);
            const auto same = [&](const image<> results::*i) {
                for (int c = 0; c < (r.*i).channels(); ++c)
                    wrong += !((r.*i).at(x, y, c) == Approx((one[k].*i).at(x, y, c)).epsilon(1e-5).margin(1e-6));
            };
            same(&results::mean), same(&results::half_a), same(&results::half_b), same(&results::derivative);
            same(&results::support), same(&results::layer);
            wrong += !(r.error.at(x, y, 2) == Approx(smooth[k].at(x, y)).epsilon(1e-4).margin(1e-6));
        }
    CHECK(wrong == 0);
    CHECK(std::min({count[0], count[1], count[2]}) > 0);
}

TEST_CASE("SBF: what is asked for does not change the rest, and the mean is that of the halves") {
    const buffers in = make_buffers(size);
    results r;
    image<> alone(size, 3);
    f(in.layers(), r.all(in), {executor_kind::simd});
    f(in.layers(), output{alone}, {executor_kind::simd});
    CHECK(other_bits(alone, r.mean) == "");
    const image<> of_halves =
        fill(size, 3, [&](int x, int y, int c) { return (r.half_a.at(x, y, c) + r.half_b.at(x, y, c)) / 2; });
    CHECK(beyond(2e-6, of_halves, r.mean) == "");
}

TEST_CASE("SBF: in noise the widest filter is chosen, without noise the narrowest") {
    buffers in = make_buffers(size);
    const auto flat = [&](image<>& i, double value) {
        i = fill(size, i.channels(), [=](int, int, int) { return value; });
    };
    flat(in.albedo, 0.5), flat(in.normal, 0.5), flat(in.depth, 0.5);
    const auto mean_choice = [&](double noise) {
        in.color = fill(
            size, 3, [=](int x, int y, int c) { return 0.1 * std::sin(0.7 * x) + noise * normal_deviate(5, x, y, c); });
        flat(in.color_variance, noise * noise);
        results r;
        workspace memory;
        small()(in.layers(), output{r.mean}, executor::simd{}, memory, r.chosen.view());
        double sum = 0;
        for (int y = 4; y < size.height - 4; ++y)
            for (int x = 4; x < size.width - 4; ++x) sum += r.chosen.at(x, y);
        return sum / ((size.width - 8) * (size.height - 8));
    };
    CHECK(mean_choice(0.5) > 1.7);
    CHECK(mean_choice(1e-4) < 0.05);
}

TEST_CASE("SBF: features that are all noise are ignored: the Gaussian average") {
    buffers in = make_buffers(size);
    for (image<>* i : {&in.albedo_variance, &in.normal_variance, &in.depth_variance})
        *i = fill(size, i->channels(), [](int, int, int) { return 1e12; });
    const filter blur{gaussian(spatial, 1), window::square{.radius = 2}};
    sbf same = small();
    same.bank.scales = {1, 1, 2};
    image<> expected(size, 3), found(size, 3);
    blur(in.layers(), expected);
    filter{same.bank.candidate(0)}(in.layers(), found);
    CHECK(beyond(1e-5, found, expected) == "");
}

TEST_CASE("SBF: the estimated error is that of the result, on Gaussian noise") {
    const extent large{160, 120};
    const buffers in = make_buffers(large);
    image<> mean(large, 3), error(large, 3);
    f(in.layers(), output{mean}.error(error.view()), {executor_kind::simd});
    double estimate = 0;
    for (int y = 0; y < large.height; ++y)
        for (int x = 0; x < large.width; ++x) estimate += error.at(x, y) / static_cast<double>(large.pixels());
    const double truth = mean_square(mean, fill(large, 3, structure));
    // The least of several estimates is a little too low.
    CHECK(estimate < 1.1 * truth);
    CHECK(estimate > 0.6 * truth);
}

TEST_CASE("SBF: with colour in the weights dF/du = 1/C + (mean of u^2 - F^2) / sigma^2") {
    const buffers in = make_buffers(size);
    paper::cross_bilateral_bank_with_range<paper::sbf_2012_features> bank{.sigma_color = 0.4f};
    bank.spatial_bank.scales = {0.5f, 1, 2};
    const image<> squares =
        fill(size, 3, [&](int x, int y, int c) { return double{in.color.at(x, y, c)} * in.color.at(x, y, c); });
    image<> mean(size, 3), derivative(size, 3), support(size, 1), mean_of_squares(size, 3);
    const auto run = [&](const auto& executor) {
        workspace memory;
        bank.candidate(2).with(estimator::sure{})(in.layers(),
                                                  output{mean}
                                                      .derivative(derivative.view())
                                                      .support(support.view())
                                                      .layer(squares.view(), mean_of_squares.view()),
                                                  executor, memory);
        const image<> expected = fill(size, 3, [&](int x, int y, int c) {
            const double m = mean.at(x, y, c);
            return 1 / support.at(x, y) + (mean_of_squares.at(x, y, c) - m * m) / (0.4 * 0.4);
        });
        CHECK(beyond(1e-5, derivative, expected) == "");
    };
    run(executor::serial<double>{});
    run(executor::simd{});
}

TEST_CASE("SBF by non-local means: without noise the input, with noise better than it") {
    buffers in = make_buffers(size);
    paper::sbf_nlm nlm;
    nlm.bank.radius = 4;
    nlm.bank.like.spread = 1000;
    image<> found(size, 3), chosen(size, 1);
    workspace memory;
    nlm(in.layers(), output{found}, executor::simd{}, memory, chosen.view());
    const image<> clean = fill(size, 3, structure);
    CHECK(mean_square(found, clean) < 0.5 * mean_square(in.color, clean));

    in.color_variance = image<>(size, 3);
    nlm(in.layers(), output{found}, executor::simd{}, memory, chosen.view());
    CHECK(other_bits(found, in.color) == "");
    CHECK(other_bits(chosen, image<>(size, 1)) == "");
}

TEST_CASE("SBF: what does not fit is refused before any work") {
    const buffers in = make_buffers(size);
    image<> mean(size, 3), other({3, 3}, 1);
    workspace memory;
    CHECK_THROWS_WITH(small()(in.layers(), output{mean}, executor::serial<>{}, memory, other.view()),
                      Catch::Contains("the output of the choice is 3x3, color is 35x23"));
    CHECK_THROWS_WITH(small()(in.layers(), output{mean}.layer(other.view(), other.view())),
                      Catch::Contains("a further layer is 3x3"));
    CHECK_THROWS_WITH(small(-1)(in.layers(), output{mean}), Catch::Contains("sbf: a scale is -1.0"));
    named_layers without;
    without.bind("color", in.color.view());
    CHECK_THROWS_WITH(small()(without, output{mean}), Catch::Contains("the filter needs albedo"));
}

TEST_CASE("SBF: a second run with the same workspace allocates nothing") {
    const buffers in = make_buffers(size);
    const named_layers frame = in.layers();
    results r;
    const output out = r.all(in);
    workspace memory;
    const sbf filter = small();
    filter(frame, out, executor::openmp{.threads = 2}, memory);
    const long long before = allocations_so_far().count;
    filter(frame, out, executor::openmp{.threads = 2}, memory);
    CHECK(allocations_so_far().count - before == 0);
}
