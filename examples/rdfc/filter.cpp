// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "filter.hpp"

#include <winnow/executor/openmp.hpp>
#include <winnow/paper/rdfc_2013.hpp>
#include <winnow/paper/rdfc_2013_adaptive.hpp>

namespace rdfc {

using namespace winnow;

namespace {

/// One candidate everywhere, to see what the selection is worth.
template <int Candidate>
struct only {
    static constexpr int statistics = 3;  ///< the error of each candidate
    int error_radius = 1, map_radius = 0;

    static std::array<float, 3> gather(const paper::rdfc_candidates_pixel& pixel) {
        return paper::binary_maps::gather(pixel);
    }
    static std::array<float, 3> decide(const std::array<float, 3>&, const paper::rdfc_candidates_pixel&) {
        std::array<float, 3> map{};
        map[Candidate] = 1;
        return map;
    }
    static float error(const std::array<float, 3>& error, const std::array<float, 3>&) { return error[Candidate]; }
};

executor::openmp executor_of(const settings& s) { return {.threads = s.threads}; }

template <class Selection>
filtered run(const guides& in, const settings& s, workspace& memory, const image<float>* counts) {
    paper::rdfc_of<features, Selection> f;
    f.numbers = {.radius = s.radius,
                 .k_color = s.k_color,
                 .k_feature = s.k_feature,
                 .tau = s.tau,
                 .tau_third = s.tau_third,
                 .epsilon = in.epsilon(s.epsilon),
                 .feature_radius = s.feature_radius,
                 .feature_share = s.feature_share};
    if (s.error_radius >= 0) f.selection.error_radius = s.error_radius;
    filtered r{image<float>(in.size(), 3), image<float>(in.size(), 3), {}};
    output out{r.color};
    if (!counts) {
        f(in.layers(), out, executor_of(s), memory, r.share.view());
        return r;
    }
    image<float> error(in.size(), 3), weights(in.size()), samples(in.size());
    out.error(error.view()).support(weights.view()).layer(counts->view(), samples.view());
    f(in.layers(), out, executor_of(s), memory, r.share.view());
    r.density = image<float>(in.size());
    paper::rdfc_sampling_density density;
    density(in.layers(),
            {.filtered = r.color.view(),
             .squared_error = error.view(),
             .weights = weights.view(),
             .samples = samples.view()},
            r.density.view(), executor_of(s), memory);
    return r;
}

}  // namespace

settings::settings() {
    const paper::rdfc_numbers n;
    radius = n.radius, feature_radius = n.feature_radius;
    k_color = n.k_color, k_feature = n.k_feature;
    tau = n.tau, tau_third = n.tau_third;
    epsilon = n.epsilon, feature_share = n.feature_share;
}

filtered filter(const guides& in, const settings& s, workspace& memory, const image<float>* counts) {
    switch (s.choice) {
        case selection::blend:
            return run<paper::convex_blend>(in, s, memory, counts);
        case selection::first:
            return run<only<0>>(in, s, memory, counts);
        case selection::second:
            return run<only<1>>(in, s, memory, counts);
        case selection::third:
            return run<only<2>>(in, s, memory, counts);
        case selection::binary:
            break;
    }
    return run<paper::binary_maps>(in, s, memory, counts);
}

}  // namespace rdfc
