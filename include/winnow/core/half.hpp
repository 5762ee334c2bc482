// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// IEEE 754 half precision as storage: what renderers' files and GPU buffers hold.  Arithmetic is done in float.
#include <cstdint>
#include <winnow/core/platform.hpp>

namespace winnow {

/// 16 bits of memory, layout-compatible with Imath's and CUDA's half.
/// (The builtin is std::bit_cast's own; device code may call it without a flag.)
struct half {
    std::uint16_t bits = 0;

    half() = default;

    /// Rounds to nearest even; beyond 65504 becomes infinite.
    WINNOW_HD explicit half(float value) : bits(from_float(value)) {}

    WINNOW_HD operator float() const {
        // Scaling by 2^112 moves the exponent bias from 15 to 127 and makes subnormals come out right.
        const std::uint32_t magnitude = (bits & 0x7fffu) << 13;
        const float scaled = __builtin_bit_cast(float, magnitude) * 0x1p112f;
        const std::uint32_t special = (bits & 0x7c00u) == 0x7c00u ? 0x7f800000u : 0u;
        const std::uint32_t sign = (bits & 0x8000u) << 16;
        return __builtin_bit_cast(float, __builtin_bit_cast(std::uint32_t, scaled) | special | sign);
    }

private:
    WINNOW_HD static std::uint16_t from_float(float value) {
        const std::uint32_t raw = __builtin_bit_cast(std::uint32_t, value);
        const std::uint32_t sign = (raw >> 16) & 0x8000u;
        const std::uint32_t magnitude = raw & 0x7fffffffu;
        if (magnitude > 0x7f800000u) return static_cast<std::uint16_t>(sign | 0x7e00u);   // NaN
        if (magnitude >= 0x477ff000u) return static_cast<std::uint16_t>(sign | 0x7c00u);  // rounds past 65504
        if (magnitude < 0x38800000u) {                                                    // subnormal half
            // Adding 0.5 leaves the value, rounded to 2^-24, in the low mantissa bits.
            const float shifted = __builtin_bit_cast(float, magnitude) + 0.5f;
            return static_cast<std::uint16_t>(sign | (__builtin_bit_cast(std::uint32_t, shifted) - 0x3f000000u));
        }
        const std::uint32_t to_even = 0xfffu + ((magnitude >> 13) & 1u);
        return static_cast<std::uint16_t>(sign | ((magnitude - 0x38000000u + to_even) >> 13));
    }
};
static_assert(sizeof(half) == 2);

}  // namespace winnow
