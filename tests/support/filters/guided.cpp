// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/erase.hpp>
#include <support/filters.hpp>
#include <support/papers.hpp>

namespace winnow::test {

any_filter erased(const paper::guided& f) { return erase("guided", f); }
any_filter erased(const guided_by_color& f) { return erase("guided by the colour", f); }
any_filter erased(const guided_with_error& f) { return erase("guided with error", f); }

any_filter guided(filter_numbers n) { return erased(paper::guided{{.radius = n.radius, .epsilon = 1e-2f}}); }

}  // namespace winnow::test
