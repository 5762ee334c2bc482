// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/io/channel_names.hpp>

#include <algorithm>
#include <support/catch.hpp>

using namespace winnow;
using names = std::vector<std::string>;
using io::channel_names;

TEST_CASE("channels are called as users of files expect: letters by what the guide is, layers by its name") {
    CHECK(channel_names(color) == names{"R", "G", "B"});
    CHECK(channel_names(albedo) == names{"albedo.R", "albedo.G", "albedo.B"});
    CHECK(channel_names(albedo2) == names{"albedo2.R", "albedo2.G", "albedo2.B"});
    CHECK(channel_names(normal) == names{"normal.X", "normal.Y", "normal.Z"});
    CHECK(channel_names(rest_position) == names{"rest_position.X", "rest_position.Y", "rest_position.Z"});
    CHECK(channel_names(motion_vector) == names{"motion_vector.X", "motion_vector.Y"});
    CHECK(channel_names(depth) == names{"depth.Z"});
    CHECK(channel_names(view_depth) == names{"view_depth.Z"});
    CHECK(channel_names(roughness) == names{"roughness.V"});
}

TEST_CASE("statistics of a guide are layers beside it; those of the colour stand alone") {
    CHECK(channel_names(variance(color)) == names{"variance.R", "variance.G", "variance.B"});
    CHECK(channel_names(first_half(color)) == names{"halfA.R", "halfA.G", "halfA.B"});
    CHECK(channel_names(variance(second_half(color)))[1] == "halfB.variance.G");
    CHECK(channel_names(first_half(normal))[0] == "normal.halfA.X");
    CHECK(channel_names(variance(depth)) == names{"depth.variance.Z"});
    CHECK(channel_names(covariance(position)) == names{"position.covariance.XX", "position.covariance.XY",
                                                       "position.covariance.XZ", "position.covariance.YY",
                                                       "position.covariance.YZ", "position.covariance.ZZ"});
    CHECK(channel_names(covariance(depth)) == names{"depth.covariance.ZZ"});
}

TEST_CASE("a list of guides has one name for each of its channels, all different") {
    using all = planes<color_t, variance_of<color_t>, half_a<color_t>, albedo_t, depth_t, covariance_of<position_t>>;
    names found = channel_names(all{});
    CHECK(static_cast<int>(found.size()) == all::count);
    CHECK(found[3] == "variance.R");
    std::sort(found.begin(), found.end());
    CHECK(std::unique(found.begin(), found.end()) == found.end());
}
