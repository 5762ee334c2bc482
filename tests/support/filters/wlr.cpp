// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/erase.hpp>
#include <support/papers.hpp>

namespace winnow::test {

any_filter erased(const paper::wlr& f) { return erase("wlr", f); }

}  // namespace winnow::test
