// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Two references of a scene, and the parts of the picture where an effect shows.
#include <OpenEXR/ImfStringAttribute.h>

#include <simulate/entry.hpp>
#include <winnow/frame/unit_range.hpp>
#include <winnow/io/exr.hpp>

namespace winnow::benchmarks {

/// Pixels that count; empty: all of them.
using mask = std::vector<bool>;

class truth {
public:
    /// Reads FOLDER/SCENE_1.exr and FOLDER/SCENE_2.exr, as `simulate --references FOLDER` makes them; fails where they
    /// are of another version of the scene.
    truth(const std::string& folder, const simulator::entry& scene) {
        const std::string fingerprint = std::to_string(scene.fingerprint()) + " ";
        for (const char* number : {"_1", "_2"}) {
            const std::string name = folder + "/" + scene.name() + number + ".exr";
            const io::exr_image file = io::read_exr(name);
            const auto* said = file.header().findTypedAttribute<Imf::StringAttribute>("winnow:fingerprint");
            if (!said || !said->value().starts_with(fingerprint))
                fail(name + " is of another " + scene.name() + ": make it anew by simulate --references " + folder);
            colors_.push_back(file.read({"R", "G", "B"}));
            if (visibility_.channels() > 0) continue;
            if (file.find("visibility.V")) visibility_ = file.read({"visibility.V"});
            if (file.find("caustic.V")) caustic_ = file.read({"caustic.V"});
        }
    }

    extent size() const { return colors_[0].size(); }
    bool has_caustics() const { return caustic_.channels() > 0; }

    /// Half shadow: where some of the lights is seen, not always.
    mask penumbra() const {
        return where(visibility_, [](float v) { return v > 0.05f && v < 0.95f; });
    }
    /// Where it is seen a tenth more or less often two pixels on.
    mask shadow_edges() const {
        if (visibility_.channels() == 0) return {};
        image<float> change(size());
        for (int y = 0; y < size().height; ++y)
            for (int x = 0; x < size().width; ++x) {
                const float right = visibility_.at(std::min(x + 2, size().width - 1), y),
                            below = visibility_.at(x, std::min(y + 2, size().height - 1));
                change.at(x, y) =
                    std::max(std::abs(right - visibility_.at(x, y)), std::abs(below - visibility_.at(x, y)));
            }
        return where(change, [](float c) { return c > 0.1f; });
    }
    /// Where there are more photons than in nine tenths of the picture.
    mask caustics() const {
        if (!has_caustics()) return {};
        const float least = detail::quantile(caustic_.view(), {}, 0.9);
        return where(caustic_, [least](float v) { return v > least; });
    }

    /// The relative mean squared error, with an epsilon of 0.01, as the product of the errors against both references:
    /// their own noise cancels.  NaN where no pixel counts.
    double relative_mse(const image<float>& x, const mask& counts = {}) const {
        double sum = 0;
        std::int64_t n = 0;
        for (int c = 0; c < 3; ++c)
            for (int j = 0; j < size().height; ++j)
                for (int i = 0; i < size().width; ++i) {
                    if (!counts.empty() && !counts[index(i, j)]) continue;
                    const double r1 = colors_[0].at(i, j, c), r2 = colors_[1].at(i, j, c), y = (r1 + r2) / 2;
                    sum += (x.at(i, j, c) - r1) * (x.at(i, j, c) - r2) / (y * y + 0.01), ++n;
                }
        return sum / static_cast<double>(n);
    }

private:
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * size().width + x; }
    template <class Counts>
    mask where(const image<float>& plane, const Counts& counts) const {
        if (plane.channels() == 0) return {};
        mask all(static_cast<std::size_t>(size().pixels()));
        for (int y = 0; y < size().height; ++y)
            for (int x = 0; x < size().width; ++x) all[index(x, y)] = counts(plane.at(x, y));
        return all;
    }

    std::vector<image<float>> colors_;
    image<float> visibility_, caustic_;  ///< without channels where the scene does not give them
};

}  // namespace winnow::benchmarks
