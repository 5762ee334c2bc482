// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What the README's snippets take for granted: a renderer's buffers.
#include <winnow/executor/openmp.hpp>
#include <winnow/executor/pool.hpp>
#include <winnow/winnow.hpp>

// A snippet may define what it does not use.
#pragma GCC diagnostic ignored "-Wunused-variable"
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wunused-const-variable"
#pragma clang diagnostic ignored "-Wunneeded-internal-declaration"
#endif

using namespace winnow;
inline image<float> rgb({8, 8}, 3), texture({8, 8}, 3), normals({8, 8}, 3), z({8, 8}), noise({8, 8}, 3),
    result({8, 8}, 3);
inline image<float> first({8, 8}, 3), second({8, 8}, 3), feature_noise({8, 8}, 3), error({8, 8}, 3);
