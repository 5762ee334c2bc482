// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// How every CPU executor runs a sweep: workers take tiles from a common counter, each with scratch memory of its own.
#include <winnow/executor/workspace.hpp>

namespace winnow {

/// What a run will take, known before it starts.
struct run_plan {
    std::size_t scratch_bytes = 0;  ///< of the workspace, for tiles
    std::size_t image_bytes = 0;    ///< of the workspace, for whole images between passes
    int tiles = 0;
    int workers = 1;
    int passes = 1;
    int halo = 0;  ///< in pixels
};

namespace detail {

inline std::size_t aligned(std::size_t bytes) {
    return (bytes + scratch_memory::alignment - 1) / scratch_memory::alignment * scratch_memory::alignment;
}

inline int ceil_div(int a, int b) { return (a + b - 1) / b; }

}  // namespace detail

/// A kernel filters one tile:  tile_size(sweep, buffers), scratch_bytes(sweep, buffers),
/// operator()(sweep, buffers, tile, scratch).
template <class Kernel, class Sweep>
run_plan plan_tiles(const Kernel& kernel, const Sweep& sweep, const sweep_buffers& buffers, int workers) {
    const extent tile = kernel.tile_size(sweep, buffers);
    const int tiles =
        detail::ceil_div(buffers.size.width, tile.width) * detail::ceil_div(buffers.size.height, tile.height);
    workers = std::max(1, std::min(workers, tiles));
    return {.scratch_bytes = workers * detail::aligned(kernel.scratch_bytes(sweep, buffers)),
            .image_bytes = 0,
            .tiles = tiles,
            .workers = workers,
            .passes = 1,
            .halo = halo(sweep)};
}

/// dispatch(n, work) calls work(i) once for each i in [0, n), in any order, at once or one by one.  The result does not
/// depend on it: tiles write disjoint pixels and read only the input.
template <class Kernel, class Sweep, class Dispatch>
void run_tiles(const Kernel& kernel, const Sweep& sweep, workspace& memory, int workers, const Dispatch& dispatch) {
    const sweep_buffers& buffers = memory.buffers;
    const run_plan p = plan_tiles(kernel, sweep, buffers, workers);
    const extent tile = kernel.tile_size(sweep, buffers);
    const int columns = detail::ceil_div(buffers.size.width, tile.width);
    std::byte* scratch = memory.tiles.reserve(p.scratch_bytes);
    std::atomic<int> next = 0;
    memory.progress.done = 0;
    memory.progress.total = p.tiles;
    dispatch(p.workers, [&](int worker) {
        std::byte* own = scratch + worker * (p.scratch_bytes / p.workers);
        for (int t = next++; t < p.tiles && !memory.progress.cancel; t = next++) {
            const int x = t % columns * tile.width, y = t / columns * tile.height;
            kernel(sweep, buffers,
                   rectangle{x, y, std::min(x + tile.width, buffers.size.width),
                             std::min(y + tile.height, buffers.size.height)},
                   own);
            ++memory.progress.done;
        }
    });
}

}  // namespace winnow
