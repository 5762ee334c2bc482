// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What the program says about a run.
#include <optional>
#include <string>
#include <vector>
#include <winnow/frame/diagnose.hpp>
#include <winnow/frame/outliers.hpp>

namespace denoise {

struct metrics {
    double mse, relmse, psnr, ssim;
};
metrics compare(const winnow::source& image, const winnow::source& reference);

struct report {
    std::string filter, executor;
    winnow::extent size;
    int threads = 1;
    double read_seconds = 0, filter_seconds = 0, write_seconds = 0;
    const std::vector<winnow::layer_diagnosis>* read = nullptr;
    std::optional<winnow::outliers_found> outliers;
    std::optional<double> estimated_mse;
    std::optional<metrics> input, output;
};

/// The contract of --json: one object on stdout.
void print_json(const report& r);
/// The same for people.
void print_text(const report& r);

/// On stderr: bad pixels with their places, and what looks like a mistake.
void print_diagnosis(const winnow::diagnosis& d);
/// One line on stderr if there are bad pixels.
void warn_of_bad_pixels(const std::vector<winnow::layer_diagnosis>& read);

}  // namespace denoise
