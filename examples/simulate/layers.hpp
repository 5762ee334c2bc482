// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Which planes of a render are written.
#include "entry.hpp"

namespace simulator {

/// The planes that a filter of `denoise` reads, halves of the colour included.  Fails for a name that is none.
std::vector<std::string> planes_of_filter(const std::string& filter);

/// Fails, by name, if a scene cannot give a plane; `wanted` are planes ("albedo.variance") or guides with everything
/// about them ("albedo").  `who` wants them.
void check_given(const entry& scene, const std::vector<std::string>& wanted, const std::string& who);

/// Whether a plane is among those wanted.  The colour always is, and everything if nothing is said.
bool is_wanted(const std::string& plane, const std::vector<std::string>& wanted);

/// Fails for an effect that is none; else the scenes that show it.
std::vector<const entry*> scenes_that_show(const std::string& effect);

}  // namespace simulator
