// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// An example of every policy.  A policy that is listed here is held to all laws of its role; a test fails for one
/// that is not.
#include <tuple>
#include <winnow/winnow.hpp>

namespace winnow::test {

using distances = std::tuple<distance::spatial, distance::chessboard,                                                //
                             distance::squared_difference<albedo_t>,                                                 //
                             distance::noise_normalized<color_t>,                                                    //
                             distance::cross_feature<normal_t>,                                                      //
                             distance::standardized<normal_t>,                                                       //
                             distance::patch<distance::noise_normalized<color_t>>,                                   //
                             distance::patch<distance::patch<distance::squared_difference<color_t>>>,                //
                             distance::max_of<distance::cross_feature<albedo_t>, distance::cross_feature<depth_t>>,  //
                             distance::sum_of<distance::noise_normalized<color_t>, distance::spatial>,               //
                             distance::mahalanobis<position_t>>;
inline const distances distance_examples{spatial,
                                         chessboard,
                                         l2(albedo),
                                         noise_normalized(color, {.k = 0.45f}),
                                         cross(normal, {.k = 0.6f, .tau = 1e-3f}),
                                         standardized(normal, {.floor = 1e-2f, .spread = 2}),
                                         patch(noise_normalized(color), {.radius = 1}),
                                         patch(patch(l2(color), {.radius = 1}), {.radius = 1}),
                                         max(cross(albedo), cross(depth, {.tau = 1e-4f})),
                                         noise_normalized(color) + spatial,
                                         mahalanobis(position)};

using weights = std::tuple<
    weight::b3_spline,                                                                              //
    weight::shared<weight::gaussian<distance::squared_difference<albedo_t>>>,                       //
    weight::gaussian<distance::spatial>,                                                            //
    weight::gaussian<distance::noise_normalized<color_t>>,                                          //
    weight::exponential<distance::squared_difference<albedo_t>>,                                    //
    weight::exponential<distance::patch<distance::noise_normalized<color_t>>>,                      //
    weight::cutoff<distance::spatial>,                                                              //
    weight::cutoff<distance::noise_normalized<color_t>>,                                            //
    weight::patch_mean<weight::exponential<distance::patch<distance::noise_normalized<color_t>>>>,  //
    weight::min_of<weight::exponential<distance::noise_normalized<color_t>>,
                   weight::exponential<distance::cross_feature<normal_t>>>,                                          //
    weight::min_of<weight::cutoff<distance::spatial>, weight::gaussian<distance::squared_difference<albedo_t>>>,     //
    weight::product_of<weight::gaussian<distance::spatial>, weight::exponential<distance::cross_feature<depth_t>>>,  //
    weight::product_of<weight::gaussian<distance::squared_difference<color_t>>, weight::cutoff<distance::spatial>>,  //
    weight::local_gaussian<distance::squared_difference<depth_t>, bandwidth_t>>;
inline const weights weight_examples{
    weight::b3_spline{.step = 2},
    shared(gaussian(l2(albedo), 0.2f)),
    gaussian(spatial, 1.5f),
    gaussian(noise_normalized(color), 0.7f),
    exponential(l2(albedo)),
    exponential(patch(noise_normalized(color), {.radius = 1})),
    cutoff(spatial, 2),
    cutoff(noise_normalized(color), 0.5f),
    patch_mean(exponential(patch(noise_normalized(color), {.radius = 1})), {.radius = 1}),
    min(exponential(noise_normalized(color)), exponential(cross(normal))),
    min(cutoff(spatial, 4), gaussian(l2(albedo), 0.3f)),
    gaussian(spatial, 2) * exponential(cross(depth)),
    gaussian(l2(color), 0.5f) * cutoff(spatial, 4),
    gaussian(l2(depth), bandwidth)};

using windows = std::tuple<window::square, window::disk, window::space_time, window::a_trous>;
inline constexpr windows window_examples{{.radius = 3}, {.radius = 4}, {.radius = 2, .frames = 1}, {.level = 2}};

using estimators = std::tuple<estimator::none, estimator::residual_variance, estimator::sure<>,
                              estimator::mahalanobis_sure<position_t>>;
inline constexpr estimators estimator_examples{};

}  // namespace winnow::test
