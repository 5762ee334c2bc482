// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// All cores, by the caller's own thread pool.
#include <concepts>
#include <thread>
#include <vector>
#include <winnow/executor/concept.hpp>

namespace winnow::executor {

/// A pool is anything with  size(), the number of tasks that may run at once, and  run(count, task), which calls
/// task(i) for each i in [0, count), on whatever threads, and returns when all are done.
template <class P>
concept thread_pool = requires(P p) {
    { p.size() } -> std::convertible_to<int>;
    p.run(1, detail::any_work{});
};

/// Runs the tiles of another CPU executor as tasks of a pool:  executor::pool{my_pool, executor::simd{}}.
template <thread_pool Pool, class Inner>
struct pool {
    using role = role::executor;

    Pool& tasks;
    Inner inner{};

    auto kernel() const { return inner.kernel(); }
    int workers() const { return tasks.size(); }
    template <class Work>
    void dispatch(int count, const Work& work) const {
        tasks.run(count, work);
    }
};
template <class P, class I>
pool(P&, I) -> pool<P, I>;

/// A pool for those who have none: starts its threads anew for each run.
struct fresh_threads {
    int threads = 1;

    int size() const { return threads; }
    template <class Task>
    void run(int count, const Task& task) const {
        std::vector<std::jthread> others;
        for (int i = 1; i < count; ++i) others.emplace_back([&task, i] { task(i); });
        if (count > 0) task(0);
    }
};
static_assert(thread_pool<fresh_threads>);

}  // namespace winnow::executor
