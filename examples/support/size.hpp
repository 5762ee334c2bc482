// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The size of an image on a command line.
#include <charconv>
#include <string>
#include <winnow/core/error.hpp>
#include <winnow/image/extent.hpp>

namespace programs {

/// What follows --size, as in 256x192.  Throws invalid_input for anything else, and where there are no pixels.
inline winnow::extent parse_size(const std::string& said) {
    winnow::extent size;
    const char* end = said.data() + said.size();
    const auto [x, wrong_width] = std::from_chars(said.data(), end, size.width);
    if (wrong_width != std::errc() || x == end || *x != 'x') winnow::fail("--size " + said + ": expected WIDTHxHEIGHT");
    const auto [rest, wrong_height] = std::from_chars(x + 1, end, size.height);
    if (wrong_height != std::errc() || rest != end) winnow::fail("--size " + said + ": expected WIDTHxHEIGHT");
    if (size.width < 1 || size.height < 1) winnow::fail("--size " + said + ": there are no pixels");
    return size;
}

}  // namespace programs
