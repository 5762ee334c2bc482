// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Two independent references of each scene, rendered once.
#include "options.hpp"

namespace simulator {

/// Writes FOLDER/SCENE_1.exr and FOLDER/SCENE_2.exr, where they are not there already for the same scene, size,
/// samples, frame and pattern.  Stops early, with no file half-written, when `progress.cancel` is set.
void make_references(const options& o, winnow::simulate::render_progress& progress);

}  // namespace simulator
