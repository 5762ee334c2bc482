// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The command line.
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <winnow/image/extent.hpp>

namespace denoise {

struct options {
    std::vector<std::string> inputs;
    std::string output;  ///< empty: only with diagnose
    std::string filter = "rdfc";
    std::string prefilter;                                 ///< that cleans the features first, if any
    std::vector<std::pair<std::string, std::string>> set;  ///< key, value
    std::vector<std::pair<std::string, std::string>> map;  ///< guide, layer
    std::vector<std::string> layers;                       ///< "all" alone means all
    bool outliers = true;    ///< taken out of the colour first, where there are halves or several renders
    bool do_no_harm = true;  ///< blends toward the input where the halves show harm
    std::string reference, error, selection;
    std::optional<winnow::rectangle> crop;
    std::string executor;
    int threads = 0;  ///< 0: as many as there are
    bool json = false, progress = false, diagnose = false;
};

/// What to do, or nothing where --help, --version or --list has been answered already.  Throws invalid_input with one
/// line for every misuse.
std::optional<options> parse(int argc, const char* const* argv);

}  // namespace denoise
