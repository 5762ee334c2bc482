// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "features.hpp"

#include <denoise/filters.hpp>
#include <simulate/output.hpp>
#include <support/progress.hpp>
#include <winnow/executor/openmp.hpp>
#include <winnow/frame/unit_range.hpp>
#include <winnow/paper/feature_prefilters.hpp>
#include <winnow/paper/sure_prefilter_2017.hpp>

namespace sure_prefilter {

using namespace winnow;

namespace {

using features = planes<albedo_t, normal_t, depth_t>;

image<float> copied(const source& s) {
    image<float> to(s.size, s.channels);
    for (int c = 0; c < s.channels; ++c)
        for (int y = 0; y < s.size.height; ++y)
            for (int x = 0; x < s.size.width; ++x) to.at(x, y, c) = s.channel(c).at(x, y);
    return to;
}

/// Every pixel spreads as the average does, in all directions alike.
image<float> one_spread(const source& covariance) {
    double trace = 0;
    for (const int c : {0, 3, 5})
        for (int y = 0; y < covariance.size.height; ++y)
            for (int x = 0; x < covariance.size.width; ++x)
                if (const float v = covariance.channel(c).at(x, y); is_finite(v)) trace += v;
    image<float> same(covariance.size, 6);
    for (const int c : {0, 3, 5})
        for (int y = 0; y < covariance.size.height; ++y)
            for (int x = 0; x < covariance.size.width; ++x)
                same.at(x, y, c) = static_cast<float>(trace / (3 * static_cast<double>(covariance.size.pixels())));
    return same;
}

/// What the pre-filter leaves takes the place of what was there.
void replace(named_layers& frame, const std::array<cleaned_feature, 3>& by) {
    std::size_t i = 0;
    features::for_each([&](auto g) {
        const cleaned_feature& f = by[i++];
        frame.bind(g.name(), f.mean);
        frame.bind(variance(g).name(), f.variance);
        frame.bind(first_half(g).name(), f.half_a);
        frame.bind(second_half(g).name(), f.half_b);
    });
}

}  // namespace

denoise::scene scene_of(const simulator::result& render, int samples) {
    denoise::scene s;
    for (const char* guide : {"color", "albedo", "normal", "depth", "visibility", "caustic", "rest_position"}) {
        const std::string name = guide;
        if (!simulator::find_plane(render, name)) continue;
        denoise::buffer& b = s.guides[name];
        b.mean = simulator::plane_of(render, name);
        b.variance = simulator::plane_of(render, name + ".variance");
        b.half_a = simulator::plane_of(render, name + ".halfA");
        b.half_b = simulator::plane_of(render, name + ".halfB");
        if (name == "rest_position") b.covariance = simulator::plane_of(render, name + ".covariance");
    }
    s.samples = static_cast<float>(samples);
    return s;
}

void clean(cleaning how, named_layers& frame, int samples, int threads, workspace& memory, const target& bandwidths) {
    using estimator::noise;
    const executor::openmp executor{.threads = threads};
    const auto along_positions = [&](auto prefilter) {
        prefilter.numbers.samples = static_cast<float>(samples);
        replace(frame, prefilter(frame, executor, memory, bandwidths));
    };
    switch (how) {
        case cleaning::none:
            break;
        case cleaning::sure: {
            paper::sure_prefilter_of<features, rest_position_t, noise::anisotropic> f;
            f.numbers.guide_smoothing = 0.5f;
            f.numbers.restraint = 3;
            along_positions(f);
            break;
        }
        case cleaning::paper:
            along_positions(paper::sure_prefilter_of<features, rest_position_t>{});
            break;
        case cleaning::one_spread: {
            const image<float> same = one_spread(frame.find(covariance(rest_position)));
            const source own = frame.find(covariance(rest_position));
            frame.bind(covariance(rest_position).name(), same.view());
            along_positions(paper::sure_prefilter_of<features, rest_position_t>{});
            frame.bind(covariance(rest_position).name(), own);
            break;
        }
        case cleaning::nlm:
            replace(frame, paper::nlm_prefilter_of<features>{}(frame, executor, memory));
            break;
        case cleaning::bilateral:
            replace(frame, paper::bilateral_prefilter_of<features>{}(frame, executor, memory));
            break;
    }
}

filtered filter(const denoise::scene& render, const chosen_filter& filter, cleaning how, int samples, int threads,
                workspace& memory) {
    const denoise::filter_entry& entry = denoise::find_filter(filter.name);
    denoise::scene s = render;
    denoise::prepare(s, entry);
    denoise::scene_facts about{denoise::squared_mean(s.color().mean), s.half_share(), {}};
    for (const auto& guide : s.guides) about.has.insert(guide.first);
    const denoise::ready_filter ready = entry.make(entry.values(filter.set), about);

    filtered r;
    r.color = image<float>(s.color().mean.size(), 3);
    r.bandwidths = image<float>(r.color.size());
    named_layers frame = s.frame();
    const programs::stopwatch cleaning_since;
    clean(how, frame, samples, threads, memory, r.bandwidths.view());
    r.clean_seconds = cleaning_since.seconds();
    r.features = {copied(frame.find(albedo)), copied(frame.find(normal)), copied(frame.find(depth))};
    output out{r.color};
    const programs::stopwatch filtering_since;
    ready.run({frame, out, {}, denoise::default_executor(), threads, memory, {}});
    r.filter_seconds = filtering_since.seconds();
    return r;
}

std::array<image<float>, 3> features_in_range_of(const denoise::scene& of, const simulator::result& other) {
    std::array<image<float>, 3> mapped;
    std::size_t i = 0;
    features::for_each([&](auto g) {
        mapped[i] = simulator::plane_of(other, g.name());
        map_values(unit_range(g, of.guides.at(g.name()).mean.view()), mapped[i].view(), mapped[i].view());
        ++i;
    });
    return mapped;
}

}  // namespace sure_prefilter
