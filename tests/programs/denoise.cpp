// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
// The contract of examples/denoise, kept by the built program.
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <support/program.hpp>
#include <winnow/io/exr.hpp>

using namespace winnow;
using test::folder;
using test::outcome;

namespace {

constexpr extent size{45, 34};
const float nan_value = std::numeric_limits<float>::quiet_NaN();
const float infinite = std::numeric_limits<float>::infinity();

outcome denoise(const std::string& arguments, const std::string& before = "") {
    return test::run_program(before + std::string(DENOISE) + " " + arguments);
}

/// A red and a blue field with a bright edge, of which the diffuse part is a third.
float truth(int x, int y, int c) {
    const bool left = x + y / 4 < size.width / 2;
    return c == (left ? 0 : 2) ? 2.0f : 0.25f + 0.01f * static_cast<float>(y);
}

image<float> rgb(unsigned seed, float noise) {
    std::mt19937 random(seed);
    std::normal_distribution<float> gauss(0, noise);
    image<float> values(size, 3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c) values.at(x, y, c) = truth(x, y, c) + (noise > 0 ? gauss(random) : 0);
    return values;
}

void set(io::exr_image& file, const std::string& layer, const char* channels, const image<float>& values) {
    for (int c = 0; c < values.channels(); ++c)
        file.set((layer.empty() ? "" : layer + ".") + channels[c], source(values.view()).channel(c));
}

image<float> map(const image<float>& from, const std::function<float(float, int, int, int)>& f) {
    image<float> to = from;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < to.channels(); ++c) to.at(x, y, c) = f(from.at(x, y, c), x, y, c);
    return to;
}

/// What a renderer writes: colour, two layers that add up to it, features, alpha, an attribute.
io::exr_image render(unsigned seed) {
    Imf::Header header(Imath::Box2i({0, 0}, {size.width + 9, size.height + 9}),
                       Imath::Box2i({3, 2}, {size.width + 2, size.height + 1}));
    header.insert("camera", Imf::StringAttribute("left"));
    io::exr_image file(header);
    const image<float> color = rgb(seed, 0.2f);
    set(file, "", "RGB", color);
    // Fractions of a power of two: the sum of both is the colour to the last bit.
    set(file, "diffuse", "RGB", map(color, [](float v, int, int, int) { return v / 4; }));
    set(file, "specular", "RGB", map(color, [](float v, int, int, int) { return v - v / 4; }));
    set(file, "albedo", "RGB", map(rgb(0, 0), [](float v, int, int, int) { return v / 2; }));
    set(file, "normal", "XYZ",
        map(color, [](float, int x, int, int c) { return c == (x < 20 ? 2 : 0) ? 1.0f : 0.0f; }));
    image<float> depth(size), alpha(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            depth.at(x, y) = 4 + static_cast<float>(y) / 8;
            alpha.at(x, y) = static_cast<float>((x + y) % 3) / 2;
        }
    set(file, "depth", "Z", depth);
    set(file, "", "A", alpha);
    return file;
}

/// Two renders, a reference, and the names to call the program with.
struct renders {
    folder in;
    std::string pair = in.name("a.exr") + " " + in.name("b.exr"), to = " -o " + in.name("out.exr");

    renders() {
        io::write_exr(in / "a.exr", render(1));
        io::write_exr(in / "b.exr", render(2));
        io::exr_image reference(rectangle{3, 2, size.width + 3, size.height + 2});
        set(reference, "", "RGB", rgb(0, 0));
        io::write_exr(in / "reference.exr", reference);
    }
    /// The program must succeed without a word.
    outcome run(const std::string& arguments) const {
        const outcome o = denoise(arguments + to);
        INFO(arguments << "\n" << o.err);
        CHECK(o.err.empty());
        REQUIRE(o.code == 0);
        return o;
    }
    /// The program must refuse, in one line, and write nothing.
    std::string refusal(const std::string& arguments) const {
        const int before = in.files();
        const outcome o = denoise(arguments);
        INFO(arguments << "\n" << o.err);
        CHECK(o.code == 2);
        CHECK(o.lines() == 1);
        CHECK(o.out.empty());
        CHECK(in.files() == before);
        return o.err.size() > 10 ? o.err.substr(9, o.err.size() - 10) : o.err;
    }
    io::exr_image result() const { return io::read_exr(in / "out.exr"); }
};

const std::vector<std::string> all_filters{"bilateral --set radius=4",
                                           "joint_bilateral --set radius=4",
                                           "nlm --set radius=4 --set patch_radius=2",
                                           "nlm_dual --set radius=4 --set patch_radius=2",
                                           "rdfc_candidate --set radius=4 --set patch_radius=1",
                                           "guided --set radius=4",
                                           "sbf --set scale=0.5 --set smoothing=1",
                                           "atrous --set levels=2",
                                           "rdfc --set radius=4 --set feature_radius=2"};

/// How many pixels differ, of those for which where(x, y).
int differing(const source& a, const source& b, const std::function<bool(int, int)>& where) {
    int count = 0;
    for (int y = 0; y < a.size.height; ++y)
        for (int x = 0; x < a.size.width; ++x)
            count +=
                where(x, y) && std::bit_cast<std::uint32_t>(a.at(x, y)) != std::bit_cast<std::uint32_t>(b.at(x, y));
    return count;
}
const auto everywhere = [](int, int) { return true; };

bool same_channels(const io::exr_image& a, const io::exr_image& b, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (!a.find(name) || !b.find(name) || differing(a.find(name), b.find(name), everywhere)) return false;
    return true;
}

}  // namespace

TEST_CASE("the list names every filter at the beginning of a line, with its layers and numbers") {
    const outcome o = denoise("--list");
    CHECK(o.code == 0);
    for (const char* name : {"bilateral ", "joint_bilateral ", "nlm ", "nlm_dual ", "rdfc_candidate ", "guided ",
                             "rdfc ", "sbf ", "atrous "})
        CHECK(("\n" + o.out).find(std::string("\n") + name) != std::string::npos);
    CHECK(o.out.find("needs color, albedo, normal") != std::string::npos);
    CHECK(o.out.find("--set radius=10") != std::string::npos);
    CHECK(denoise("--help").code == 0);
    CHECK(denoise("--version").out == WINNOW_VERSION "\n");
}

TEST_CASE("every filter lowers the error, says so in JSON, and carries over what it was not asked for") {
    const renders r;
    const io::exr_image a = io::read_exr(r.in / "a.exr");
    for (const std::string& filter : all_filters) {
        const std::string sigma = filter.starts_with("bilateral") ? " --set sigma_color=0.8" : "";
        const outcome o =
            r.run(r.pair + " --json --filter " + filter + sigma + " --reference " + r.in.name("reference.exr"));
        const auto j = nlohmann::json::parse(o.out);
        INFO(j.dump(2));
        CHECK(filter.starts_with(j["filter"].get<std::string>()));
        CHECK(j["width"] == size.width);
        CHECK(j["height"] == size.height);
        CHECK(j["threads"] >= 1);
        CHECK(j["executor"].is_string());
        for (const char* stage : {"read", "filter", "write"}) CHECK(j["seconds"][stage] >= 0);
        for (const char* kind : {"nan", "inf", "negative_variance"}) CHECK(j["bad_pixels"][kind] == 0);
        CHECK(j["estimated"]["mse"] > 0);
        CHECK(j["metrics"]["input"]["mse"] > 0.015);  // 0.2^2 / 2
        CHECK(j["metrics"]["input"]["mse"] < 0.025);
        for (const char* m : {"mse", "relmse"})
            CHECK(j["metrics"]["output"][m] < 0.6 * j["metrics"]["input"][m].get<double>());
        CHECK(j["metrics"]["output"]["psnr"] > j["metrics"]["input"]["psnr"]);
        CHECK(j["metrics"]["output"]["ssim"].is_number());

        const io::exr_image out = r.result();
        CHECK(out.names() == a.names());
        CHECK(same_channels(a, out, {"A", "diffuse.G", "specular.B", "albedo.R", "normal.Z", "depth.Z"}));
        CHECK_FALSE(same_channels(a, out, {"R"}));
        CHECK(out.data_window() == a.data_window());
        CHECK(out.header().displayWindow() == a.header().displayWindow());
        const auto text = [&](const char* name) {
            return out.header().typedAttribute<Imf::StringAttribute>(name).value();
        };
        CHECK(text("camera") == "left");
        CHECK(text("winnow:filter") == j["filter"]);
        const std::size_t said = filter.find("--set ") + 6;
        CHECK(text("winnow:numbers").find(filter.substr(said, filter.find(' ', said) - said)) != std::string::npos);
        CHECK(text("winnow:version") == WINNOW_VERSION);
    }
}

TEST_CASE("halves in one file are as good as two files, under the names of any renderer") {
    const renders r;
    const auto a = render(1), b = render(2);
    const std::vector<std::string> rgb_names{"R", "G", "B"};
    r.run(r.pair + " --filter " + all_filters[2]);
    const io::exr_image expected = r.result();
    io::exr_image one(a.header());
    set(one, "ViewLayer.halfA", "RGB", a.read(rgb_names));
    set(one, "ViewLayer.halfB", "RGB", b.read(rgb_names));
    io::write_exr(r.in / "one.exr", one);
    r.run(r.in.name("one.exr") + " --filter " + all_filters[2]);
    CHECK(same_channels(expected, r.result(), rgb_names));

    r.run(r.pair + " --filter " + all_filters[1]);
    const io::exr_image joint = r.result();
    for (int i = 0; i < 2; ++i) {
        const io::exr_image& from = i ? b : a;
        io::exr_image named(from.header());
        set(named, "View Layer.Combined", "RGB", from.read(rgb_names));
        set(named, "View Layer.Denoising Albedo", "RGB", from.read({"albedo.R", "albedo.G", "albedo.B"}));
        set(named, "odd", "XYZ", from.read({"normal.X", "normal.Y", "normal.Z"}));
        io::write_exr(r.in / (i ? "nb.exr" : "na.exr"), named);
    }
    const std::string named = r.in.name("na.exr") + " " + r.in.name("nb.exr") + " --filter " + all_filters[1];
    r.run(named + " --map normal=odd");
    for (const char* c : {"R", "G", "B"})
        CHECK(differing(joint.find(c), r.result().find(std::string("View Layer.Combined.") + c), everywhere) == 0);
    CHECK(r.refusal(named + r.to + " --map normal=od") ==
          r.in.name("na.exr") + ": --map normal=od: there is no such layer; did you mean odd?");
    CHECK(r.refusal(named + r.to + " --map nrmal=odd") ==
          "--map nrmal=odd: there is no buffer nrmal; did you mean normal?");
}

TEST_CASE("more than two inputs are averaged, and their alpha with them") {
    const renders r;
    io::exr_image c = render(3);
    c.set("A", image<float>(size).view());
    io::write_exr(r.in / "c.exr", c);
    r.run(r.pair + " " + r.in.name("c.exr") + " --filter bilateral --set radius=0");
    const auto a = render(1), b = render(2), out = r.result();
    for (int x = 0; x < size.width; ++x) {
        const double mean = (double{a.find("G").at(x, 9)} + b.find("G").at(x, 9) + c.find("G").at(x, 9)) / 3;
        CHECK(out.find("G").at(x, 9) == static_cast<float>(mean));
        CHECK(std::abs(out.find("A").at(x, 9) - a.find("A").at(x, 9) * 2 / 3) < 1e-6f);
    }
    for (const std::string& filter : all_filters) r.run(r.pair + " " + r.in.name("c.exr") + " --filter " + filter);
}

TEST_CASE("a crop is that part of the whole, bit for bit, and lies where it lay") {
    const renders r;
    for (const std::string& filter : all_filters) {
        INFO(filter);
        const std::string error = " --layers diffuse --error " + r.in.name("error.exr");
        r.run(r.pair + " --filter " + filter + error);
        const io::exr_image whole = r.result(), whole_error = io::read_exr(r.in / "error.exr");
        for (const char* corners : {"20,15,33,24", "3,2,9,36", "47,35,48,36"}) {
            r.run(r.pair + " --filter " + filter + error + " --crop " + corners);
            const io::exr_image part = r.result();
            rectangle w;
            REQUIRE(std::sscanf(corners, "%d,%d,%d,%d", &w.x0, &w.y0, &w.x1, &w.y1) == 4);
            CHECK(part.data_window() == w);
            CHECK(same_channels(whole.cropped(w), part, part.names()));
            CHECK(same_channels(whole_error.cropped(w), io::read_exr(r.in / "error.exr"), {"R", "G", "B"}));
        }
    }
}

TEST_CASE("the same bytes for any number of threads, and nearly the same from every executor") {
    const renders r;
    for (const std::string& filter : all_filters) {
        INFO(filter);
        const std::string common = r.pair + " --filter " + filter;
        r.run(common + " --executor simd");
        const io::exr_image simd = r.result();
        std::string bytes;
        for (int threads : {1, 2, 3}) {
            r.run(common + " --executor openmp --threads " + std::to_string(threads));
            const std::string now = r.in.read("out.exr");
            if (threads > 1) CHECK(now == bytes);
            bytes = now;
        }
        CHECK(same_channels(simd, r.result(), {"R", "G", "B"}));
        r.run(common + " --executor serial");
        const io::exr_image serial = r.result();
        for (int x = 0; x < size.width; ++x)
            CHECK(std::abs(serial.find("R").at(x, 11) - simd.find("R").at(x, 11)) < 1e-5f);
    }
}

TEST_CASE("layers that add up to the colour still do when they are filtered with it") {
    const renders r;
    for (const std::string& filter : all_filters)
        for (const char* layers : {"diffuse,specular", "all"}) {
            INFO(filter << " " << layers);
            r.run(r.pair + " --layers " + layers + " --filter " + filter);
            const io::exr_image out = r.result();
            float worst = 0;
            for (const char* c : {"R", "G", "B"})
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x) {
                        const float sum = out.find(std::string("diffuse.") + c).at(x, y) +
                                          out.find(std::string("specular.") + c).at(x, y);
                        worst = std::max(worst, std::abs(sum - out.find(c).at(x, y)));
                    }
            CHECK(worst < 4e-6f);
            CHECK(same_channels(render(1), out, {"albedo.R", "normal.X"}));
        }
}

TEST_CASE("bad pixels are counted, located and contained") {
    const renders r;
    const int px = 12, py = 14, reach = 4 + 2 + 2 + 1 + 1;  // window, patch, its weights' mean, mending, variance
    for (const std::string& filter : all_filters) {
        INFO(filter);
        r.run(r.pair + " --filter " + filter);
        const io::exr_image clean = r.result();
        io::exr_image a = render(1);
        const auto spoil = [&](const char* channel, float bad) {
            image<float> values = a.read({channel});
            values.at(px, py) = bad;
            a.set(channel, values.view());
        };
        spoil("R", nan_value);
        spoil("G", infinite);
        spoil("normal.Y", nan_value);
        io::write_exr(r.in / "bad.exr", a);
        const std::string bad_pair = r.in.name("bad.exr") + " " + r.in.name("b.exr") + " --filter " + filter;
        const outcome o = denoise(bad_pair + r.to + " --json --diagnose");
        REQUIRE(o.code == 0);
        const auto counts = nlohmann::json::parse(o.out)["bad_pixels"];
        CHECK(counts["nan"] == (o.err.find("normal, ") == std::string::npos ? 1 : 2));
        CHECK(counts["inf"] == 1);
        CHECK(o.err.find(r.in.name("bad.exr") + ": color, 45x34, 1 NaN at 12,14, 1 infinite at 12,14\n") !=
              std::string::npos);
        const io::exr_image out = r.result();
        for (const char* c : {"R", "G", "B"}) {
            const auto far = [&](int x, int y) { return std::max(std::abs(x - px), std::abs(y - py)) > reach; };
            // RDFC looks further than this image is wide; what it changes there is little.
            const bool whole_image = filter.starts_with("rdfc ");
            if (!whole_image) CHECK(differing(clean.find(c), out.find(c), far) == 0);
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    REQUIRE(std::isfinite(out.find(c).at(x, y)));
                    if (whole_image && far(x, y))
                        REQUIRE(std::abs(out.find(c).at(x, y) - clean.find(c).at(x, y)) < 0.05f);
                }
        }
        const outcome quiet = denoise(bad_pair + r.to);
        CHECK(quiet.code == 0);
        CHECK(quiet.lines() == 1);
    }

    io::exr_image one = render(1);
    set(one, "halfA", "RGB", rgb(4, 0.2f));
    set(one, "halfB", "RGB", rgb(5, 0.2f));
    image<float> noise = map(rgb(0, 0), [](float, int, int, int) { return 0.02f; });
    noise.at(7, 8, 1) = -1;
    set(one, "variance", "RGB", noise);
    io::write_exr(r.in / "one.exr", one);
    const outcome o = denoise(r.in.name("one.exr") + " --diagnose");
    CHECK(o.code == 0);
    CHECK(o.err.find("variance, 45x34, 1 negative at 7,8\n") != std::string::npos);
    CHECK(o.err.find("color is not the mean of its halves") != std::string::npos);
}

TEST_CASE("pictures, and the estimated error") {
    const renders r;
    const auto png = [&](const char* name) { return r.in.read(name).substr(0, 4) == "\x89PNG"; };
    const outcome o = denoise(r.pair + " -o " + r.in.name("p.png") + " --error " + r.in.name("e.png"));
    CHECK(o.code == 0);
    CHECK(png("p.png"));
    CHECK(png("e.png"));
    CHECK(denoise(r.pair + r.to + " --progress").err.ends_with("denoise: 100 %\n"));
}

namespace {

/// A render of a moving thing: of each of its samples albedo and position are those of where it was then.
io::exr_image moving_render(unsigned seed) {
    io::exr_image file = render(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> shutter(-0.5f, 0.5f);
    image<float> position(size, 3), albedo(size, 3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float at = static_cast<float>(x) + 4 * shutter(random);
            position.at(x, y, 0) = at, position.at(x, y, 1) = static_cast<float>(y), position.at(x, y, 2) = 7;
            for (int c = 0; c < 3; ++c) albedo.at(x, y, c) = 0.5f + 0.4f * std::sin(0.4f * at);
        }
    set(file, "position", "XYZ", position);
    set(file, "albedo", "RGB", albedo);
    return file;
}

}  // namespace

TEST_CASE("pre-filters clean the features for any filter, with the same result in crops and on any threads") {
    const renders r;
    std::string all;
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        const std::string name = "moving" + std::to_string(seed) + ".exr";
        io::write_exr(r.in / name, moving_render(seed));
        all += r.in.name(name) + " ";
    }
    const std::string call = all + "--filter joint_bilateral --set radius=4 ";
    r.run(call);
    const io::exr_image noisy = r.result();
    for (const char* prefilter : {"sure", "nlm", "bilateral"}) {
        const std::string with = call + "--prefilter " + prefilter;
        r.run(with);
        const io::exr_image clean = r.result();
        CAPTURE(prefilter);
        CHECK_FALSE(same_channels(noisy, clean, {"R"}));
        CHECK(clean.header().typedAttribute<Imf::StringAttribute>("winnow:prefilter").value() == prefilter);
        r.run(with + " --threads 1");
        CHECK(same_channels(clean, r.result(), {"R", "G", "B"}));
        r.run(with + " --crop 20,15,30,22");
        const io::exr_image crop = r.result();
        const rectangle window = clean.data_window();
        int different = 0;
        for (int y = 15; y < 22; ++y)
            for (int x = 20; x < 30; ++x)
                different += crop.find("G").at(x - 20, y - 15) != clean.find("G").at(x - window.x0, y - window.y0);
        CHECK(different == 0);
    }
    // One file tells how positions spread in layers of their own.
    CHECK(r.refusal(r.in.name("moving1.exr") + r.to + " --filter joint_bilateral --prefilter sure")
              .find("needs the covariance of the positions") != std::string::npos);
    CHECK(r.refusal(r.pair + r.to + " --filter joint_bilateral --prefilter sure").find("position") !=
          std::string::npos);
}

TEST_CASE("bad usage is refused in one line, with the nearest name") {
    const renders r;
    const std::string call = r.pair + r.to + " ";
    CHECK(r.refusal("") == "no input; try denoise --help");
    CHECK(r.refusal(r.pair) == "no output: say -o OUTPUT.exr");
    CHECK(r.refusal(r.pair + " -o " + r.in.name("out.jpg")) ==
          r.in.name("out.jpg") + ": a result is written as .exr or .png");
    CHECK(r.refusal(call + "--filter nml") == "there is no filter nml; did you mean nlm?");
    CHECK(r.refusal(call + "--prefliter sure") == "unknown option --prefliter; did you mean --prefilter?");
    CHECK(r.refusal(call + "--prefilter nml") == "there is no pre-filter nml; did you mean nlm?");
    CHECK(r.refusal(call + "--filter nlm --set radus=3") == "nlm has no number radus; did you mean radius?");
    CHECK(r.refusal(call + "--set radius=101") == "--set radius=101: radius is a whole number from 0 to 100");
    for (const char* bad : {"radius=2.5", "radius=-1", "radius=x", "radius=nan", "k=0", "k=inf", "k=1e300", "k=1x"})
        CHECK(r.refusal(call + "--filter nlm --set " + bad).starts_with(std::string("--set ") + bad + ": "));
    CHECK(r.refusal(call + "--set radius") == "--set radius: expected key=value");
    CHECK(r.refusal(call + "--executor smid") == "there is no executor smid; did you mean simd?");
    CHECK(r.refusal(call + "--executor simd --threads 2") == "--threads 2: simd runs on one thread");
    r.refusal(call + "--threads 0");
    r.refusal(call + "--threads many");
    CHECK(r.refusal(call + "--crop 1,2,3") == "--crop 1,2,3: expected x0,y0,x1,y1");
    CHECK(r.refusal(call + "--crop 9,9,9,12") == "--crop 9,9,9,12: is empty");
    CHECK(r.refusal(call + "--crop 0,0,9,9") == "--crop 0,0,9,9: " + r.in.name("a.exr") + " has the pixels 3,2,48,36");
    CHECK(r.refusal(call + "--layers difuse") ==
          r.in.name("a.exr") + ": there is no layer difuse; did you mean diffuse?");
}

TEST_CASE("bad input is refused in one line that names file, layer and sizes") {
    const renders r;
    CHECK(r.refusal(r.in.name("c.exr") + r.to) == r.in.name("c.exr") + ": no such file");
    r.in.write("text.exr", "text");
    CHECK(r.refusal(r.in.name("text.exr") + r.to) == r.in.name("text.exr") + ": not an EXR file");
    const std::string whole = r.in.read("a.exr");
    r.in.write("cut.exr", whole.substr(0, whole.size() / 2));
    CHECK(r.refusal(r.in.name("cut.exr") + r.to).starts_with(r.in.name("cut.exr") + ": damaged or truncated ("));
    std::string none = whole;
    const std::size_t at = none.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
    for (int i = 0; i < 16; ++i) none[at + i] = static_cast<char>(i < 8 ? 0 : 0xff);
    r.in.write("none.exr", none);
    CHECK(r.refusal(r.in.name("none.exr") + r.to) == r.in.name("none.exr") + ": the image is 0x0, there are no pixels");
    io::write_exr(r.in / "small.exr", render(1).cropped({5, 2, 30, 20}));
    CHECK(r.refusal(r.in.name("a.exr") + " " + r.in.name("small.exr") + r.to) ==
          r.in.name("small.exr") + " is 25x18 at 5,2, " + r.in.name("a.exr") + " is 45x34 at 3,2");
    CHECK(r.refusal(r.pair + r.to + " --reference " + r.in.name("small.exr")) ==
          r.in.name("small.exr") + " is 25x18 at 5,2, the input is 45x34 at 3,2");

    io::exr_image bare(render(1).header());
    set(bare, "", "RGB", rgb(1, 0.2f));
    io::write_exr(r.in / "bare.exr", bare);
    CHECK(r.refusal(r.in.name("bare.exr") + r.to + " --filter joint_bilateral") ==
          r.in.name("bare.exr") +
              ": joint_bilateral needs albedo, which is not there (layers: B, G, R); name it with --map albedo=LAYER");
    CHECK(r.refusal(r.in.name("a.exr") + " " + r.in.name("bare.exr") + r.to + " --filter bilateral --layers diffuse") ==
          r.in.name("bare.exr") + ": there is no diffuse.R, but " + r.in.name("a.exr") + " has it");
    CHECK(r.refusal(r.in.name("bare.exr") + r.to + " --filter nlm_dual")
              .starts_with(r.in.name("bare.exr") + ": nlm_dual needs two halves"));
    CHECK(r.refusal(r.in.name("a.exr") + r.to + " --filter rdfc_candidate")
              .starts_with(r.in.name("a.exr") + ": rdfc_candidate needs the variance"));
    CHECK(r.refusal(r.in.name("bare.exr") + r.to + " --filter bilateral --error " + r.in.name("e.exr"))
              .starts_with("--error: "));
    io::exr_image colourless(render(1).header());
    colourless.set("Z", image<float>(size).view());
    io::write_exr(r.in / "colourless.exr", colourless);
    CHECK(r.refusal(r.in.name("colourless.exr") + r.to).find("needs color, which is not there (layers: Z)") !=
          std::string::npos);
}

TEST_CASE("an output that cannot be written is refused, and what was there stays") {
    const renders r;
    CHECK(r.refusal(r.pair + " -o " + r.in.name("a.exr") + "/out.exr") ==
          "cannot write " + r.in.name("a.exr") + "/out.exr: Not a directory");
    r.in.write("old.exr", "old");
    const int before = r.in.files();
    const outcome full = denoise(r.pair + " -o " + r.in.name("old.exr"), "trap '' XFSZ; ulimit -f 4; ");
    CHECK(full.code == 2);
    CHECK(full.err == "denoise: cannot write " + r.in.name("old.exr") + ": File too large\n");
    CHECK(full.out.empty());
    CHECK((r.in.read("old.exr") == "old"));  // in brackets: not printed
    CHECK(r.in.files() == before);
}
