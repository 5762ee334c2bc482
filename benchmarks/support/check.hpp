// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A benchmark checks the result of what it timed: a few windows of the image are filtered again by the definition.
#include <algorithm>
#include <cmath>
#include <string>
#include <winnow/executor/serial.hpp>
#include "support/scene.hpp"

namespace winnow::benchmarks {

/// The largest difference between `result` and serial<double> on three windows of 12x12 pixels, corners included;
/// halo is that of the filter.
template <class Filter>
double largest_error(const Filter& filter, int halo, const scene& s, const image<float>& result) {
    const extent size = s.color.size();
    double worst = 0;
    for (const auto& [x, y] :
         {std::pair{0, 0}, {size.width / 2 - 5, size.height / 2 - 3}, {size.width - 12, size.height - 12}}) {
        const rectangle window{x, y, x + 12, y + 12};
        rectangle region = window.grown(halo);
        region = {std::max(region.x0, 0), std::max(region.y0, 0), std::min(region.x1, size.width),
                  std::min(region.y1, size.height)};
        image<float> expected(region.size(), 3);
        filter(s.frame(region), output(expected), executor::serial<double>{});
        for (int c = 0; c < 3; ++c)
            for (int j = window.y0; j < window.y1; ++j)
                for (int i = window.x0; i < window.x1; ++i)
                    worst = std::max(worst, static_cast<double>(std::abs(
                                                result.at(i, j, c) - expected.at(i - region.x0, j - region.y0, c))));
    }
    return worst;
}

}  // namespace winnow::benchmarks
