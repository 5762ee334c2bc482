// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Sizes and rectangles in pixels.
#include <cstdint>
#include <string>

namespace winnow {

/// Width and height in pixels.
struct extent {
    int width = 0;
    int height = 0;

    std::int64_t pixels() const { return std::int64_t{width} * height; }
    bool operator==(const extent&) const = default;
};

/// "640x480", as messages print it.
inline std::string to_string(extent e) { return std::to_string(e.width) + "x" + std::to_string(e.height); }

/// The pixels x0 <= x < x1, y0 <= y < y1; coordinates outside the image are allowed.
struct rectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    extent size() const { return {x1 - x0, y1 - y0}; }
    rectangle grown(int by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
    bool operator==(const rectangle&) const = default;
};

}  // namespace winnow
