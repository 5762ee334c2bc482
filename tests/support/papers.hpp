// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The papers' filters, with any numbers, as any_filter.
#include <support/any_filter.hpp>
#include <winnow/estimator/residual_variance.hpp>
#include <winnow/paper/a_trous_2010.hpp>
#include <winnow/paper/guided_2010.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/paper/rdfc_2013.hpp>
#include <winnow/paper/sbf_2012.hpp>
#include <winnow/paper/wlr_2014.hpp>

namespace winnow::test {

any_filter erased(const paper::joint_bilateral& f);
any_filter erased(const paper::bilateral& f);
any_filter erased(const paper::nlm& f);
any_filter erased(const paper::nlm_2012& f);
any_filter erased(const paper::nlm_2012_released& f);
any_filter erased(const paper::rdfc_candidate& f);
any_filter erased(const paper::sbf& f);
any_filter erased(const paper::a_trous_of<planes<normal_t, depth_t>>& f);

any_filter erased(const paper::guided& f);
using guided_by_color = paper::guided_of<planes<color_t>>;
any_filter erased(const guided_by_color& f);
using guided_with_error = paper::guided_of<planes<albedo_t, normal_t, depth_t>, estimator::residual_variance>;
any_filter erased(const guided_with_error& f);
any_filter erased(const paper::wlr& f);

}  // namespace winnow::test
