// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The contract of examples/rdfc, kept by the built program.
#include <cmath>
#include <nlohmann/json.hpp>
#include <support/program.hpp>

using namespace winnow;
using test::folder;
using test::outcome;

namespace {

outcome rdfc(const std::string& arguments) { return test::run_program(std::string(RDFC) + " " + arguments); }

/// It must succeed without a word on stderr.
nlohmann::json filtered(const std::string& arguments) {
    const outcome o = rdfc(arguments + " --json");
    INFO(arguments << "\n" << o.err);
    CHECK(o.err.empty());
    REQUIRE(o.code == 0);
    return nlohmann::json::parse(o.out);
}

/// It must refuse, in one line.
std::string refusal(const std::string& arguments) {
    const outcome o = rdfc(arguments);
    INFO(arguments << "\n" << o.err);
    CHECK(o.code == 2);
    CHECK(o.lines() == 1);
    CHECK(o.out.empty());
    return o.err;
}

bool is_picture(const std::filesystem::path& file) {
    return std::filesystem::exists(file) && std::filesystem::file_size(file) > 100;
}

}  // namespace

TEST_CASE("rdfc renders, filters and shows which candidate it takes") {
    const folder out;
    const auto j = filtered("--scene conference --size 48x36 --spp 8 --reference-spp 128 -o " + out.name("new/made"));
    for (const char* name : {"before.png", "after.png", "selection.png", "reference.png"}) {
        INFO(name);
        CHECK(is_picture(out / "new/made" / name));
    }
    CHECK_FALSE(is_picture(out / "new/made/density.png"));
    CHECK(j["samples"]["total"] == 8 * 48 * 36);
    const double before = j["metrics"]["before"]["relmse"], after = j["metrics"]["after"]["relmse"];
    CHECK(std::isfinite(before));
    CHECK(after < before / 2);
}

TEST_CASE("rdfc samples adaptively, not one sample more or less") {
    const folder out;
    // 9 samples of 24x18 pixels in 4 shares: three of the shares have other numbers than the pixels.
    const auto j =
        filtered("--scene rings --size 24x18 --spp 9 --adaptive --radius 3 --reference-spp 16 -o " + out.name("x"));
    for (const char* name : {"before.png", "after.png", "selection.png", "density.png", "reference.png", "uniform.png"})
        CHECK(is_picture(out / "x" / name));
    CHECK(j["samples"]["total"] == 9 * 24 * 18);
    CHECK(j["samples"]["fewest"] >= 2);
    CHECK(j["samples"]["most"] > 9);
    for (const auto& [name, m] : j["metrics"].items()) {
        INFO(name);
        CHECK(std::isfinite(m["relmse"].get<double>()));
    }
}

TEST_CASE("rdfc: features and selections are of choice; a feature that the scene lacks is none") {
    const folder out;
    for (const char* said : {"--features brdf,normal --selection blend", "--features visibility --selection third",
                             "--outliers off --selection first", "--features caustic --selection second"})
        filtered(std::string("--scene ramp --size 24x18 --spp 4 --radius 3 ") + said + " -o " + out.name("x"));
}

TEST_CASE("rdfc: bad usage is told in one line, and nothing is written") {
    const folder out;
    const std::string to = " -o " + out.name("x");
    CHECK(refusal(to) == "rdfc: no scene: say --scene NAME; simulate --list names them\n");
    CHECK(refusal("--scene cars") == "rdfc: no output: say -o FOLDER\n");
    CHECK(refusal("--scene car" + to) == "rdfc: there is no scene car; did you mean cars?\n");
    CHECK(refusal("--scene cars --adaptiv" + to) == "rdfc: unknown option --adaptiv; did you mean --adaptive?\n");
    CHECK(refusal("--scene cars --features albdo" + to) ==
          "rdfc: --features: there is no albdo; did you mean albedo?\n");
    CHECK(refusal("--scene cars --selection binry" + to) ==
          "rdfc: --selection: there is no binry; did you mean binary?\n");
    CHECK(refusal("--scene cars --outliers no" + to) == "rdfc: --outliers no: expected on or off\n");
    CHECK(refusal("--scene cars --size 12" + to) == "rdfc: --size 12: expected WIDTHxHEIGHT\n");
    CHECK(refusal("--scene cars --spp 1" + to) ==
          "rdfc: --spp 1: there must be at least two samples, one for each half\n");
    CHECK(refusal("--scene cars --spp 7 --iterations 4 --adaptive" + to) ==
          "rdfc: --spp 7 in 4 iterations: there must be at least two in each\n");
    CHECK(refusal("--scene cars --reference a.exr --reference-spp 8" + to) ==
          "rdfc: --reference and --reference-spp both say what is measured against\n");
    CHECK(refusal("--scene cars --reference " + out.name("none.exr") + to).find("no such file") != std::string::npos);
    CHECK(refusal("--scene cars -o /proc/none") == "rdfc: cannot make the folder /proc/none\n");
    CHECK(out.files() == 0);
}
