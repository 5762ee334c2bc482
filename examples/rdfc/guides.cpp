// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "guides.hpp"

#include <algorithm>
#include <limits>
#include <simulate/output.hpp>
#include <winnow/frame/outliers.hpp>
#include <winnow/frame/unit_range.hpp>

namespace rdfc {

using namespace winnow;
using simulator::find_plane;
using simulator::plane_of;

namespace {

bool contains(const std::vector<std::string>& all, const std::string& name) {
    return std::find(all.begin(), all.end(), name) != all.end();
}

double mean_of(const image<float>& i) {
    double sum = 0;
    std::int64_t count = 0;
    for (int c = 0; c < i.channels(); ++c)
        for (int y = 0; y < i.size().height; ++y)
            for (int x = 0; x < i.size().width; ++x)
                if (const float v = i.at(x, y, c); is_finite(v)) sum += v, ++count;
    return count ? sum / static_cast<double>(count) : 0;
}

}  // namespace

std::vector<std::string> feature_names() {
    std::vector<std::string> all;
    features::for_each([&]<class G>(G) { all.push_back(G::name()); });
    return all;
}

guides::guides(const simulator::result& render, const reading& how) : size_(plane_of(render, "color").size()) {
    bind_color(render, how.keep_outliers);
    features::for_each([&]<class G>(G) {
        std::string from = contains(how.features, G::name()) ? G::name() : "";
        if (G::name() == "albedo" && contains(how.features, "brdf")) from = "brdf";
        bind_feature<G>(render, from);
    });
}

void guides::bind_color(const simulator::result& render, bool keep_outliers) {
    image<float> mean = plane_of(render, "color"), noise = plane_of(render, "color.variance");
    image<float> a = plane_of(render, "color.halfA"), b = plane_of(render, "color.halfB");
    if (!keep_outliers) {
        image<float> removed(size_, 3);
        suppress_outliers(a.view(), b.view(), a.view(), b.view(), {.removed = removed.view()});
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size_.height; ++y)
                for (int x = 0; x < size_.width; ++x)
                    if (const float less = removed.at(x, y, c); less != 0) {
                        mean.at(x, y, c) -= less;
                        noise.at(x, y, c) = std::numeric_limits<float>::quiet_NaN();  // unknown: as its neighbours'
                    }
    }
    mean_ = mean_of(mean);
    bind("color", std::move(mean));
    bind("color.variance", std::move(noise));
    bind("color.halfA", std::move(a));
    bind("color.halfB", std::move(b));
}

void guides::bind(const std::string& name, image<float> values) {
    images_.push_back(std::move(values));
    layers_.bind(name, images_.back().view());  // what an image holds stays where it is when the image moves
}

template <class G>
void guides::bind_feature(const simulator::result& render, const std::string& from) {
    const image<float>* const mean = find_plane(render, from);
    if (!mean) return bind(G::name(), image<float>(size_, G::channels));
    const auto maps = unit_range(G{}, mean->view());
    const auto mapped = [&](const char* statistic) {
        image<float> values = plane_of(render, from + statistic);
        map_values(maps, values.view(), values.view());
        bind(G::name() + statistic, std::move(values));
    };
    image<float> variance = plane_of(render, from + ".variance");
    map_variances(maps, mean->view(), variance.view(), variance.view());
    bind(G::name() + ".variance", std::move(variance));
    for (const char* statistic : {"", ".halfA", ".halfB"}) mapped(statistic);
}

}  // namespace rdfc
