// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The filters that the program offers, each with its numbers, and how one is run.
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>
#include <winnow/executor/workspace.hpp>
#include <winnow/frame/frame.hpp>
#include <winnow/image/image.hpp>

namespace denoise {

/// A number that --set changes.
struct number {
    std::string name;
    std::string summary;
    double initial, lowest, highest;
    bool whole;

    std::string shown(double value) const;
};

/// A layer that is filtered with the weights of the colour; the halves may be empty.
struct further_layer {
    std::string name;
    winnow::source mean, half_a, half_b;
    winnow::target filtered;
};

/// What a filter is run on, and by whom.
struct job {
    const winnow::named_layers& frame;
    winnow::output& out;  ///< the colour, and what else is asked for; the halves are those of the colour
    const std::vector<further_layer>& layers;
    std::string executor;
    int threads;
    winnow::workspace& memory;
    winnow::target selection;  ///< where the filter chooses between candidates, which; may be empty
};

/// What a filter is to know of the input before it is made.
struct scene_facts {
    double squared_mean;        ///< of the colour, which makes an epsilon relative
    float half_share;           ///< see winnow::share_of_halves
    std::set<std::string> has;  ///< the buffers that are there
};

/// A filter with its numbers set.
struct ready_filter {
    int halo;
    std::function<void(const job&)> run;
};

struct filter_entry {
    std::string name;
    std::string summary;
    std::vector<std::string> needs;  ///< buffers; "halves" and "variance" are those of the colour
    std::vector<std::string> uses;   ///< buffers that help where they are there
    bool unit_features;              ///< wants features in unit range
    bool own_noise;                  ///< works out variances itself, from halves and what the input has
    std::vector<number> numbers;
    /// values: one for each number.
    std::function<ready_filter(const std::vector<double>& values, const scene_facts& about)> make;

    bool needs_buffer(const std::string& name) const;
    bool reads_buffer(const std::string& name) const;  ///< needs or uses
    /// The values of all numbers, some of them set; fails for an unknown key and a value out of range.
    std::vector<double> values(const std::vector<std::pair<std::string, std::string>>& set) const;
    /// "radius=10 k=0.45", as the header of a file records it.
    std::string shown(const std::vector<double>& values) const;
};

/// Compiled apart.
filter_entry guided_entry();
filter_entry rdfc_entry();
filter_entry sbf_entry();
filter_entry atrous_entry();
filter_entry wlr_entry();

const std::vector<filter_entry>& filters();
/// Fails with the nearest name where there is no such filter.
const filter_entry& find_filter(const std::string& name);

/// Fails for an unknown executor, or threads that it cannot have; returns the threads that will run.
int check_executor(const std::string& executor, int threads);
/// The fastest that this program was built with.
std::string default_executor();

}  // namespace denoise
