// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The contract of examples/simulate, kept by the built program.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <support/program.hpp>
#include <winnow/io/deep_exr.hpp>
#include <winnow/io/exr.hpp>

using namespace winnow;
using test::folder;
using test::outcome;

namespace {

outcome simulate(const std::string& arguments) { return test::run_program(std::string(SIMULATE) + " " + arguments); }

/// It must succeed without a word on stderr.
nlohmann::json rendered(const std::string& arguments) {
    const outcome o = simulate(arguments + " --json");
    INFO(arguments << "\n" << o.err);
    CHECK(o.err.empty());
    REQUIRE(o.code == 0);
    return nlohmann::json::parse(o.out);
}

/// It must refuse, in one line.
std::string refusal(const std::string& arguments) {
    const outcome o = simulate(arguments);
    INFO(arguments << "\n" << o.err);
    CHECK(o.code == 2);
    CHECK(o.lines() == 1);
    CHECK(o.out.empty());
    return o.err;
}

std::vector<std::string> scene_names() {
    std::istringstream list(simulate("--list").out);
    std::vector<std::string> names;
    for (std::string line; std::getline(list, line);)
        if (!line.starts_with(" ")) names.push_back(line.substr(0, line.find(' ')));
    return names;
}

bool same(const io::exr_image& a, const io::exr_image& b) {
    if (a.names() != b.names() || a.size() != b.size()) return false;
    for (const std::string& name : a.names())
        for (int y = 0; y < a.size().height; ++y)
            for (int x = 0; x < a.size().width; ++x) {
                const float p = a.find(name).at(x, y), q = b.find(name).at(x, y);
                if (std::memcmp(&p, &q, sizeof p) != 0) return false;
            }
    return true;
}

const std::string tiny = " --size 24x18 --spp 4 ";

}  // namespace

TEST_CASE("every scene renders, without a sample that is no number") {
    const folder out;
    const auto names = scene_names();
    CHECK(names.size() == 12);
    for (const std::string& name : names) {
        const auto j = rendered("--scene " + name + " --size 64x48 --spp 16 -o " + out.name("x.exr"));
        INFO(name << ": " << j.dump());
        CHECK(j["scene"] == name);
        CHECK(j["bad_samples"] == 0);
        CHECK(j["samples"] == 16);
        // Well exposed: neither dark nor burnt out.
        const image<float> picture = io::read_exr(out / "x.exr").read({"R", "G", "B"});
        double sum = 0;
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 64; ++x) sum += picture.at(x, y, c);
        const double mean = sum / (3 * 64 * 48);
        CHECK((mean > 0.05 && mean < 1));
    }
}

TEST_CASE("the same bits from any number of threads; other seeds, frames and patterns are other renders") {
    const folder out;
    const auto render = [&](const std::string& arguments) {
        rendered("--scene orbit " + tiny + arguments + " -o " + out.name("x.exr"));
        return io::read_exr(out / "x.exr");
    };
    const io::exr_image first = render("--threads 1");
    CHECK(same(first, render("--threads 1")));
    CHECK(same(first, render("--threads 2")));
    CHECK(same(first, render("--threads 7")));
    for (const char* other : {"--seed 2", "--frame 1", "--pattern independent"}) {
        INFO(other);
        CHECK_FALSE(same(first, render(other)));
    }
}

TEST_CASE("every layer comes with its variance and its halves, and the mean is that of the halves") {
    const folder out;
    rendered("--scene chess " + tiny + " -o " + out.name("x.exr"));
    const io::exr_image file = io::read_exr(out / "x.exr");
    for (const char* name : {"R", "variance.R", "halfA.G", "halfB.B", "albedo.R", "albedo.variance.G", "normal.halfA.X",
                             "depth.Z", "rest_position.Y", "lens_point.X", "visibility.V"})
        CHECK(file.find(name));
    for (const char* name : {"shutter_time.V", "position2.X", "caustic.V"}) CHECK_FALSE(file.find(name));
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 24; ++x) {
            const float mean = file.find("R").at(x, y), a = file.find("halfA.R").at(x, y),
                        b = file.find("halfB.R").at(x, y);
            CHECK(std::abs(mean - (a + b) / 2) <= 1e-6f * (1 + std::abs(mean)));
        }
}

TEST_CASE("layers and filters choose what is written") {
    const folder out;
    rendered("--scene cars " + tiny + " --layers albedo,normal.variance -o " + out.name("x.exr"));
    CHECK(io::read_exr(out / "x.exr").names() ==
          std::vector<std::string>{"B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "albedo.halfA.B",
                                   "albedo.halfA.G", "albedo.halfA.R", "albedo.halfB.B", "albedo.halfB.G",
                                   "albedo.halfB.R", "albedo.variance.B", "albedo.variance.G", "albedo.variance.R",
                                   "normal.variance.X", "normal.variance.Y", "normal.variance.Z"});
    rendered("--scene cars " + tiny + " --filter nlm -o " + out.name("x.exr"));
    const auto names = io::read_exr(out / "x.exr").names();
    CHECK(names == std::vector<std::string>{"B", "G", "R", "halfA.B", "halfA.G", "halfA.R", "halfB.B", "halfB.G",
                                            "halfB.R", "variance.B", "variance.G", "variance.R"});
}

#ifdef DENOISE
TEST_CASE("the variance of a feature is not taken for that of the colour") {
    const folder out;
    rendered("--scene cars " + tiny + "--layers color.halfA,color.halfB,albedo,normal -o " + out.name("x.exr"));
    const outcome o =
        test::run_program(std::string(DENOISE) + " --filter nlm " + out.name("x.exr") + " -o " + out.name("y.exr"));
    CHECK(o.err.empty());
    CHECK(o.code == 0);
}

TEST_CASE("what it writes, every filter of denoise reads, and makes better") {
    const folder out;
    rendered("--scene cars --size 96x72 --spp 8 -o " + out.name("x.exr"));
    rendered("--scene cars --size 96x72 --spp 256 --seed 9 -o " + out.name("reference.exr"));
    for (const char* filter : {"joint_bilateral", "nlm", "nlm_dual", "rdfc_candidate"}) {
        const outcome o =
            test::run_program(std::string(DENOISE) + " --json --filter " + filter + " " + out.name("x.exr") + " -o " +
                              out.name("y.exr") + " --reference " + out.name("reference.exr"));
        INFO(filter << o.err);
        REQUIRE(o.code == 0);
        const auto j = nlohmann::json::parse(o.out)["metrics"];
        CHECK(j["output"]["relmse"].get<double>() < j["input"]["relmse"].get<double>());
    }
}
#endif

TEST_CASE("samples travel as deep EXR, and their means are the render") {
    const folder out;
    rendered("--scene rings " + tiny + " --samples " + out.name("deep.exr") + " -o " + out.name("x.exr"));
    const io::exr_image flat = io::read_exr(out / "x.exr");
    const auto all = io::samples_of<planes<color_t, caustic_t, position2_t>>(io::read_deep_exr(out / "deep.exr"));
    REQUIRE(all.per_pixel() == 4);
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 24; ++x) {
            double sum = 0;
            for (int i = 0; i < 4; ++i) sum += all.at(x, y, i).at(color, 1);
            CHECK(std::abs(sum / 4 - flat.find("G").at(x, y)) <= 1e-5 * (1 + std::abs(sum)));
        }
}

TEST_CASE("references are made once, two independent ones, and again when they are of another size") {
    const folder out;
    const auto make = [&](const std::string& arguments) {
        const outcome o = simulate("--references " + out.name("refs") + " --scene ramp " + arguments);
        INFO(o.err);
        REQUIRE(o.code == 0);
        return std::pair(o.out, std::count(o.out.begin(), o.out.end(), '\n'));
    };
    CHECK(make(tiny).first.find("there already") == std::string::npos);
    const std::string again = make(tiny).first;
    CHECK(again.find("ramp_1.exr: there already") != std::string::npos);
    CHECK(again.find("ramp_2.exr: there already") != std::string::npos);
    CHECK(make(tiny + "--frame 1").first.find("there already") == std::string::npos);
    CHECK(make("--size 32x24 --spp 4").first.find("there already") == std::string::npos);
    const io::exr_image first = io::read_exr(out / "refs/ramp_1.exr"), second = io::read_exr(out / "refs/ramp_2.exr");
    CHECK_FALSE(same(first, second));
    CHECK(first.find("R"));
    CHECK(first.find("albedo.R"));
    CHECK_FALSE(first.find("variance.R"));
    // Against one reference, its noise counts; against two it does not.
    const std::string refs = out.name("refs/ramp_1.exr") + "," + out.name("refs/ramp_2.exr");
    const auto two = rendered("--scene ramp --size 32x24 --spp 16 --reference " + refs + " -o " + out.name("x.exr"));
    const auto one = rendered("--scene ramp --size 32x24 --spp 16 --reference " + out.name("refs/ramp_1.exr") + " -o " +
                              out.name("x.exr"));
    CHECK(two["metrics"]["relmse"].get<double>() < one["metrics"]["relmse"].get<double>());
}

TEST_CASE("bad usage is told in one line, and nothing is written") {
    const folder out;
    const std::string to = " -o " + out.name("x.exr");
    CHECK(refusal("--scene car" + to) == "simulate: there is no scene car; did you mean cars?\n");
    CHECK(refusal("--scene cars --sp 3" + to) == "simulate: unknown option --sp; did you mean --spp?\n");
    CHECK(refusal("--list --effect caustic") == "simulate: there is no effect caustic; did you mean caustics?\n");
    CHECK(refusal("--effect caustics --scene cars" + to) == "simulate: --effect caustics: goes with --list\n");
    CHECK(refusal("--scene cars --filter nl" + to) == "simulate: there is no filter nl; did you mean nlm?\n");
    CHECK(refusal("--scene ramp --layers visibility" + to) ==
          "simulate: --layers needs visibility, which ramp cannot give: it does not show area_light\n");
    CHECK(refusal("--scene ramp --layers albedo.varience" + to) ==
          "simulate: there is no layer albedo.varience; did you mean albedo.variance?\n");
    CHECK(refusal("--scene cars --size 4294967304x6" + to) == "simulate: --size 4294967304x6: expected WIDTHxHEIGHT\n");
    CHECK(refusal("--scene ramp --layers albdo" + to) == "simulate: there is no layer albdo; did you mean albedo?\n");
    CHECK(refusal("--scene cars --size 0x9" + to) == "simulate: --size 0x9: there are no pixels\n");
    CHECK(refusal("--scene cars --size -4x9" + to) == "simulate: --size -4x9: there are no pixels\n");
    CHECK(refusal("--scene cars --size 12" + to) == "simulate: --size 12: expected WIDTHxHEIGHT\n");
    CHECK(refusal("--scene cars --spp 0" + to) == "simulate: --spp 0: there must be at least one sample\n");
    CHECK(refusal("--scene cars --spp -3" + to) == "simulate: --spp -3: there must be at least one sample\n");
    CHECK(refusal("--scene cars --pattern sobol" + to) ==
          "simulate: --pattern sobol: expected stratified or independent\n");
    CHECK(refusal("--scene cars") == "simulate: no output: say -o OUTPUT.exr\n");
    CHECK(refusal(to) == "simulate: no scene: say --scene NAME; simulate --list names them\n");
    CHECK(refusal("--scene cars -o " + out.name("x.jpg")).find("is written as .exr or .png") != std::string::npos);
    CHECK(refusal("--scene cars -o /nowhere/x.exr").find("cannot write /nowhere/x.exr") != std::string::npos);
    CHECK(refusal("--scene cars" + tiny + "--reference " + out.name("none.exr") + to).find("no such file") !=
          std::string::npos);
    // More than any machine has; the bytes are those of the film and of its images.
    const std::string huge = refusal("--scene cars --size 400000x400000" + to);
    CHECK(huge.find("simulate: cars at 400000x400000 takes 1") == 0);
    CHECK(huge.find(" bytes of memory, this machine has ") != std::string::npos);
    CHECK(out.files() == 0);
}

TEST_CASE("an interrupt leaves no file behind") {
    const folder out;
    const outcome o = test::run_program("timeout -s INT 0.3 " + std::string(SIMULATE) +
                                        " --scene foliage --size 512x384 --spp 1000 -o " + out.name("x.exr"));
    CHECK(o.err == "simulate: interrupted; what was not finished is not written\n");
    CHECK(out.files() == 0);
}

TEST_CASE("progress says how far it is and how long it will take") {
    const folder out;
    const outcome o = simulate("--scene cars --size 128x96 --spp 32 --progress -o " + out.name("x.png"));
    CHECK(o.code == 0);
    CHECK(o.err.find("simulate: 100 %") != std::string::npos);
    CHECK(out.files() == 1);
}
