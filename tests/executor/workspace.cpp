// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/executor/workspace.hpp>
#include "executor/agreement.hpp"
#include "support/counting_new.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

/// What a second run of the same filter over the same buffers allocates.
long long allocations_of_second_run(const any_filter& f, const named_layers& in, std::span<const output> out,
                                    const how& h) {
    workspace memory;
    f.run(in, out, h, memory);
    const long long before = allocations_so_far().count;
    f.run(in, out, h, memory);
    return allocations_so_far().count - before;
}

constexpr executor_kind without_threads[] = {executor_kind::serial_double, executor_kind::serial, executor_kind::simd};

}  // namespace

TEST_CASE("allocations are counted") {
    if (!allocations_are_counted) return;
    const long long before = allocations_so_far().count;
    const auto some = std::make_unique<int[]>(100);
    volatile int* const seen = some.get();  // else a compiler may leave the allocation out
    seen[99] = 1;
    const long long after_one = allocations_so_far().count;
    scratch_memory memory;
    memory.reserve(1000);
    const long long after_two = allocations_so_far().count;
    CHECK(after_one == before + 1);
    CHECK(after_two == before + 2);
}

TEST_CASE("a second run allocates nothing") {
    const extent size{35, 20};
    const buffers in = make_buffers(size);
    const named_layers layers = in.layers();
    for (const any_filter& f : all_filters())
        for (const executor_kind kind : without_threads) {
            std::vector<image<>> images(static_cast<std::size_t>(f.outputs), image<>(size, 3));
            const std::vector<output> out(images.begin(), images.end());
            CAPTURE(f.name, static_cast<int>(kind));
            CHECK(allocations_of_second_run(f, layers, out, {kind}) == 0);
        }
}

TEST_CASE("a second run with halves, error and further layers allocates nothing") {
    const extent size{35, 20};
    const buffers in = make_buffers(size);
    const named_layers layers = in.layers();
    image<> mean(size, 3), a(size, 3), b(size, 3), error(size, 3), filtered_depth(size, 1);
    const output out =
        output{mean}.halves(a.view(), b.view()).error(error.view()).layer(in.depth.view(), filtered_depth.view());
    for (const any_filter& f : {nlm_with_error(), nlm_dual_buffer()})
        for (const executor_kind kind : without_threads) {
            CAPTURE(f.name, static_cast<int>(kind));
            CHECK(allocations_of_second_run(f, layers, std::span(&out, 1), {kind}) == 0);
        }
}

TEST_CASE("a second run on OpenMP's threads allocates nothing", "[openmp]") {
    const extent size{35, 20};
    const buffers in = make_buffers(size);
    image<> mean(size, 3);
    const output out{mean};
    const how h{.kind = executor_kind::openmp, .threads = 2, .tile = {16, 4}};
    CHECK(allocations_of_second_run(rdfc_candidate(), in.layers(), std::span(&out, 1), h) == 0);
}

TEST_CASE("a smaller image needs no new memory, and leaves no trace in the result") {
    const buffers large = make_buffers({67, 45}, 1), small = make_buffers({21, 9}, 2);
    for (const any_filter& f : {nlm(), rdfc_candidate(), nlm_dual_buffer()})
        for (const executor_kind kind : without_threads) {
            workspace memory;
            image<> of_large(large.size(), 3), of_small(small.size(), 3);
            const output to_large{of_large}, to_small{of_small};
            f.run(large.layers(), std::span(&to_large, 1), {kind}, memory);
            const named_layers layers = small.layers();
            const std::size_t bytes = allocations_so_far().bytes;
            f.run(layers, std::span(&to_small, 1), {kind}, memory);
            const std::size_t allocated = allocations_so_far().bytes - bytes;
            CAPTURE(f.name, static_cast<int>(kind));
            CHECK(allocated == 0);
            CHECK(other_bits(of_small, f.images(layers, small.size(), {kind})[0]) == "");
        }
}

TEST_CASE("reserved memory is aligned to a cache line, grows and never shrinks") {
    scratch_memory memory;
    CHECK(memory.size() == 0);
    for (const std::size_t bytes : {1u, 100u, 7u, 1000u}) {
        const std::byte* p = memory.reserve(bytes);
        CHECK(reinterpret_cast<std::uintptr_t>(p) % scratch_memory::alignment == 0);
    }
    CHECK(memory.size() == 1000);
}
