// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/patterns.hpp>
#include <winnow/filter/prefiltered.hpp>
#include <winnow/paper/feature_prefilters.hpp>
#include <winnow/paper/joint_bilateral.hpp>

using namespace winnow;
using namespace winnow::test;

namespace {

/// Doubles the albedo, and knows nothing of its noise.
struct doubled {
    using features = planes<albedo_t>;
    using reads = planes<albedo_t>;

    template <class Frame, class Executor>
    std::array<cleaned_feature, 1> operator()(const Frame& in, const Executor&, workspace& memory) const {
        const source albedo_in = in.find(albedo);
        scratch_images images(memory.clean, albedo_in.size, 3);
        const auto twice = images.take(3);
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < twice.size.height; ++y)
                for (int x = 0; x < twice.size.width; ++x) twice.at(x, y, c) = 2 * albedo_in.channel(c).at(x, y);
        return {cleaned_feature{twice, {}, {}, {}}};
    }
    friend int halo(const doubled&) { return 5; }
};

}  // namespace

TEST_CASE("the filter behind a pre-filter sees the cleaned features, and nothing of them but what was cleaned") {
    const buffers in = make_buffers({33, 21});
    const named_layers layers = in.layers();
    workspace memory;
    const cleaned_frame<named_layers, planes<albedo_t>> cleaned{layers,
                                                                doubled{}(layers, executor::serial<>{}, memory)};
    CHECK(cleaned.find(albedo).channel(1).at(3, 4) == 2 * in.albedo.at(3, 4, 1));
    CHECK(!cleaned.find(variance(albedo)));
    CHECK(!cleaned.find(first_half(albedo)));
    CHECK(cleaned.find(normal) == layers.find(normal));
    CHECK(cleaned.find(variance(normal)) == layers.find(variance(normal)));
    CHECK(cleaned.find(color) == layers.find(color));
}

TEST_CASE("a filter behind a pre-filter is the filter on what the pre-filter leaves") {
    const extent size{33, 21};
    buffers in = make_buffers(size);
    const paper::joint_bilateral host = paper::make_joint_bilateral();
    image<> result(size, 3), expected(size, 3);
    prefiltered{doubled{}, host}(in.layers(), result);
    in.albedo = fill(size, 3, [&, before = in.albedo](int x, int y, int c) { return 2 * before.at(x, y, c); });
    host(in.layers(), expected);
    CHECK(beyond(0, result, expected) == "");
    CHECK(halo(prefiltered{doubled{}, host}) == 5 + halo(host));
}

TEST_CASE("pre-filters that look at a feature alone are the filter of that feature") {
    const extent size{37, 23};
    const buffers in = make_buffers(size);
    image<> a = fill(size, 3, [&](int x, int y, int c) { return in.albedo.at(x, y, c) + 0.1 * uniform(9, x, y, c); });
    image<> b = fill(size, 3, [&](int x, int y, int c) { return 2 * in.albedo.at(x, y, c) - a.at(x, y, c); });
    const frame features{albedo = in.albedo.view(), first_half(albedo) = a.view(), second_half(albedo) = b.view(),
                         normal = in.normal.view()};
    workspace memory;
    const auto check = [&](const auto& prefilter) {
        const auto cleaned = prefilter(features, executor::serial<>{}, memory);
        image<> noise(size, 3), mean(size, 3), half_a(size, 3), half_b(size, 3);
        variance_from_halves(a.view(), b.view(), noise.view());
        prefilter.make(albedo)(filtering(albedo, frame{albedo = in.albedo.view(), variance(albedo) = noise.view(),
                                                       first_half(albedo) = a.view(), second_half(albedo) = b.view()}),
                               output{mean}.halves(half_a.view(), half_b.view()));
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size.height; y += 5)
                for (int x = 0; x < size.width; x += 3) {
                    CHECK(cleaned[0].mean.channel(c).at(x, y) == mean.at(x, y, c));
                    CHECK(cleaned[0].half_a.channel(c).at(x, y) == half_a.at(x, y, c));
                    CHECK(cleaned[0].half_b.channel(c).at(x, y) == half_b.at(x, y, c));
                    CHECK(cleaned[0].variance.channel(c).at(x, y) >= 0);
                }
        // A feature without halves is exact.
        CHECK(cleaned[1].mean == source(in.normal.view()));
        CHECK(!cleaned[1].variance);
    };
    check(paper::nlm_prefilter_of<planes<albedo_t, normal_t>>{});
    check(paper::bilateral_prefilter_of<planes<albedo_t, normal_t>>{});
}
