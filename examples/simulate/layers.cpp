// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "layers.hpp"

#include <algorithm>
#include <support/nearest.hpp>
#include <winnow/frame/film.hpp>
#include <winnow/paper/guided_2010.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/nlm_2012.hpp>
#include <winnow/paper/rdfc_2013.hpp>
#include <winnow/simulate/effect.hpp>

namespace simulator {

namespace {

using namespace winnow;

struct filter_planes {
    std::string name;
    std::vector<std::string> planes;
};

template <class Filter>
filter_planes planes_for(const std::string& name) {
    using halved = joined<typename film_for<Filter>::planes, planes<half_a<color_t>, half_b<color_t>>>;
    filter_planes f{name, {}};
    halved::for_each([&]<class G>(G) { f.planes.push_back(G::name()); });
    return f;
}

/// An effect, and the guides that exist because of it.
struct effect_guides {
    std::string name;
    std::vector<std::string> guides;
};

template <class... E>
std::vector<effect_guides> guides_of(simulate::effects<E...>) {
    std::vector<effect_guides> all;
    const auto add = [&]<class Effect>(Effect) {
        all.push_back({Effect::name(), {}});
        Effect::gives::for_each([&]<class G>(G) { all.back().guides.push_back(G::name()); });
    };
    (add(E{}), ...);
    return all;
}

const std::vector<effect_guides>& effects() {
    static const auto all = guides_of(
        simulate::effects<simulate::effect::depth_of_field, simulate::effect::translation, simulate::effect::rotation,
                          simulate::effect::camera_motion, simulate::effect::area_light, simulate::effect::glossy,
                          simulate::effect::mirror, simulate::effect::caustics, simulate::effect::texture,
                          simulate::effect::bump, simulate::effect::roughness_map, simulate::effect::medium,
                          simulate::effect::global_illumination, simulate::effect::frames,
                          simulate::effect::fireflies>{});
    return all;
}

bool contains(const std::vector<std::string>& all, const std::string& name) {
    return std::find(all.begin(), all.end(), name) != all.end();
}

}  // namespace

std::vector<std::string> planes_of_filter(const std::string& filter) {
    static const std::vector<filter_planes> all = {
        planes_for<paper::bilateral>("bilateral"),
        planes_for<paper::joint_bilateral>("joint_bilateral"),
        planes_for<paper::nlm>("nlm"),
        planes_for<paper::nlm_2012_released>("nlm_dual"),
        planes_for<paper::rdfc_candidate>("rdfc_candidate"),
        planes_for<paper::guided_of<planes<albedo_t, normal_t, depth_t>>>("guided")};
    std::vector<std::string> known;
    for (const filter_planes& f : all) {
        if (f.name == filter) return f.planes;
        known.push_back(f.name);
    }
    fail("there is no filter " + filter + programs::did_you_mean(filter, known));
}

void check_given(const entry& scene, const std::vector<std::string>& wanted, const std::string& who) {
    const auto planes_of = [](const std::vector<std::string>& guides) {
        std::vector<std::string> all;
        for (const std::string& g : guides)
            for (const char* statistic : {"", ".variance", ".halfA", ".halfB"}) all.push_back(g + statistic);
        if (contains(all, "rest_position")) all.push_back("rest_position.covariance");
        return all;
    };
    const std::vector<std::string> given = planes_of(scene.guides());
    for (const std::string& plane : wanted) {
        if (contains(given, plane)) continue;
        std::string by;
        std::vector<std::string> known = given;
        for (const effect_guides& e : effects()) {
            const std::vector<std::string> possible = planes_of(e.guides);
            if (contains(possible, plane)) by += (by.empty() ? "" : " or ") + e.name;
            known.insert(known.end(), possible.begin(), possible.end());
        }
        if (by.empty()) fail("there is no layer " + plane + programs::did_you_mean(plane, known));
        fail(who + " needs " + plane + ", which " + scene.name() + " cannot give: it does not show " + by);
    }
}

bool is_wanted(const std::string& plane, const std::vector<std::string>& wanted) {
    const std::string guide = plane.substr(0, plane.find('.'));
    return wanted.empty() || plane == "color" || contains(wanted, plane) || contains(wanted, guide);
}

std::vector<const entry*> scenes_that_show(const std::string& effect) {
    std::vector<std::string> known;
    for (const effect_guides& e : effects()) known.push_back(e.name);
    if (!contains(known, effect)) fail("there is no effect " + effect + programs::did_you_mean(effect, known));
    std::vector<const entry*> shown;
    for (const auto& s : scenes())
        if (contains(s->effects(), effect)) shown.push_back(s.get());
    return shown;
}

}  // namespace simulator
