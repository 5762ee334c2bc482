// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Images in which every value differs from every other, so that no mistake of indices goes unseen.
#include <cstdint>
#include <winnow/image/image.hpp>

namespace winnow::test {

/// A value in (0, 1] for each number, without visible order (a multiplicative hash); different numbers below 2^24 give
/// different values.
inline float scattered(std::uint32_t number) {
    return static_cast<float>(((number * 0x9e3779u) & 0xffffffu) + 1) * 0x1p-24f;
}

/// Values in (0, 1], all different; another seed gives another image.
inline image<> pattern(extent size, int channels = 1, std::uint32_t seed = 0) {
    image<> made(size, channels);
    std::uint32_t number = seed * 1000003u + 1;
    for (int c = 0; c < channels; ++c)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) made.at(x, y, c) = scattered(number++);
    return made;
}

}  // namespace winnow::test
