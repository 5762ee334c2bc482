// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The one marker that lets a policy run on every executor.

/// Marks a function that executors call per pixel: callable on host and device, and always inlined, because the
/// speed of an expression rests on the compiler seeing all of it at once.
#if defined(__CUDACC__)
#define WINNOW_HD __host__ __device__ __forceinline__
#else
#define WINNOW_HD __attribute__((always_inline)) inline
#endif
