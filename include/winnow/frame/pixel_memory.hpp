// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How much memory something takes that keeps so many bytes of each pixel; refused before it is asked for.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <winnow/core/error.hpp>
#include <winnow/image/extent.hpp>

namespace winnow::detail {

/// Bytes for `count` things of `each` bytes in every pixel.  Fails where a number is not positive, or where no machine
/// has that much.
inline std::size_t pixel_memory(const char* what, extent size, std::int64_t count, std::size_t each) {
    const std::string shown = std::string(what) + " of " + to_string(size) + " pixels";
    if (size.width < 1 || size.height < 1) fail(shown + " has no pixels");
    if (count < 1) fail(shown + " with " + std::to_string(count) + " samples in each has no samples");
    constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max();
    const std::size_t pixels = static_cast<std::size_t>(size.pixels());
    if (static_cast<std::size_t>(count) > most / each || pixels > most / (count * each))
        fail(shown + " at " + std::to_string(each) + " bytes" +
             (count > 1 ? " for each of " + std::to_string(count) + " samples" : std::string(" each")) +
             " is more than can be addressed");
    return pixels * count * each;
}

}  // namespace winnow::detail
