// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How a paper's filter becomes an entry of the program.
#include <type_traits>
#include <variant>
#include <winnow/executor/openmp.hpp>
#include <winnow/executor/simd.hpp>

#include "filters.hpp"

namespace denoise {

using namespace winnow;

/// f(executor), for the executor of that name.
template <class F>
void with_executor(const std::string& name, int threads, const F& f) {
    if (name == "serial") f(executor::serial<>{});
    else if (name == "simd") f(executor::simd{});
#if defined(_OPENMP)
    else f(executor::openmp{.threads = threads});
#endif
    static_cast<void>(threads);
}

/// A member of a paper's numbers, as --set knows it.
template <class Numbers>
struct knob {
    const char* name;
    std::variant<int Numbers::*, float Numbers::*> member;
    double lowest, highest;
    const char* summary;
};

/// make(numbers, about) is the filter; run(filter, job) runs it.
template <class Numbers, class Make, class Run>
filter_entry entry(const char* name, const char* summary, std::vector<std::string> needs, std::vector<std::string> uses,
                   const std::vector<knob<Numbers>>& knobs, const Make& make, const Run& run) {
    filter_entry e{name, summary, std::move(needs), std::move(uses), false, false, {}, {}};
    const Numbers initial;
    for (const knob<Numbers>& k : knobs)
        std::visit(
            [&](auto member) {
                using value = std::remove_cvref_t<decltype(initial.*member)>;
                e.numbers.push_back(
                    {k.name, k.summary, double(initial.*member), k.lowest, k.highest, std::is_same_v<value, int>});
            },
            k.member);
    e.make = [knobs, make, run](const std::vector<double>& values, const scene_facts& about) {
        Numbers numbers;
        for (std::size_t i = 0; i < knobs.size(); ++i)
            std::visit(
                [&](auto member) {
                    numbers.*member = static_cast<std::remove_reference_t<decltype(numbers.*member)>>(values[i]);
                },
                knobs[i].member);
        const auto f = make(numbers, about);
        int reach;
        if constexpr (requires { f.filter; }) reach = halo(f.filter);
        else reach = halo(f);
        return ready_filter{reach, [f, run](const job& j) { run(f, j); }};
    };
    return e;
}

/// An epsilon in units of the squared mean of the colour, so that a darker scene is filtered alike.
inline float relative(float epsilon, double squared_mean) { return static_cast<float>(epsilon * squared_mean + 1e-30); }

}  // namespace denoise
