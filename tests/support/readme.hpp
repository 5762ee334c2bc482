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
inline image<float> where({8, 8}, 3), spread({8, 8}, 6);

// A renderer's sample, and the filter of the first snippet.
struct path {
    float radiance[3], texture[3], n[3], t;
};
inline path trace(int, int, int) { return {}; }
inline const filter joint_bilateral{gaussian(spatial, 3.0f) * gaussian(l2(albedo), 0.1f) * gaussian(l2(normal), 0.2f),
                                    window::square{.radius = 7}};
