// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "prefilter.hpp"

#include <support/nearest.hpp>
#include <winnow/paper/feature_prefilters.hpp>
#include <winnow/paper/sure_prefilter_2017.hpp>

#include "entry.hpp"

namespace denoise {

namespace {

using features = planes<albedo_t, normal_t, depth_t, position_t>;

/// Runs a pre-filter on the features that the frame has, and puts what it leaves in their place.
template <class Prefilter>
void run(const Prefilter& prefilter, named_layers& frame, const std::string& executor, int threads, workspace& memory) {
    named_layers complete = frame;
    const extent size = frame.find(color).size;
    static constexpr float nothing = 0;  // a feature that is not there is the same everywhere
    features::for_each([&](auto g) {
        if (!frame.find(g)) complete.bind(g.name(), image_view<const float>(&nothing, size, g.channels, strides{}));
    });
    with_executor(executor, threads, [&](const auto& e) {
        const auto cleaned = prefilter(complete, e, memory);
        std::size_t i = 0;
        features::for_each([&](auto g) {
            const cleaned_feature& f = cleaned[i++];
            if (!frame.find(g)) return;
            frame.bind(g.name(), f.mean);
            frame.bind(variance(g).name(), f.variance);
            frame.bind(first_half(g).name(), f.half_a);
            frame.bind(second_half(g).name(), f.half_b);
        });
    });
}

template <class Prefilter, class Make>
prefilter_entry entry(const char* name, const char* summary, bool positions, const Make& make) {
    return {name, summary, positions, halo(make(1.0f)),
            [make](named_layers& frame, float samples, const std::string& executor, int threads, workspace& memory) {
                run(make(samples), frame, executor, threads, memory);
            }};
}

}  // namespace

const std::vector<prefilter_entry>& prefilters() {
    using sure = paper::sure_prefilter_of<features, rest_position_t, estimator::noise::anisotropic>;
    using nlm = paper::nlm_prefilter_of<features>;
    using bilateral = paper::bilateral_prefilter_of<features>;
    static const std::vector<prefilter_entry> all{
        entry<sure>("sure", "along the positions of a pixel's samples; against blur of lens and motion", true,
                    [](float samples) {
                        sure f;
                        f.numbers.samples = samples;
                        f.numbers.guide_smoothing = 0.5f;
                        f.numbers.restraint = 3;
                        return f;
                    }),
        entry<nlm>("nlm", "where its surroundings are alike but for noise", false, [](float) { return nlm{}; }),
        entry<bilateral>("bilateral", "where its values are alike", false, [](float) { return bilateral{}; })};
    return all;
}

const prefilter_entry& find_prefilter(const std::string& name) {
    std::vector<std::string> known;
    for (const prefilter_entry& f : prefilters()) {
        if (f.name == name) return f;
        known.push_back(f.name);
    }
    fail("there is no pre-filter " + name + programs::did_you_mean(name, known));
}

}  // namespace denoise
