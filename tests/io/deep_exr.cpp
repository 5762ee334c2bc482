// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/io/deep_exr.hpp>

#include <bit>
#include <cstring>
#include <support/folder.hpp>
#include <support/scattered.hpp>
#include <winnow/io/exr.hpp>

using namespace winnow;
using test::folder;
using test::message_of;

namespace {

using some = planes<color_t, albedo_t, depth_t, position_t>;

/// Every value differs; some are no numbers.
samples<some> patterned(extent size, int spp) {
    samples<some> all(size, spp);
    std::uint32_t number = 1;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < spp; ++i) {
                sample<some> s;
                for (float& v : s.values) v = 1e6f * (test::scattered(number++) - 0.5f);
                if (number % 7 == 0) s.at(depth) = std::bit_cast<float>(0x7fc01234u);
                if (number % 11 == 0) s.at(color, 1) = -std::numeric_limits<float>::infinity();
                all.set(x, y, i, s);
            }
    return all;
}

template <class Planes>
int differing(const samples<Planes>& a, const samples<Planes>& b) {
    REQUIRE(a.size() == b.size());
    REQUIRE(a.per_pixel() == b.per_pixel());
    int count = 0;
    for (int y = 0; y < a.size().height; ++y)
        for (int x = 0; x < a.size().width; ++x)
            for (int i = 0; i < a.per_pixel(); ++i)
                count += std::memcmp(&a.at(x, y, i), &b.at(x, y, i), sizeof(sample<Planes>)) != 0;
    return count;
}

/// A deep file of another writer: half, float and unsigned channels, x + 2 y samples in pixel (x, y) of a window that
/// does not begin at the origin.
void write_foreign(const std::string& file, Imf::Compression compression) {
    const int x0 = -5, y0 = 7, width = 6, height = 4;
    Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), Imath::Box2i({x0, y0}, {x0 + width - 1, y0 + height - 1}));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = compression;
    header.channels().insert("H", Imf::Channel(Imf::HALF));
    header.channels().insert("U", Imf::Channel(Imf::UINT));
    header.channels().insert("depth.Z", Imf::Channel(Imf::FLOAT));
    std::vector<unsigned> counts(width * height);
    std::vector<std::vector<winnow::half>> h(width * height);
    std::vector<std::vector<std::uint32_t>> u(width * height);
    std::vector<std::vector<float>> z(width * height);
    std::vector<void*> pointers[3];
    for (auto& p : pointers) p.resize(width * height);
    for (int i = 0; i < width * height; ++i) {
        counts[i] = static_cast<unsigned>(i % width + 2 * (i / width));
        for (unsigned s = 0; s < counts[i]; ++s) {
            h[i].emplace_back(0.5f * static_cast<float>(s));
            u[i].push_back(100u * i + s);
            z[i].push_back(static_cast<float>(i) + 0.125f * static_cast<float>(s));
        }
        pointers[0][i] = h[i].data(), pointers[1][i] = u[i].data(), pointers[2][i] = z[i].data();
    }
    Imf::DeepFrameBuffer pixels;
    const int origin = y0 * width + x0;
    const auto base = [&](auto& v) {
        return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(v.data()) -
                                       origin * std::intptr_t{sizeof(v[0])});
    };
    pixels.insertSampleCountSlice(Imf::Slice(Imf::UINT, base(counts), 4, 4 * width));
    const char* names[] = {"H", "U", "depth.Z"};
    const Imf::PixelType types[] = {Imf::HALF, Imf::UINT, Imf::FLOAT};
    for (int c = 0; c < 3; ++c)
        pixels.insert(names[c], Imf::DeepSlice(types[c], base(pointers[c]), 8, 8 * width, c == 0 ? 2 : 4));
    Imf::DeepScanLineOutputFile out(file.c_str(), header);
    out.setFrameBuffer(pixels);
    out.writePixels(height);
}

}  // namespace

TEST_CASE("samples come back from a file bit for bit") {
    const folder f;
    for (const auto& [size, spp] : {std::pair{extent{13, 7}, 5}, {extent{1, 1}, 1}, {extent{1, 9}, 3}}) {
        const samples<some> all = patterned(size, spp);
        io::write_deep_exr(f / "a.exr", all, {{"scene", "a box"}});
        const io::deep_image image = io::read_deep_exr(f / "a.exr");
        CHECK(image.window == rectangle{0, 0, size.width, size.height});
        CHECK(image.names.size() == static_cast<std::size_t>(some::count));
        CHECK(differing(all, io::samples_of<some>(image)) == 0);
    }
    CHECK(f.files() == 1);
    Imf::MultiPartInputFile in(f.name("a.exr").c_str());
    CHECK(in.header(0).typedAttribute<Imf::StringAttribute>("scene").value() == "a box");
}

TEST_CASE("channels are found by name, in any order and among others") {
    const folder f;
    io::write_deep_exr(f / "a.exr", patterned({5, 4}, 2));
    const io::deep_image image = io::read_deep_exr(f / "a.exr");
    using fewer = planes<depth_t, color_t>;
    const samples<fewer> found = io::samples_of<fewer>(image);
    CHECK(found.at(3, 2, 1).at(color, 2) == patterned({5, 4}, 2).at(3, 2, 1).at(color, 2));
    CHECK(image.at(image.find("albedo.G"), 4, 3)[0] == patterned({5, 4}, 2).at(4, 3, 0).at(albedo, 1));
    CHECK(message_of([&] { io::samples_of<planes<color_t, roughness_t>>(image); }) ==
          f.name("a.exr") + ": there is no channel roughness.V");
}

TEST_CASE("files of other writers are read: varying counts, none, other types, another origin") {
    const folder f;
    for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION}) {
        write_foreign(f.name("b.exr"), compression);
        const io::deep_image image = io::read_deep_exr(f / "b.exr");
        CHECK(image.window == rectangle{-5, 7, 1, 11});
        REQUIRE(image.names == std::vector<std::string>{"H", "U", "depth.Z"});
        CHECK(image.count(0, 0) == 0);
        CHECK(image.count(5, 3) == 11);
        int wrong = 0;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 6; ++x) {
                const int i = 6 * y + x;
                wrong += image.count(x, y) != static_cast<std::size_t>(x + 2 * y);
                for (std::size_t s = 0; s < image.count(x, y); ++s) {
                    wrong += image.at(0, x, y)[s] != 0.5f * static_cast<float>(s);
                    wrong += image.at(1, x, y)[s] != static_cast<float>(100 * i) + static_cast<float>(s);
                    wrong += image.at(2, x, y)[s] != static_cast<float>(i) + 0.125f * static_cast<float>(s);
                }
            }
        CHECK(wrong == 0);
        CHECK(message_of([&] { io::samples_of<planes<depth_t>>(image); }) ==
              f.name("b.exr") + ": pixel (1, 0) has 1 samples, pixel (0, 0) has 0");
    }
}

TEST_CASE("bad deep files are told by name, in one line") {
    const folder f;
    const auto read = [&](const char* name) { return message_of([&] { io::read_deep_exr(f / name); }); };
    CHECK(read("nothing.exr") == f.name("nothing.exr") + ": no such file");
    f.write("text.exr", "not a picture");
    CHECK(read("text.exr") == f.name("text.exr") + ": not an EXR file");

    io::exr_image flat(rectangle{0, 0, 4, 4});
    flat.set("R", image<float>({4, 4}).view());
    io::write_exr(f / "flat.exr", flat);
    CHECK(read("flat.exr") == f.name("flat.exr") + ": holds no deep pixels");

    io::write_deep_exr(f / "whole.exr", patterned({16, 16}, 3));
    CHECK(message_of([&] { io::read_exr(f / "whole.exr"); }) == f.name("whole.exr") + ": holds deep pixels only");
    const std::string whole = f.read("whole.exr");
    const auto damaged = [&](const std::string& bytes) {
        f.write("cut.exr", bytes);
        const std::string message = read("cut.exr");
        CHECK(message.starts_with(f.name("cut.exr") + ": damaged or truncated ("));
        CHECK(message.find('\n') == std::string::npos);
    };
    for (std::size_t kept : {whole.size() - 1, whole.size() / 2, std::size_t{700}, std::size_t{100}, std::size_t{9}}) {
        INFO(kept << " bytes of " << whole.size());
        damaged(whole.substr(0, kept));
    }
    // A data window of two thousand million pixels in each row.
    std::string wide = whole;
    const std::size_t at = wide.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4 + 8;
    for (int i = 0; i < 4; ++i) wide[at + i] = static_cast<char>(i < 3 ? 0 : 0x3f);
    damaged(wide);
}

TEST_CASE("no damage to a deep file does more than fail") {
    const folder f;
    io::write_deep_exr(f / "whole.exr", patterned({8, 6}, 2));
    const std::string whole = f.read("whole.exr");
    for (std::size_t at = 8; at < whole.size(); at += 13) {
        std::string other = whole;
        other[at] = static_cast<char>(other[at] ^ 0x55);
        f.write("other.exr", other);
        message_of([&] { io::read_deep_exr(f / "other.exr"); });
    }
}

TEST_CASE("a deep file that cannot be written leaves nothing behind") {
    const folder f;
    const samples<some> all = patterned({64, 64}, 4);
    CHECK(message_of([&] { io::write_deep_exr(f / "missing" / "b.exr", all); }) ==
          "cannot write " + f.name("missing") + "/b.exr: No such file or directory");
    const auto message =
        test::with_files_of_at_most(2048, [&] { return message_of([&] { io::write_deep_exr(f / "a.exr", all); }); });
    CHECK(message == "cannot write " + f.name("a.exr") + ": File too large");
    CHECK(f.files() == 0);
}
