// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The images that came out of a film.
#include <array>
#include <winnow/frame/frame.hpp>
#include <winnow/image/image.hpp>

namespace winnow {

template <class Planes>
class developed;

/// One image for each plane of the list, each found by its name:  `images[variance(color)]`.
template <class... G>
class developed<planes<G...>> {
public:
    explicit developed(extent size) : images_{image<float>(size, G::channels)...} {}

    template <guide H>
    requires contains<H, planes<G...>>
    const image<float>& operator[](H) const { return images_[index<H>]; }
    template <guide H>
    requires contains<H, planes<G...>> image<float>
    &operator[](H) { return images_[index<H>]; }

    /// The image of the plane of that number in the list.
    image<float>& number(std::size_t i) { return images_[i]; }

    /// What filters read.  It looks at these images, which must outlive it.
    winnow::frame<G...> frame() const& { return {bound<G>{source((*this)[G{}].view())}...}; }
    winnow::frame<G...> frame() const&& = delete;

    /// f(guide, image) for each plane, in the order of the list.
    template <class F>
    void for_each(F f) const {
        (f(G{}, (*this)[G{}]), ...);
    }
    template <class F>
    void for_each(F f) {
        (f(G{}, (*this)[G{}]), ...);
    }

private:
    template <class H>
    static constexpr std::size_t index = [] {
        std::size_t at = 0;
        bool found = false;
        ((found = found || std::is_same_v<H, G>, at += !found), ...);
        return at;
    }();

    std::array<image<float>, sizeof...(G)> images_;
};

}  // namespace winnow
