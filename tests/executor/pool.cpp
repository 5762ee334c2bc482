// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <array>
#include <thread>
#include <winnow/executor/pool.hpp>
#include "executor/agreement.hpp"
#include "winnow/executor/serial.hpp"

using namespace winnow;
using namespace winnow::test;

TEST_CASE("a pool gives the bits of simd on 1, 2, 3 and 7 threads", "[threads]") {
    std::vector<how> hows = {{.kind = executor_kind::simd, .tile = {32, 8}}};
    for (const int threads : {1, 2, 3, 7})
        hows.push_back({.kind = executor_kind::pool, .threads = threads, .tile = {32, 8}});
    for (const border rule : all_borders) check_same_bits({67, 45}, hows, all_filters({.radius = 2, .border = rule}));
}

TEST_CASE("two filters run at the same time, each with its workspace", "[threads]") {
    const extent size{61, 40};
    const buffers in = make_buffers(size);
    const std::array<any_filter, 2> filters = {nlm(), rdfc_candidate()};
    std::array<image<>, 2> expected, found = {image<>(size, 3), image<>(size, 3)};
    for (std::size_t i = 0; i < 2; ++i)
        expected[i] = filters[i].images(in.layers(), size, {.kind = executor_kind::simd})[0];
    {
        std::array<std::jthread, 2> threads;
        for (std::size_t i = 0; i < 2; ++i)
            threads[i] = std::jthread([&, i] {
                workspace memory;
                const output out{found[i]};
                for (int run = 0; run < 5; ++run)
                    filters[i].run(in.layers(), std::span(&out, 1),
                                   {.kind = executor_kind::pool, .threads = 2, .tile = {16, 8}}, memory);
            });
    }
    for (std::size_t i = 0; i < 2; ++i) CHECK(other_bits(found[i], expected[i]) == "");
}

TEST_CASE("a pool may call the tasks one by one, in any order") {
    struct backwards {
        int size() const { return 4; }
        void run(int count, const std::function<void(int)>& task) const {
            for (int i = count; i-- > 0;) task(i);
        }
    } tasks;
    int sum = 0, last = 5;
    executor::pool{tasks, executor::serial<>{}}.dispatch(5, [&](int i) {
        CHECK(i == --last);
        sum += i;
    });
    CHECK(sum == 10);
}
