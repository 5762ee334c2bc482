// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The markers that let a policy run on every executor.

/// Marks a function that executors call per pixel: callable on host and device, and always inlined, because the
/// speed of an expression rests on the compiler seeing all of it at once.  A lambda inside one has its own marker,
/// [&](auto c) WINNOW_HD_LAMBDA { ... }, because host and device are those of the function that it is in.
#if defined(__CUDACC__)
#define WINNOW_HD __host__ __device__ __forceinline__
#define WINNOW_HD_LAMBDA
#else
#define WINNOW_HD __attribute__((always_inline)) inline
#define WINNOW_HD_LAMBDA __attribute__((always_inline))
#endif
