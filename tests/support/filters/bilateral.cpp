// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/erase.hpp>
#include <support/filters.hpp>
#include <support/papers.hpp>
#include <winnow/distance/combine.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/weight/exponential.hpp>
#include <winnow/window/disk.hpp>

namespace winnow::test {

any_filter erased(const paper::joint_bilateral& f) { return erase("joint bilateral", f); }
any_filter erased(const paper::bilateral& f) { return erase("bilateral", f); }

any_filter joint_bilateral(filter_numbers n) {
    return erased(paper::make_joint_bilateral(
                      {.radius = n.radius, .sigma_spatial = 5, .sigma_albedo = 0.1f, .sigma_normal = 0.2f})
                      .with(n.border));
}

any_filter bilateral(filter_numbers n) {
    return erased(paper::make_bilateral({.radius = n.radius, .sigma_spatial = 5, .sigma_color = 0.3f}).with(n.border));
}

any_filter max_and_sum(filter_numbers n) {
    return erase("max and sum", filter{gaussian(max(l2(color), l2(albedo), l2(depth)) + l2(normal), 0.4f) *
                                           exponential(l2(albedo) + l2(depth)),
                                       window::square{.radius = n.radius}}
                                    .with(n.border));
}

any_filter disk(filter_numbers n) {
    return erase("disk", filter{gaussian(spatial, 2.0f), window::disk{.radius = n.radius}}.with(n.border));
}

}  // namespace winnow::test
