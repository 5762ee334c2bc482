// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What a pre-filter makes of a frame: the same, with clean features.
#include <tuple>
#include <winnow/frame/frame.hpp>

namespace winnow {

/// A feature without its noise: what is left of that shows in the variance of its mean and in its halves.  A pre-filter
/// that knows nothing of them leaves these empty.
struct cleaned_feature {
    source mean, variance, half_a, half_b;
};

/// The frame with cleaned features in place of its own; of these nothing but the cleaned is seen, so that no filter
/// takes a variance from before for one from after.  Both must outlive it.
template <class Frame, class Features>
struct cleaned_frame;

template <class Frame, guide... Feature>
struct cleaned_frame<Frame, planes<Feature...>> {
    const Frame& in;
    std::array<cleaned_feature, sizeof...(Feature)> features;

    template <guide H>
    static constexpr bool has(H) {
        return is_cleaned(H{}) || Frame::has(H{});
    }
    template <guide H>
    source find(H) const {
        if constexpr (is_cleaned(H{})) {
            source found;
            int index = 0;
            ((found = found ? found : part<Feature>(H{}, features[static_cast<std::size_t>(index++)])), ...);
            return found;
        } else {
            return in.find(H{});
        }
    }

private:
    template <guide H>
    static constexpr bool is_cleaned(H) {
        return ((std::is_same_v<H, Feature> || std::is_same_v<H, variance_of<Feature>> ||
                 std::is_same_v<H, half_a<Feature>> || std::is_same_v<H, half_b<Feature>>) ||
                ...);
    }
    template <guide G, guide H>
    static source part(H, const cleaned_feature& f) {
        if constexpr (std::is_same_v<H, G>) return f.mean;
        else if constexpr (std::is_same_v<H, variance_of<G>>) return f.variance;
        else if constexpr (std::is_same_v<H, half_a<G>>) return f.half_a;
        else if constexpr (std::is_same_v<H, half_b<G>>) return f.half_b;
        else return {};
    }
};

}  // namespace winnow
