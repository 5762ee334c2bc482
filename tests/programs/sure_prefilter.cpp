// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The contract of examples/sure_prefilter, kept by the built program.
#include <cmath>
#include <nlohmann/json.hpp>
#include <support/program.hpp>

using namespace winnow;
using test::folder;
using test::outcome;

namespace {

outcome sure_prefilter(const std::string& arguments) {
    return test::run_program(std::string(SURE_PREFILTER) + " " + arguments);
}

/// It must refuse, in one line.
std::string refusal(const std::string& arguments) {
    const outcome o = sure_prefilter(arguments);
    INFO(arguments << "\n" << o.err);
    CHECK(o.code == 2);
    CHECK(o.lines() == 1);
    CHECK(o.out.empty());
    return o.err;
}

}  // namespace

TEST_CASE("sure_prefilter shows features before and after, and what a filter makes of either") {
    const folder out;
    const outcome o = sure_prefilter(
        "--scene chess --size 64x48 --spp 8 --filter guided --reference-spp 128 --json -o " + out.name("new/made"));
    INFO(o.err);
    CHECK(o.err.empty());
    REQUIRE(o.code == 0);
    for (const char* name : {"render.png", "without.png", "with.png", "albedo_before.png", "albedo_after.png",
                             "normal_before.png", "normal_after.png", "bandwidth.png", "reference.png"}) {
        INFO(name);
        CHECK(std::filesystem::exists(out / "new/made" / name));
        CHECK(std::filesystem::file_size(out / "new/made" / name) > 100);
    }
    const auto j = nlohmann::json::parse(o.out);
    CHECK(j["filter"] == "guided");
    CHECK(j["prefilter"] == "sure");
    for (const char* feature : {"albedo", "normal", "depth"})
        CHECK(j["features"][feature]["after"] < j["features"][feature]["before"].get<double>());
    const double render = j["metrics"]["render"]["relmse"], without = j["metrics"]["without"]["relmse"],
                 with = j["metrics"]["with"]["relmse"];
    CHECK(without < render);
    CHECK(with < without);
}

TEST_CASE("sure_prefilter without features that are cleaned is the filter alone") {
    const folder out;
    const outcome o = sure_prefilter(
        "--scene cars --size 48x36 --spp 4 --filter joint_bilateral --set radius=3 "
        "--prefilter none --json -o " +
        out.name("x"));
    REQUIRE(o.code == 0);
    CHECK(out.read("x/with.png") == out.read("x/without.png"));
    CHECK(out.read("x/albedo_before.png") == out.read("x/albedo_after.png"));
    CHECK(out.read("x/render.png") != out.read("x/without.png"));
}

TEST_CASE("sure_prefilter refuses bad usage in one line, with the nearest name") {
    const folder out;
    const std::string call = "--scene cars -o " + out.name("x") + " ";
    CHECK(refusal("") == "sure_prefilter: no scene: say --scene NAME; simulate --list names them\n");
    CHECK(refusal("--scene cars") == "sure_prefilter: no output: say -o FOLDER\n");
    CHECK(refusal("--scene crs -o " + out.name("x")).find("did you mean cars?") != std::string::npos);
    CHECK(refusal(call + "--filter sfb").find("did you mean sbf?") != std::string::npos);
    CHECK(refusal(call + "--prefilter shure").find("did you mean sure?") != std::string::npos);
    CHECK(refusal(call + "--spp 1").find("at least two samples") != std::string::npos);
    CHECK(refusal(call + "--filter sbf --set scales=2").find("did you mean scale?") != std::string::npos);
    CHECK(refusal(call + "--set scale") == "sure_prefilter: --set scale: expected key=value\n");
    CHECK_FALSE(std::filesystem::exists(out / "x"));
}
