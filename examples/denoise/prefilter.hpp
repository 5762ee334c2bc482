// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Pre-filters: they clean the features before any filter sees them.
#include <string>
#include <vector>

#include "filters.hpp"

namespace denoise {

struct prefilter_entry {
    std::string name;
    std::string summary;
    bool positions;  ///< whether it needs them, and their covariance
    int halo;
    /// Cleans the features of the frame that `features` names; `samples` are those of a pixel.  The frame is left with
    /// the cleaned ones, which live in the workspace.
    std::function<void(winnow::named_layers& frame, float samples, const std::string& executor, int threads,
                       winnow::workspace& memory)>
        run;
};

const std::vector<prefilter_entry>& prefilters();
/// Fails with the nearest name where there is no such pre-filter.
const prefilter_entry& find_prefilter(const std::string& name);

}  // namespace denoise
