// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The filters that every executor must run alike: the papers' and such as nobody would publish.
#include <support/any_filter.hpp>
#include <support/patterns.hpp>

namespace winnow::test {

struct filter_numbers {
    int radius = 3;
    int patch_radius = 1;
    winnow::border border = border::clip;
};

any_filter joint_bilateral(filter_numbers n = {});
any_filter bilateral(filter_numbers n = {});
any_filter nlm(filter_numbers n = {});
any_filter nlm_with_error(filter_numbers n = {});  ///< estimator::residual_variance
any_filter nlm_dual_buffer(filter_numbers n = {});
any_filter nlm_as_released(filter_numbers n = {});  ///< the mean of a weight over a patch
any_filter rdfc_candidate(filter_numbers n = {});
any_filter guided(filter_numbers n = {});               ///< no sum of weights; has one border rule, to clip
any_filter product_with_cutoff(filter_numbers n = {});  ///< 0 beyond a feature distance; a patch beside it
any_filter max_and_sum(filter_numbers n = {});          ///< max and sum of distances
any_filter disk(filter_numbers n = {});                 ///< a Gaussian blur over a disk
any_filter with_holes(filter_numbers n = {});           ///< a patch over a window whose offsets are 2 apart
any_filter opaque_patch(filter_numbers n = {});         ///< a patch hidden in a policy without decompose()
any_filter patch_of_patch(filter_numbers n = {});
any_filter mean_of_weights(filter_numbers n = {});   ///< over a patch, of a weight with a patch
any_filter two_patches(filter_numbers n = {});       ///< over different distances, of different radii
any_filter three_candidates(filter_numbers n = {});  ///< sharing a distance in patches of different radii
any_filter unlike_candidates(
    filter_numbers n = {});  ///< no patch, a patch, a patch of patches, a patch of hidden patches
std::vector<any_filter> parts_of_three_candidates(filter_numbers n = {});  ///< the same, one by one
std::vector<any_filter> parts_of_unlike_candidates(filter_numbers n = {});

std::vector<any_filter> all_filters(filter_numbers n = {});

}  // namespace winnow::test
