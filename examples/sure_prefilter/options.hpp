// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The command line.
#include <optional>

#include "features.hpp"

namespace sure_prefilter {

struct options {
    std::string scene;
    simulator::job what;
    std::string folder;  ///< where the pictures go
    chosen_filter filter{"rdfc", {}};
    cleaning how = cleaning::sure;
    int reference_samples = 0;  ///< per pixel, of two references that are rendered; 0: none are
    bool json = false;
};

/// What to do, or nothing where --help or --version has been answered already.  Throws invalid_input with one line for
/// every misuse.
std::optional<options> parse(int argc, const char* const* argv);

}  // namespace sure_prefilter
