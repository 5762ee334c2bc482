// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/executor/simd.hpp>
#include "executor/agreement.hpp"

using namespace winnow;
using namespace winnow::test;

namespace {
const std::vector<how> lanes_only = {{executor_kind::simd}};
}

TEST_CASE("lanes agree with the definition for every filter and border, including the ragged right edge") {
    for (const border rule : all_borders) {
        const filter_numbers n{.radius = 2, .patch_radius = 1, .border = rule};
        for (const extent size : {extent{33, 31}, extent{67, 45}}) check_agreement(size, n, lanes_only, all_filters(n));
    }
}

TEST_CASE("lanes agree with the definition on images smaller than a register or a window") {
    for (const border rule : all_borders)
        for (const int radius : {0, 1, 6}) {
            const filter_numbers n{.radius = radius, .patch_radius = 1, .border = rule};
            for (const extent size : {extent{1, 1}, extent{2, 2}, extent{1, 9}, extent{13, 1}, extent{17, 5}})
                check_agreement(size, n, lanes_only, all_filters(n));
        }
}

TEST_CASE("lanes agree with the definition at every width around a register's") {
    const filter_numbers n{.radius = 3, .patch_radius = 2};
    for (const int width : {3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 47, 48, 49, 64, 65, 79, 80, 81, 96, 97})
        check_agreement({width, 3}, n, lanes_only, {nlm(n), rdfc_candidate(n), joint_bilateral(n), two_patches(n)});
}

TEST_CASE("lanes agree with the definition for windows much larger than the image") {
    for (const border rule : all_borders) {
        const filter_numbers n{.radius = 23, .patch_radius = 3, .border = rule};
        check_agreement({7, 5}, n, lanes_only, {nlm(n), rdfc_candidate(n), test::disk(n), three_candidates(n)});
    }
}

TEST_CASE("a window of radius 0 returns the input bit for bit") {
    const extent size{21, 9};
    const buffers in = make_buffers(size);
    for (const auto& f : all_filters({.radius = 0}))
        for (const executor_kind kind : {executor_kind::serial_double, executor_kind::serial, executor_kind::simd}) {
            if (f.name == "nlm dual buffer") continue;  // returns the mean of the halves
            CAPTURE(f.name, static_cast<int>(kind));
            for (const auto& found : f.images(in.layers(), size, {kind})) CHECK(other_bits(found, in.color) == "");
        }
}

TEST_CASE("the bits do not depend on the tile") {
    const auto with_tile = [](int width, int height) {
        return how{.kind = executor_kind::simd, .tile = {width, height}};
    };
    const std::vector<how> hows = {{executor_kind::simd}, with_tile(1, 1),   with_tile(16, 7),  with_tile(32, 1),
                                   with_tile(48, 5),      with_tile(64, 64), with_tile(400, 3), with_tile(1000, 1000)};
    for (const border rule : all_borders)
        check_same_bits({67, 45}, hows, all_filters({.radius = 2, .patch_radius = 1, .border = rule}));
}

TEST_CASE("the bits do not change from run to run") {
    check_same_bits({37, 23}, {{executor_kind::simd}, {executor_kind::simd}, {executor_kind::simd}}, all_filters());
}
