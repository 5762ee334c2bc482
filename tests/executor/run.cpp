// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <algorithm>
#include <winnow/executor/run.hpp>
#include "executor/agreement.hpp"
#include "support/erase.hpp"
#include "winnow/distance/squared_difference.hpp"
#include "winnow/weight/gaussian.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {

rectangle inside_of(rectangle r, extent size) {
    return {std::max(r.x0, 0), std::max(r.y0, 0), std::min(r.x1, size.width), std::min(r.y1, size.height)};
}

/// r as seen from the upper left pixel of `of`.
rectangle relative_to(rectangle r, rectangle of) { return {r.x0 - of.x0, r.y0 - of.y0, r.x1 - of.x0, r.y1 - of.y0}; }

}  // namespace

TEST_CASE("a crop with its halo gives the bits of the whole image, at every corner and inside") {
    const extent size{67, 45};
    const buffers in = make_buffers(size);
    const rectangle regions[] = {{0, 0, 9, 7},     {58, 0, 67, 7},  {0, 38, 9, 45}, {58, 38, 67, 45},
                                 {25, 20, 42, 26}, {33, 0, 34, 45}, {0, 22, 67, 23}};
    for (const executor_kind kind : {executor_kind::simd, executor_kind::serial_double})
        for (const border rule : all_borders)
            for (const any_filter& f : all_filters({.radius = 2, .patch_radius = 1, .border = rule})) {
                if (kind == executor_kind::serial_double && f.halo != 4) continue;  // a few suffice
                const auto whole = f.images(in.layers(), size, {kind});
                for (const rectangle region : regions) {
                    const rectangle crop = inside_of(region.grown(f.halo), size);
                    const auto part = f.images(in.layers(crop), crop.size(), {kind});
                    CAPTURE(f.name, f.halo, static_cast<int>(kind), static_cast<int>(rule), region.x0, region.y0);
                    for (std::size_t i = 0; i < whole.size(); ++i)
                        CHECK(other_bits(part[i].view().crop(relative_to(region, crop)),
                                         whole[i].view().crop(region)) == "");
                }
            }
}

TEST_CASE("the halo is no larger than need be: a pixel just within it matters") {
    // Window 2, patch 1, and one pixel for mending: a bad pixel at distance 4 is mended from one at distance 5, which
    // the halo of 4 leaves out; a good pixel at distance 3 is looked at.
    const extent size{40, 9};
    const any_filter f = nlm({.radius = 2, .patch_radius = 1});
    CHECK(f.halo == 4);
    buffers in = make_buffers(size);
    const auto before = f.images(in.layers(), size)[0];
    in.color.at(20 + 3, 4, 0) += 0.5f;
    const auto after = f.images(in.layers(), size)[0];
    CHECK(other_bits(before.view().crop({20, 4, 21, 5}), after.view().crop({20, 4, 21, 5})) != "");
    CHECK(other_bits(before.view().crop({0, 0, 20, 9}), after.view().crop({0, 0, 20, 9})) == "");
}

TEST_CASE("the plan tells the halo, the tiles, the workers and the bytes that the run takes") {
    const extent size{67, 17};
    const buffers in = make_buffers(size);
    for (const executor_kind kind :
         {executor_kind::serial_double, executor_kind::serial, executor_kind::simd, executor_kind::pool})
        for (const any_filter& f : all_filters({.radius = 2, .patch_radius = 2})) {
            const how h{.kind = kind, .threads = 3, .tile = {32, 8}};
            CAPTURE(f.name, to_string(h));
            const run_plan p = f.plan(size, h, 3);
            workspace memory;
            image<> result(size, 3);
            const output out{result};
            f.run(in.layers(), std::span(&out, 1), h, memory);
            CHECK(memory.tiles.size() == p.scratch_bytes);
            CHECK(memory.progress.total == p.tiles);
            CHECK(p.halo == f.halo);
            CHECK(memory.images.size() == p.image_bytes);
            CHECK(p.passes == (p.image_bytes > 0 ? 2 : 1));
            CHECK(p.workers == (kind == executor_kind::pool ? 3 : 1));
        }
}

TEST_CASE("the plan counts the halves and further layers") {
    const extent size{50, 20};
    const buffers in = make_buffers(size);
    const any_filter f = nlm_with_error();
    image<> mean(size, 3), error(size, 3), a(size, 3), b(size, 3), filtered_depth(size, 1);
    const output out =
        output{mean}.halves(a.view(), b.view()).error(error.view()).layer(in.depth.view(), filtered_depth.view());
    workspace memory;
    f.run(in.layers(), std::span(&out, 1), {executor_kind::simd}, memory);
    CHECK(memory.tiles.size() == f.plan(size, {executor_kind::simd}, 3 + 6 + 1).scratch_bytes);
}

TEST_CASE("progress ends at its total", "[threads]") {
    const extent size{67, 45};
    const buffers in = make_buffers(size);
    image<> result(size, 3);
    const output out{result};
    workspace memory;
    for (const extent tile : {extent{16, 4}, extent{32, 45}, extent{100, 100}}) {
        bilateral().run(in.layers(), std::span(&out, 1), {.kind = executor_kind::pool, .threads = 2, .tile = tile},
                        memory);
        CHECK(memory.progress.total > 0);
        CHECK(memory.progress.done == memory.progress.total);
    }
    CHECK(memory.progress.total == 1 * 1);
}

namespace {
/// Cancels the run in its first tile, as another thread would.
struct cancel_when_asked {
    using role = role::distance;
    using reads = planes<color_t>;

    std::atomic<bool>* cancel = nullptr;

    template <class Real, class Planes>
    Real operator()(const pixel_pair<Real, Planes>& pq) const {
        *cancel = true;
        return pq.p(color);
    }
};
}  // namespace

TEST_CASE("cancel stops the run before its next tile, and the next run is whole again") {
    const extent size{48, 64};
    const buffers in = make_buffers(size);
    image<> result(size, 3);
    workspace memory;
    const filter cancelled{gaussian(cancel_when_asked{&memory.progress.cancel}, 1.0f), window::square{.radius = 1}};
    cancelled(in.layers(), output{result}, executor::serial<>{}, memory);
    CHECK(memory.progress.total == 4);
    CHECK(memory.progress.done == 1);  // the tile in which it was cancelled is finished
    // The rows of the other tiles are as they were.
    CHECK(largest_magnitude(result.view().crop({0, 0, 48, 16})) > 0);
    CHECK(largest_magnitude(result.view().crop({0, 16, 48, 64})) == 0);

    memory.progress.cancel = false;
    const output out{result};
    bilateral().run(in.layers(), std::span(&out, 1), {executor_kind::serial}, memory);
    CHECK(memory.progress.done == memory.progress.total);
    CHECK(other_bits(result, bilateral().images(in.layers(), size, {executor_kind::serial})[0]) == "");
}
