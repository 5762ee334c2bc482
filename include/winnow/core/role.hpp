// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The roles that a policy can play.  Signatures cannot tell a distance from a weight; a declared role can.
#include <type_traits>

namespace winnow {

namespace role {
struct guide {};      ///< names a buffer
struct distance {};   ///< how unlike are p and q?
struct weight {};     ///< how much does q count for p?
struct window {};     ///< which q are asked?
struct estimator {};  ///< how wrong is the result?
struct executor {};   ///< who runs it?
struct effect {};     ///< what does a simulated scene show?
}  // namespace role

/// P says that it plays Role:  `using role = role::distance;`.
template <class P, class Role>
concept plays = std::is_same_v<typename P::role, Role>;

}  // namespace winnow
