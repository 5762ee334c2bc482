// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// Time of the SURE pre-filter of seven planes of features with both their halves, in its ways, and of the search for
/// bandwidths within it; SBF beside, of whose time it is to be a small share.
#include <winnow/paper/sbf_2012.hpp>
#include <winnow/paper/sure_prefilter_2017.hpp>

#include "support/pipeline.hpp"

namespace {

using namespace winnow;

/// The cleaned albedo as the result of a filter.
template <class Prefilter>
struct cleaned_albedo {
    Prefilter prefilter;

    template <class Frame, class Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory) const {
        const source clean = prefilter(in, executor, memory)[0].mean;
        for_each_row(executor, clean.size, [&](int y) {
            for (int c = 0; c < 3; ++c)
                for (int x = 0; x < clean.size.width; ++x) out.mean().channel(c).set(x, y, clean.channel(c).at(x, y));
        });
    }
    template <class Frame, class Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }
    friend int halo(const cleaned_albedo& f) { return halo(f.prefilter); }
};

template <class Prefilter>
void add(const std::string& name, const Prefilter& f) {
    benchmarks::add_pipeline(name, cleaned_albedo<Prefilter>{f}, false, 1e-4);
}

}  // namespace

int main(int argc, char** argv) {
    using features = planes<albedo_t, normal_t, depth_t>;
    add("SURE pre-filter", paper::sure_prefilter{{.noise = paper::noise_left::by_whole}});
    add("SURE pre-filter, halves by themselves", paper::sure_prefilter{});
    paper::sure_prefilter_of<features, position_t, estimator::noise::anisotropic> all_directions;
    all_directions.numbers.noise = paper::noise_left::by_whole;
    add("SURE pre-filter, anisotropic", all_directions);
    all_directions.numbers.guide_smoothing = 0.5f;
    all_directions.numbers.restraint = 3;
    add("SURE pre-filter, anisotropic, restrained", all_directions);
    benchmarks::add_pipeline("SBF, scales 1 2 4", paper::sbf{}, false, 2e-5);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
