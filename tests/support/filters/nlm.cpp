// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/erase.hpp>
#include <support/filters.hpp>
#include <support/papers.hpp>
#include <winnow/estimator/residual_variance.hpp>
#include <winnow/paper/nlm_2012.hpp>

namespace winnow::test {

any_filter erased(const paper::nlm& f) { return erase("nlm", f); }
any_filter erased(const paper::nlm_2012& f) { return erase("nlm dual buffer", f); }
any_filter erased(const paper::nlm_2012_released& f) { return erase("nlm dual buffer, as released", f); }

any_filter nlm(filter_numbers n) {
    return erased(paper::make_nlm({.radius = n.radius, .patch_radius = n.patch_radius, .k = 0.45f}).with(n.border));
}

any_filter nlm_with_error(filter_numbers n) {
    return erase("nlm with error", paper::make_nlm({.radius = n.radius, .patch_radius = n.patch_radius, .k = 0.45f})
                                       .with(n.border)
                                       .with(estimator::residual_variance{}));
}

any_filter nlm_dual_buffer(filter_numbers n) {
    return erased(
        dual_buffer{paper::make_nlm({.radius = n.radius, .patch_radius = n.patch_radius, .k = 0.45f}).with(n.border)});
}

any_filter nlm_as_released(filter_numbers n) {
    return erased(
        dual_buffer{paper::make_nlm_2012_released({.radius = n.radius, .patch_radius = n.patch_radius, .k = 0.45f})
                        .filter.with(n.border)});
}

}  // namespace winnow::test
