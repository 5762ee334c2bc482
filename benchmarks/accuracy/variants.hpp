// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What is filtered in how many ways.
#include <algorithm>
#include <rdfc/filter.hpp>
#include <string>
#include <vector>

namespace winnow::benchmarks {

struct variant {
    std::string name;
    std::vector<std::string> features = rdfc::feature_names();
    rdfc::settings numbers{};
    bool keep_outliers = false;
};

inline std::vector<std::string> features_but(const std::string& left_out, const std::string& instead = {}) {
    std::vector<std::string> all = rdfc::feature_names();
    std::erase(all, left_out);
    if (!instead.empty()) all.push_back(instead);
    return all;
}

/// The first is RDFC as it is; each of the others differs from it in what its name says.
inline std::vector<variant> all_variants() {
    std::vector<variant> all{{"rdfc"}};
    const auto add = [&](const std::string& name, const auto& change) {
        all.push_back({name});
        change(all.back());
    };
    const auto set = [&](const std::string& name, const auto& change) {
        add(name, [&](variant& v) { change(v.numbers); });
    };
    add("no visibility", [](variant& v) { v.features = features_but("visibility"); });
    add("no caustic", [](variant& v) { v.features = features_but("caustic"); });
    add("brdf for albedo", [](variant& v) { v.features = features_but("albedo", "brdf"); });
    add("outliers kept", [](variant& v) { v.keep_outliers = true; });
    for (const auto choice : {rdfc::selection::first, rdfc::selection::second, rdfc::selection::third})
        set(std::string(rdfc::selection_names[static_cast<std::size_t>(choice)]) + " alone",
            [choice](rdfc::settings& s) { s.choice = choice; });
    set("blend", [](rdfc::settings& s) { s.choice = rdfc::selection::blend; });
    set("tau 1e-3, 1e-4", [](rdfc::settings& s) { s.tau = 1e-3f, s.tau_third = 1e-4f; });
    set("feature_share .25", [](rdfc::settings& s) { s.feature_share = 0.25f; });
    set("both", [](rdfc::settings& s) { s.tau = 1e-3f, s.tau_third = 1e-4f, s.feature_share = 0.25f; });
    set("k_color .3", [](rdfc::settings& s) { s.k_color = 0.3f; });
    set("k_color .6", [](rdfc::settings& s) { s.k_color = 0.6f; });
    set("k_color .8", [](rdfc::settings& s) { s.k_color = 0.8f; });
    set("k_color 1.2", [](rdfc::settings& s) { s.k_color = 1.2f; });
    set("blend, k_color .8", [](rdfc::settings& s) { s.choice = rdfc::selection::blend, s.k_color = 0.8f; });
    set("error_radius 3", [](rdfc::settings& s) { s.error_radius = 3; });
    set("error_radius 5", [](rdfc::settings& s) { s.error_radius = 5; });
    set("epsilon 1e-6", [](rdfc::settings& s) { s.epsilon = 1e-6f; });
    set("epsilon 1e-4", [](rdfc::settings& s) { s.epsilon = 1e-4f; });
    set("k_feature .8", [](rdfc::settings& s) { s.k_feature = 0.8f; });
    set("radius 6", [](rdfc::settings& s) { s.radius = 6; });
    return all;
}

}  // namespace winnow::benchmarks
