// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What an executor is.
#include <concepts>
#include <winnow/core/role.hpp>
#include <winnow/executor/run.hpp>

namespace winnow {

namespace detail {
struct any_work {
    void operator()(int) const {}
};
}  // namespace detail

/// Who runs it?  Every executor gives the result of `serial`, to a stated bound, whatever its threads and tiles.
/// A CPU executor brings a kernel that filters one tile and a dispatch over workers; `run_tiles` does the rest.
template <class E>
concept executor_policy = plays<E, role::executor> && requires(const E e) {
    e.kernel();
    { e.workers() } -> std::same_as<int>;
    e.dispatch(1, detail::any_work{});
};

}  // namespace winnow
