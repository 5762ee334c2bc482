// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/erase.hpp>
#include <support/papers.hpp>

namespace winnow::test {

any_filter erased(const paper::a_trous_of<planes<normal_t, depth_t>>& f) { return erase("A-Trous", f); }

}  // namespace winnow::test
