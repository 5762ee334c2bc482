// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Filters with their type erased, so that each is compiled once, for every executor, and tested in many places.
#include <functional>
#include <span>
#include <string>
#include <vector>
#include <winnow/executor/run.hpp>
#include <winnow/frame/frame.hpp>
#include <winnow/frame/output.hpp>
#include <winnow/image/image.hpp>

namespace winnow::test {

enum class executor_kind { serial_double, serial, simd, openmp, openmp_serial, pool };

/// An executor by name and numbers.
struct how {
    executor_kind kind = executor_kind::serial_double;
    int threads = 1;
    extent tile{80, 32};
};
std::string to_string(const how& h);

/// What a test may do with a filter; `outputs` is 1, or the number of candidates.
struct any_filter {
    std::string name;
    int outputs = 1;
    int halo = 0;
    std::function<void(const named_layers&, std::span<const output>, const how&, workspace&)> run;
    std::function<run_plan(extent, const how&, int values)> plan;

    void operator()(const named_layers& in, std::span<const output> out, const how& h) const {
        workspace memory;
        run(in, out, h, memory);
    }
    void operator()(const named_layers& in, const output& out, const how& h = {}) const {
        (*this)(in, std::span(&out, 1), h);
    }
    /// The filtered colour of every output.
    std::vector<image<>> images(const named_layers& in, extent size, const how& h = {}) const {
        std::vector<image<>> all(static_cast<std::size_t>(outputs), image<>(size, 3));
        const std::vector<output> out(all.begin(), all.end());
        (*this)(in, out, h);
        return all;
    }
};

}  // namespace winnow::test
