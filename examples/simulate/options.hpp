// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The command line.
#include <optional>

#include "entry.hpp"

namespace simulator {

struct options {
    std::string scene;
    job what;
    std::string output;                   ///< empty: nothing but samples is written
    std::vector<std::string> layers;      ///< empty: all
    std::string filter;                   ///< write what this filter reads
    std::vector<std::string> references;  ///< one or two renders to measure against
    std::string folder;                   ///< where the references of all scenes go
    bool sized = false, sampled = false;  ///< --size and --spp were said
    bool json = false, progress = false;
};

/// What to do, or nothing where --help, --version or --list has been answered already.  Throws invalid_input with one
/// line for every misuse.
std::optional<options> parse(int argc, const char* const* argv);

}  // namespace simulator
