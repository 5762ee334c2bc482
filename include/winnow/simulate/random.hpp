// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Random numbers that are a pure function of seed, pixel, sample and dimension: no state, no order, any thread.
#include <cstdint>
#include <type_traits>
#include <winnow/simulate/dimension.hpp>
#include <winnow/simulate/vector.hpp>

namespace winnow::simulate {

/// How the samples of a pixel lie among each other.
enum class pattern {
    stratified,  ///< Owen-scrambled (0,2)-sequences, two dimensions at a time (Kollig and Keller 2002; Burley 2020)
    independent  ///< plain random numbers
};

namespace detail {

/// Every bit of the result depends on every bit of x (the finaliser of splitmix64, Steele et al. 2014).
constexpr std::uint64_t mixed(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}
constexpr std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return mixed(a + 0x9e3779b97f4a7c15u * (b + 1)); }

constexpr std::uint32_t reversed(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// A random permutation in which each bit depends on the bits below it only (Laine and Karras 2011): Owen's scrambling
/// of a fraction whose bits are reversed.
constexpr std::uint32_t scrambled(std::uint32_t x, std::uint32_t key) {
    x += key;
    x ^= x * 0x9b7c2f1eu;
    x += (key >> 16) | (key << 16);
    x ^= x * 0x4d6a93b4u;
    x *= (key >> 8) | 1u;
    x ^= x * 0xd1e88a56u;
    return x ^ (x * 0x2c45fb62u);
}

/// The product of the index, as bits, with Pascal's triangle modulo 2: reversed, the second dimension of Sobol's
/// sequence.  The triangle of size 2n is three copies of that of size n, hence the halving.
constexpr std::uint32_t times_pascal(std::uint32_t x) {
    x ^= (x >> 16) & 0x0000ffffu;
    x ^= (x >> 8) & 0x00ff00ffu;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 2) & 0x33333333u;
    return x ^ ((x >> 1) & 0x55555555u);
}

constexpr double fraction(std::uint32_t bits) { return bits * 0x1p-32; }

}  // namespace detail

/// The numbers of one sample of one pixel.  Samples of even and of odd index come from independent sequences, so that
/// the half buffers of a film are independent as well.
class sample_numbers {
public:
    /// `frame` and `seed` tell sequences apart; index counts the samples of a pixel.
    sample_numbers(pattern p, std::uint64_t seed, int frame, int x, int y, int index)
        : pattern_(p), index_(static_cast<std::uint32_t>(index) / 2) {
        key_ = detail::mixed(seed, static_cast<std::uint64_t>(frame));
        key_ = detail::mixed(key_, (static_cast<std::uint64_t>(y) << 32) | static_cast<std::uint32_t>(x));
        key_ = detail::mixed(key_, static_cast<std::uint64_t>(index % 2));
    }

    /// The numbers of dimension D: one as double, two as vec2.  `vertex` counts from 1 and is 0 at the camera.
    template <class D>
    auto operator()(D, int vertex = 0) const {
        const int slot = D::slot + slots_per_vertex * vertex;
        // Slots that are stratified together share the order of their points, which an even slot names.
        const std::uint64_t pair = detail::mixed(key_, static_cast<std::uint64_t>(slot / 2));
        if constexpr (D::count == 2) return vec2(coordinate(pair, 0), coordinate(pair, 1));
        else return coordinate(pair, slot % 2);
    }

private:
    double coordinate(std::uint64_t key, int axis) const {
        const std::uint64_t own = detail::mixed(key, static_cast<std::uint64_t>(axis));
        if (pattern_ == pattern::independent)
            return detail::fraction(static_cast<std::uint32_t>(detail::mixed(own, index_)));
        // An order of the sequence in which each aligned block of 2^k points stays together, scrambled point by point.
        const auto order = static_cast<std::uint32_t>(key >> 32);
        const std::uint32_t i = detail::reversed(detail::scrambled(detail::reversed(index_), order));
        const std::uint32_t bits = axis == 0 ? i : detail::times_pascal(i);
        return detail::fraction(detail::reversed(detail::scrambled(bits, static_cast<std::uint32_t>(own))));
    }

    pattern pattern_;
    std::uint32_t index_;
    std::uint64_t key_;
};

/// The numbers that the effects of a scene draw; others do not exist.
template <class Effects, class Numbers = sample_numbers>
class random_numbers {
public:
    explicit random_numbers(const Numbers& numbers) : numbers_(numbers) {}

    template <class D>
    requires(Effects::template draws<D>) auto operator()(D, int vertex = 0) const { return numbers_(D{}, vertex); }

private:
    Numbers numbers_;
};

}  // namespace winnow::simulate
