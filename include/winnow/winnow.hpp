// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The core of winnow for one CPU thread.  Faster executors, papers, metrics and files have headers of their own:
/// executor/{simd,openmp,pool}.hpp, paper/, metric/, io/.
#include <winnow/distance/chessboard.hpp>
#include <winnow/distance/combine.hpp>
#include <winnow/distance/cross_feature.hpp>
#include <winnow/distance/mahalanobis.hpp>
#include <winnow/distance/noise_normalized.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/distance/standardized.hpp>
#include <winnow/estimator/mahalanobis_sure.hpp>
#include <winnow/estimator/none.hpp>
#include <winnow/estimator/residual_variance.hpp>
#include <winnow/estimator/sure.hpp>
#include <winnow/executor/serial.hpp>
#include <winnow/filter/candidates.hpp>
#include <winnow/filter/dual_buffer.hpp>
#include <winnow/filter/filter.hpp>
#include <winnow/filter/prefiltered.hpp>
#include <winnow/frame/frame.hpp>
#include <winnow/frame/output.hpp>
#include <winnow/image/image.hpp>
#include <winnow/weight/b3_spline.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/cutoff.hpp>
#include <winnow/weight/exponential.hpp>
#include <winnow/weight/gaussian.hpp>
#include <winnow/weight/local_gaussian.hpp>
#include <winnow/weight/patch_mean.hpp>
#include <winnow/weight/shared.hpp>
#include <winnow/window/a_trous.hpp>
#include <winnow/window/disk.hpp>
#include <winnow/window/space_time.hpp>
#include <winnow/window/square.hpp>
