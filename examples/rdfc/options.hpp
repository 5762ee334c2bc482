// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The command line.
#include <optional>
#include <simulate/entry.hpp>

#include "filter.hpp"

namespace rdfc {

struct options {
    std::string scene;
    simulator::job what;
    std::string folder;  ///< where the pictures go
    reading how;
    settings filter;
    bool adaptive = false;
    int iterations = 0;                   ///< 0: as many as have four samples per pixel each, from 2 to 4
    std::vector<std::string> references;  ///< one or two renders to measure against
    int reference_samples = 0;            ///< per pixel, of two references that are rendered; 0: none are
    bool json = false;
};

/// What to do, or nothing where --help or --version has been answered already.  Throws invalid_input with one line for
/// every misuse.
std::optional<options> parse(int argc, const char* const* argv);

}  // namespace rdfc
