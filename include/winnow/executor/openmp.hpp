// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// All cores, by OpenMP.  The includer compiles with -fopenmp (CMake: OpenMP::OpenMP_CXX).
#include <winnow/executor/simd.hpp>
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace winnow::executor {

/// Runs the tiles of another CPU executor on several threads.  The number of threads is this object's own affair: no
/// global setting is read or changed but OpenMP's default, where `threads` is 0.
template <class Inner>
struct openmp_over {
    using role = role::executor;

    int threads = 0;  ///< 0: as many as OpenMP offers
    Inner inner{};

    auto kernel() const { return inner.kernel(); }
    int workers() const {
        static_assert(compiled_with_openmp<Inner>, "winnow::executor::openmp needs -fopenmp");
#if defined(_OPENMP)
        return threads > 0 ? threads : omp_get_max_threads();
#else
        return 1;
#endif
    }
    template <class Work>
    void dispatch(int count, const Work& work) const {
#if defined(_OPENMP)
#pragma omp parallel for num_threads(count) schedule(static, 1)
#endif
        for (int i = 0; i < count; ++i) work(i);
    }

private:
    template <class>
    static constexpr bool compiled_with_openmp =
#if defined(_OPENMP)
        true;
#else
        false;
#endif
};

/// Threads, and the lanes of each:  executor::openmp{.threads = 2}.
using openmp = openmp_over<simd>;
static_assert(executor_policy<openmp>);

}  // namespace winnow::executor
