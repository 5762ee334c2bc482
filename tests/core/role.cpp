// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/core/role.hpp>

using namespace winnow;

namespace {
struct yardstick {
    using role = role::distance;
};
}  // namespace

static_assert(plays<yardstick, role::distance>);
static_assert(!plays<yardstick, role::weight>);
static_assert(!plays<int, role::distance>);
