// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <string>
#include <support/catch.hpp>
#include <winnow/frame/planes.hpp>

using namespace winnow;

using some = planes<albedo_t, depth_t, variance_of<albedo_t>, normal_t>;

static_assert(planes<>::count == 0 && some::count == 10);

static_assert(contains<depth_t, some> && !contains<color_t, some> && !contains<depth_t, planes<>>);
static_assert(contains<variance_of<albedo_t>, some> && !contains<variance_of<depth_t>, some>);

static_assert(slot_of<albedo_t>(some{}) == 0);
static_assert(slot_of<depth_t>(some{}) == 3);
static_assert(slot_of<variance_of<albedo_t>>(some{}) == 4);
static_assert(slot_of<normal_t>(some{}) == 7);

// In the order of first mention, each once.
static_assert(std::is_same_v<joined<>, planes<>>);
static_assert(std::is_same_v<joined<planes<>, planes<>>, planes<>>);
static_assert(std::is_same_v<joined<some>, some>);
static_assert(std::is_same_v<joined<planes<depth_t>, planes<>, planes<albedo_t, depth_t>, planes<normal_t>>,
                             planes<depth_t, albedo_t, normal_t>>);
static_assert(std::is_same_v<joined<planes<depth_t, depth_t>>, planes<depth_t>>);

TEST_CASE("for_each meets the buffers in order") {
    std::string names;
    some::for_each([&](auto g) { names += g.name() + " "; });
    CHECK(names == "albedo depth albedo.variance normal ");
}
