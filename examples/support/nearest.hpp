// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// "Did you mean ...?"
#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace programs {

/// The least number of letters to insert, delete or replace.
inline int letters_apart(const std::string& a, const std::string& b) {
    std::vector<int> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 0; i < a.size(); ++i) {
        int diagonal = std::exchange(row[0], static_cast<int>(i) + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const int replaced = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j] + 1, diagonal + 1, replaced});
        }
    }
    return row.back();
}

/// "; did you mean NAME?" with the name that is nearest, nothing where there is no name.
inline std::string did_you_mean(const std::string& said, const std::vector<std::string>& names) {
    const auto nearest = std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
        return letters_apart(said, a) < letters_apart(said, b);
    });
    return nearest == names.end() ? "" : "; did you mean " + *nearest + "?";
}

}  // namespace programs
