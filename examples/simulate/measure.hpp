// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What is wrong with a picture, told by references.
#include <string>
#include <vector>
#include <winnow/image/image.hpp>

namespace simulator {

struct metrics {
    double mse, relmse;
};

/// None, one, or two; against two, their own noise cancels.
class references {
public:
    references() = default;
    explicit references(std::vector<winnow::image<float>> pictures) : pictures_(std::move(pictures)) {}
    /// Files, which must be of that size.
    static references read(const std::vector<std::string>& files, winnow::extent size);

    bool empty() const { return pictures_.empty(); }
    const winnow::image<float>& first() const { return pictures_.front(); }
    metrics measure(const winnow::image<float>& picture) const;

private:
    std::vector<winnow::image<float>> pictures_;
};

}  // namespace simulator
