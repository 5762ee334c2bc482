// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/io/exr.hpp>

#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <support/folder.hpp>

using namespace winnow;
using test::folder;
using test::message_of;

namespace {

/// Every pixel of every channel differs.
float pattern(int x, int y, int c) {
    return 0.5f + static_cast<float>(x) + 100.0f * static_cast<float>(y) + 0.125f * static_cast<float>(c);
}

image<float> plane(extent size, int c) {
    image<float> one(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) one.at(x, y) = pattern(x, y, c);
    return one;
}

void check_plane(const source& found, extent size, int c) {
    REQUIRE(found.size == size);
    int wrong = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) wrong += found.at(x, y) != pattern(x, y, c);
    CHECK(wrong == 0);
}

Imf::Header header_of(rectangle r) {
    return Imf::Header(Imath::Box2i({0, 0}, {99, 99}), Imath::Box2i({r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}));
}

}  // namespace

TEST_CASE("what is written is read again: names, types, values, windows and attributes") {
    const folder f;
    const rectangle window{-3, 5, 10, 12};
    Imf::Header header = header_of(window);
    header.insert("owner", Imf::StringAttribute("somebody"));
    io::exr_image image(header);
    const extent size{13, 7};
    image.set("R", plane(size, 0).view());
    image.set("albedo.G", plane(size, 1).view(), scalar::float16);
    image.set_attribute("note", "hello");
    io::write_exr(f / "a.exr", image);

    const io::exr_image back = io::read_exr(f / "a.exr");
    CHECK(back.names() == std::vector<std::string>{"R", "albedo.G"});
    CHECK(back.data_window() == window);
    CHECK(back.header().displayWindow() == header.displayWindow());
    check_plane(back.find("R"), size, 0);
    CHECK(back.find("R").type == scalar::float32);
    CHECK(back.find("albedo.G").type == scalar::float16);
    CHECK(back.find("albedo.G").at(2, 0) == float(winnow::half(pattern(2, 0, 1))));
    CHECK(back.header().typedAttribute<Imf::StringAttribute>("owner").value() == "somebody");
    CHECK(back.header().typedAttribute<Imf::StringAttribute>("note").value() == "hello");
    CHECK_FALSE(back.find("G"));
    CHECK(f.files() == 1);
}

TEST_CASE("a crop keeps names, types and the coordinates of its pixels") {
    io::exr_image image(rectangle{10, 20, 30, 35});
    image.set("Z", plane({20, 15}, 3).view());
    const io::exr_image part = image.cropped({12, 25, 17, 31});
    CHECK(part.data_window() == rectangle{12, 25, 17, 31});
    REQUIRE(part.find("Z").size == extent{5, 6});
    CHECK(part.find("Z").at(0, 0) == pattern(2, 5, 3));
    CHECK(part.find("Z").at(4, 5) == pattern(6, 10, 3));
}

TEST_CASE("a channel that is written anew keeps its type, and unsigned integers come back exactly") {
    const folder f;
    const std::uint32_t ids[4] = {0, 7, 16777217u, 4294967295u};
    {
        Imf::Header header(2, 2);
        header.channels().insert("id", Imf::Channel(Imf::UINT));
        header.channels().insert("R", Imf::Channel(Imf::HALF));
        Imf::OutputFile out(f.name("u.exr").c_str(), header);
        Imf::FrameBuffer pixels;
        const winnow::half red[4] = {};
        pixels.insert("id", Imf::Slice(Imf::UINT, const_cast<char*>(reinterpret_cast<const char*>(ids)), 4, 8));
        pixels.insert("R", Imf::Slice(Imf::HALF, const_cast<char*>(reinterpret_cast<const char*>(red)), 2, 4));
        out.setFrameBuffer(pixels);
        out.writePixels(2);
    }
    io::exr_image image = io::read_exr(f / "u.exr");
    CHECK(image.find("id").at(1, 0) == 7.0f);
    CHECK(image.find("id").at(0, 1) == 16777216.0f);
    image.set("R", plane({2, 2}, 0).view());
    CHECK(image.find("R").type == scalar::float16);
    io::write_exr(f / "v.exr", image);
    std::uint32_t read[4] = {};
    Imf::MultiPartInputFile in(f.name("v.exr").c_str());
    Imf::InputPart part(in, 0);
    Imf::FrameBuffer pixels;
    pixels.insert("id", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(read), 4, 8));
    part.setFrameBuffer(pixels);
    part.readPixels(0, 1);
    for (int i = 0; i < 4; ++i) CHECK(read[i] == ids[i]);
}

TEST_CASE("tiled files are read like any other") {
    const folder f;
    const extent size{37, 21};
    {
        Imf::Header header(size.width, size.height);
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        header.setTileDescription(Imf::TileDescription(16, 16, Imf::MIPMAP_LEVELS));
        Imf::TiledOutputFile out(f.name("t.exr").c_str(), header);
        const image<float> values = plane(size, 2);
        for (int level = 0; level < out.numLevels(); ++level) {
            Imf::FrameBuffer pixels;
            pixels.insert("Y",
                          Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(&values.at(0, 0))), 4,
                                     4 * size.width));
            out.setFrameBuffer(pixels);
            out.writeTiles(0, out.numXTiles(level) - 1, 0, out.numYTiles(level) - 1, level);
        }
    }
    const io::exr_image image = io::read_exr(f / "t.exr");
    check_plane(image.find("Y"), size, 2);
    io::write_exr(f / "s.exr", image);
    check_plane(io::read_exr(f / "s.exr").find("Y"), size, 2);
}

TEST_CASE("all parts are read into the union of their windows, named so that none hides another") {
    const folder f;
    {
        std::vector<Imf::Header> headers{header_of({0, 0, 4, 4}), header_of({2, 1, 8, 3})};
        const char* names[] = {"beauty", "albedo"};
        for (int p = 0; p < 2; ++p) {
            headers[p].setName(names[p]);
            headers[p].setType(Imf::SCANLINEIMAGE);
            headers[p].channels().insert("R", Imf::Channel(Imf::FLOAT));
        }
        Imf::MultiPartOutputFile out(f.name("m.exr").c_str(), headers.data(), 2);
        std::vector<float> ones(64, 1.0f), twos(64, 2.0f);
        for (int p = 0; p < 2; ++p) {
            Imf::OutputPart part(out, p);
            Imf::FrameBuffer pixels;
            pixels.insert("R", Imf::Slice::Make(Imf::FLOAT, p ? twos.data() : ones.data(), headers[p].dataWindow()));
            part.setFrameBuffer(pixels);
            part.writePixels(p ? 2 : 4);
        }
    }
    const io::exr_image image = io::read_exr(f / "m.exr");
    CHECK(image.data_window() == rectangle{0, 0, 8, 4});
    CHECK(image.names() == std::vector<std::string>{"R", "albedo.R"});
    const auto value = [&](const char* name, int x, int y) { return image.find(name).at(x, y); };
    CHECK(value("R", 3, 3) == 1);
    CHECK(value("R", 4, 0) == 0);
    CHECK(value("albedo.R", 2, 1) == 2);
    CHECK(value("albedo.R", 7, 2) == 2);
    CHECK(value("albedo.R", 1, 1) == 0);
    CHECK(value("albedo.R", 2, 3) == 0);
}

TEST_CASE("bad files are told by name, in one line") {
    const folder f;
    const auto read = [&](const char* name) { return message_of([&] { io::read_exr(f / name); }); };
    CHECK(read("nothing.exr") == f.name("nothing.exr") + ": no such file");
    CHECK(read("") == f.name("") + ": is a folder, not an EXR file");
    f.write("text.exr", "not a picture");
    CHECK(read("text.exr") == f.name("text.exr") + ": not an EXR file");
    f.write("empty.exr", "");
    CHECK(read("empty.exr") == f.name("empty.exr") + ": not an EXR file");

    io::exr_image image(rectangle{0, 0, 64, 64});
    image.set("R", plane({64, 64}, 0).view());
    io::write_exr(f / "whole.exr", image);
    const std::string whole = f.read("whole.exr");
    for (std::size_t kept : {whole.size() - 1, whole.size() / 2, std::size_t{330}, std::size_t{100}, std::size_t{9}}) {
        INFO(kept << " bytes of " << whole.size());
        f.write("cut.exr", whole.substr(0, kept));
        const std::string message = read("cut.exr");
        CHECK(message.starts_with(f.name("cut.exr") + ": damaged or truncated ("));
        CHECK(message.find('\n') == std::string::npos);
    }

    // max = min - 1: no columns and no rows.
    std::string none = whole;
    const std::size_t at = none.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
    for (int i = 0; i < 16; ++i) none[at + i] = static_cast<char>(i < 8 ? 0 : 0xff);
    f.write("none.exr", none);
    CHECK(read("none.exr") == f.name("none.exr") + ": the image is 0x0, there are no pixels");
}

TEST_CASE("a file that cannot be written leaves nothing behind, and leaves alone what was there") {
    const folder f;
    io::exr_image image(rectangle{0, 0, 64, 64});
    image.set("R", plane({64, 64}, 0).view());
    f.write("a", "kept");
    const auto write = [&](const std::filesystem::path& path) {
        return message_of([&] { io::write_exr(path, image); });
    };
    CHECK(write(f / "a" / "b.exr") == "cannot write " + f.name("a") + "/b.exr: Not a directory");
    CHECK(write(f / "missing" / "b.exr") == "cannot write " + f.name("missing") + "/b.exr: No such file or directory");
    CHECK(write("/dev/full") == "cannot write /dev/full: not a regular file");
    f.write("old.exr", "old");
    const auto message = test::with_files_of_at_most(2048, [&] { return write(f / "old.exr"); });
    CHECK(message == "cannot write " + f.name("old.exr") + ": File too large");
    CHECK((f.read("old.exr") == "old"));  // in brackets: not printed
    CHECK(f.read("a") == "kept");
    CHECK(f.files() == 2);
}

TEST_CASE("channels of another size, and channels that are not there, are refused by name") {
    io::exr_image image(rectangle{0, 0, 4, 3});
    CHECK(message_of([&] { image.set("R", plane({3, 3}, 0).view()); }) == "R is 3x3, the image is 4x3");
    CHECK(message_of([&] { image.read({"R"}); }) == "there is no channel R");
}
