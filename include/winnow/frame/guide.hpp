// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Guides: the names of a frame's buffers.  A guide holds no data; `albedo = view` binds it to some.
#include <concepts>
#include <string>
#include <type_traits>
#include <winnow/core/role.hpp>
#include <winnow/image/plane.hpp>

namespace winnow {

/// A named buffer with a fixed number of channels.
template <class G>
concept guide = plays<G, role::guide> && requires {
    { G::channels + 0 } -> std::same_as<int>;
    { G::name() } -> std::convertible_to<std::string>;
};

/// A guide together with the caller's memory.
template <class G>
struct bound {
    using guide = G;
    source layer;
};

/// One pixel's value as a renderer holds it: a number, or anything with [0], [1], [2].
template <class V>
concept pixel_value = std::convertible_to<V, double> || requires(const V& v) {
    { v[0] } -> std::convertible_to<double>;
};

/// A guide together with the value of one sample; lives no longer than the call that it is passed to.
template <class G, class V>
struct valued {
    using guide = G;
    const V& value;

    double operator[]([[maybe_unused]] int c) const {
        if constexpr (std::convertible_to<V, double>) return static_cast<double>(value);
        else return static_cast<double>(value[c]);
    }
};

/// Base of every guide: gives `guide = view` for frames and `guide = value` for samples.
template <class Self, int Channels>
struct guide_named {
    using role = winnow::role::guide;
    static constexpr int channels = Channels;

    template <class View>
    requires std::constructible_from<source, const View&>
    constexpr bound<Self> operator=(const View& view) const { return {source(view)}; }
    template <pixel_value V>
    constexpr valued<Self, V> operator=(const V& value) const {
        return {value};
    }
    bool operator==(const guide_named&) const = default;
};

#define WINNOW_GUIDE(NAME, CHANNELS)                      \
    struct NAME##_t : guide_named<NAME##_t, CHANNELS> {   \
        using guide_named<NAME##_t, CHANNELS>::operator=; \
        static std::string name() { return #NAME; }       \
        bool operator==(const NAME##_t&) const = default; \
    };                                                    \
    inline constexpr NAME##_t NAME {}

WINNOW_GUIDE(color, 3);       ///< radiance: linear, scene-referred, unclamped
WINNOW_GUIDE(albedo, 3);      ///< reflectance at the first hit
WINNOW_GUIDE(normal, 3);      ///< shading normal at the first hit; a mean of unit vectors, not renormalised
WINNOW_GUIDE(depth, 1);       ///< distance along the ray, or view-space z; the same convention everywhere
WINNOW_GUIDE(position, 3);    ///< first hit, relative to the camera, in world units
WINNOW_GUIDE(visibility, 1);  ///< unoccluded shadow rays over all shadow rays
WINNOW_GUIDE(roughness, 1);   ///< perceptual roughness: the square root of the GGX alpha

/// Whether G is a point of the world: films keep it relative to their origin.
template <class G>
inline constexpr bool is_point = std::is_same_v<G, position_t>;

/// The variance of the pixel mean of G, channel by channel.
template <guide G>
struct variance_of : guide_named<variance_of<G>, G::channels> {
    using guide_named<variance_of<G>, G::channels>::operator=;
    static std::string name() { return G::name() + ".variance"; }
    bool operator==(const variance_of&) const = default;
};

/// The covariance of the samples of G about their mean, divided by n: the spread of one sample, not of the mean.  The
/// upper triangle row by row: xx, xy, xz, yy, yz, zz.
template <guide G>
struct covariance_of : guide_named<covariance_of<G>, G::channels*(G::channels + 1) / 2> {
    using guide_named<covariance_of<G>, G::channels*(G::channels + 1) / 2>::operator=;
    static std::string name() { return G::name() + ".covariance"; }
    bool operator==(const covariance_of&) const = default;
};

/// The mean of G over the first or the second half of the samples.
template <guide G>
struct half_a : guide_named<half_a<G>, G::channels> {
    using guide_named<half_a<G>, G::channels>::operator=;
    static std::string name() { return G::name() + ".halfA"; }
    bool operator==(const half_a&) const = default;
};
template <guide G>
struct half_b : guide_named<half_b<G>, G::channels> {
    using guide_named<half_b<G>, G::channels>::operator=;
    static std::string name() { return G::name() + ".halfB"; }
    bool operator==(const half_b&) const = default;
};

template <guide G>
constexpr variance_of<G> variance(G) {
    return {};
}
template <guide G>
constexpr covariance_of<G> covariance(G) {
    return {};
}
template <guide G>
constexpr half_a<G> first_half(G) {
    return {};
}
template <guide G>
constexpr half_b<G> second_half(G) {
    return {};
}

/// The squared contrast of G at a pixel, derived by the executor from G itself: per axis the smaller of the squared
/// one-sided half differences, ((f(p+1)-f(p))/2)^2 and ((f(p)-f(p-1))/2)^2, summed over both axes; an axis along which
/// p is at the border of the image contributes 0.
template <guide G>
struct gradient_of : guide_named<gradient_of<G>, G::channels> {
    static std::string name() { return G::name() + ".gradient"; }
    bool operator==(const gradient_of&) const = default;
};

}  // namespace winnow
