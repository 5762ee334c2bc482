// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <every_header.hpp>

bool second_agrees(const winnow::paper::rdfc_candidate& filter, const winnow::invalid_input& error) {
    return filter == winnow::paper::make_rdfc_candidate({.radius = 5}) && std::string(error.what()) == "words";
}
