// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/erase.hpp>
#include <support/filters.hpp>
#include <support/papers.hpp>
#include <winnow/paper/rdfc_2013.hpp>

namespace winnow::test {

namespace {
auto first(filter_numbers n) {
    return paper::make_rdfc_candidate(
               {.radius = n.radius, .patch_radius = n.patch_radius, .k_color = 0.45f, .k_feature = 0.6f})
        .with(n.border);
}
auto second(filter_numbers n) {
    return paper::make_rdfc_candidate(
               {.radius = n.radius, .patch_radius = n.patch_radius + 2, .k_color = 0.45f, .k_feature = 0.6f})
        .with(n.border);
}
auto third(filter_numbers n) {
    return filter{exponential(max(cross(albedo, {.tau = 1e-4f}), cross(normal, {.tau = 1e-4f}))),
                  window::square{.radius = n.radius}}
        .with(n.border);
}
}  // namespace

any_filter erased(const paper::rdfc_candidate& f) { return erase("rdfc candidate", f); }

any_filter rdfc_candidate(filter_numbers n) { return erased(first(n)); }

any_filter three_candidates(filter_numbers n) {
    return erase("three candidates", candidates{first(n), second(n), third(n)});
}

std::vector<any_filter> parts_of_three_candidates(filter_numbers n) {
    return {erase("first", first(n)), erase("second", second(n)), erase("third", third(n))};
}

}  // namespace winnow::test
