// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <every_header.hpp>

bool second_agrees(const winnow::paper::rdfc_candidate& filter, const winnow::invalid_input& error);

int main() {
    const bool same = second_agrees(winnow::paper::make_rdfc_candidate({.radius = 5}), winnow::invalid_input("words"));
    return same ? 0 : 1;
}
