// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Flat OpenEXR files: every channel of every part in, one part out.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <algorithm>
#include <string>
#include <vector>
#include <winnow/core/error.hpp>
#include <winnow/image/image.hpp>
#include <winnow/image/plane.hpp>
#include <winnow/io/exr_file.hpp>

namespace winnow::io {

/// Named channels over one data window, with the attributes of a header.  Half and float stay what they are in the
/// file; unsigned integers are read as float and written back as they were.
class exr_image {
public:
    exr_image() : exr_image(rectangle{0, 0, 1, 1}) {}
    /// No channels yet; data and display window are the same.
    explicit exr_image(rectangle window) : header_(box(window), box(window)) {}
    /// No channels yet; the attributes of somebody else's header.
    explicit exr_image(const Imf::Header& header) {
        // Left out is what belongs to the storage of that file, or shows its old pixels; Header::erase would leak it.
        const auto stays = [](const std::string& name) {
            for (const char* other :
                 {"tiles", "type", "chunkCount", "version", "preview", "maxSamplesPerPixel", "channels", "lineOrder"})
                if (name == other) return false;
            return true;
        };
        for (auto a = header.begin(); a != header.end(); ++a)
            if (stays(a.name())) header_.insert(a.name(), a.attribute());
    }

    /// Where the pixels are, in the coordinates of the file; (0, 0) of every channel is its upper left corner.
    rectangle data_window() const {
        const auto& w = header_.dataWindow();
        return {w.min.x, w.min.y, w.max.x + 1, w.max.y + 1};
    }
    extent size() const { return data_window().size(); }

    /// The attributes; its channel list says the names and types of what is here.
    const Imf::Header& header() const { return header_; }
    void set_attribute(const std::string& name, const std::string& text) {
        header_.insert(name.c_str(), Imf::StringAttribute(text));
    }

    /// All names in the order of the file.
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const channel& c : channels_) all.push_back(c.name);
        return all;
    }

    /// The channel of this name, valid until the image changes; an empty source where there is none.
    source find(const std::string& name) const {
        for (const channel& c : channels_)
            if (c.name == name) return c.view(size());
        return {};
    }

    /// Several channels together, as float.  Fails where one is missing.
    image<float> read(const std::vector<std::string>& names) const {
        image<float> together(size(), static_cast<int>(names.size()));
        for (int c = 0; c < together.channels(); ++c) {
            const source one = find(names[c]);
            if (!one) fail("there is no channel " + names[c]);
            for (int y = 0; y < size().height; ++y)
                for (int x = 0; x < size().width; ++x) together.at(x, y, c) = one.at(x, y);
        }
        return together;
    }

    /// Writes one channel.  A channel that is there keeps its type, a new one gets `type`.
    void set(const std::string& name, const source& values, scalar type = scalar::float32) {
        if (values.size != size()) fail(name + " is " + to_string(values.size) + ", the image is " + to_string(size()));
        const auto known = header_.channels().findChannel(name.c_str());
        channel& c = known ? *std::find_if(channels_.begin(), channels_.end(), [&](auto& o) { return o.name == name; })
                           : add(name, type == scalar::float16 ? Imf::HALF : Imf::FLOAT);
        if (c.type == Imf::UINT) retype(c, Imf::FLOAT);
        const target to{planar(reinterpret_cast<float*>(c.bytes.data()), size(), 1)};
        const target half_to{planar(reinterpret_cast<half*>(c.bytes.data()), size(), 1)};
        for (int y = 0; y < size().height; ++y)
            for (int x = 0; x < size().width; ++x) (c.type == Imf::HALF ? half_to : to).set(x, y, values.at(x, y));
    }

    /// The same channels and attributes over a part of the data window.
    exr_image cropped(rectangle window) const {
        exr_image part(header_);
        part.header_.dataWindow() = box(window);
        const rectangle from = data_window();
        for (const channel& c : channels_) {
            channel& to = part.add(c.name, c.type);
            const std::size_t pixel = bytes_of(c.type), row = pixel * window.size().width;
            for (int y = window.y0; y < window.y1; ++y)
                std::copy_n(c.bytes.data() + (std::size_t(y - from.y0) * size().width + (window.x0 - from.x0)) * pixel,
                            row, to.bytes.data() + std::size_t(y - window.y0) * row);
            to.convert();
        }
        return part;
    }

private:
    friend exr_image read_exr(const std::filesystem::path&);
    friend void write_exr(const std::filesystem::path&, const exr_image&);

    struct channel {
        std::string name;
        Imf::PixelType type = Imf::FLOAT;
        std::vector<std::byte> bytes;  ///< one row after another
        std::vector<float> converted;  ///< of unsigned integers

        source view(extent size) const {
            if (type == Imf::HALF) return planar(reinterpret_cast<const half*>(bytes.data()), size, 1);
            return planar(type == Imf::UINT ? converted.data() : reinterpret_cast<const float*>(bytes.data()), size, 1);
        }
        void convert() {
            if (type != Imf::UINT) return;
            const auto* from = reinterpret_cast<const std::uint32_t*>(bytes.data());
            converted.assign(from, from + bytes.size() / sizeof(std::uint32_t));
        }
    };

    static std::size_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }
    static Imath::Box2i box(rectangle r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

    channel& add(const std::string& name, Imf::PixelType type) {
        header_.channels().insert(name.c_str(), Imf::Channel(type));
        channels_.push_back({name, type, std::vector<std::byte>(bytes_of(type) * size().pixels()), {}});
        return channels_.back();
    }
    void retype(channel& c, Imf::PixelType type) {
        c.type = type;
        c.converted.clear();
        header_.channels().insert(c.name.c_str(), Imf::Channel(type));
    }
    Imf::Slice slice(const channel& c) const {
        const std::size_t pixel = bytes_of(c.type);
        return Imf::Slice::Make(c.type, c.bytes.data(), header_.dataWindow(), pixel, pixel * size().width);
    }

    Imf::Header header_;
    std::vector<channel> channels_;
};

/// Reads all flat parts, scanline or tiled (the largest level), into one image over the union of their data windows;
/// pixels that a part does not have are 0.  A channel of a later part gets the name of its part in front if it names no
/// layer itself, or if its name is taken.  Attributes are those of the first flat part.  Deep parts are left out.
inline exr_image read_exr(const std::filesystem::path& path) {
    const std::string file = path.string();
    detail::check_exr(path);
    try {
        Imf::MultiPartInputFile in(file.c_str());
        std::vector<int> flat;
        Imath::Box2i window;
        for (int p = 0; p < in.parts(); ++p) {
            const Imf::Header& header = in.header(p);
            if (header.hasType() && Imf::isDeepData(header.type())) continue;
            flat.push_back(p);
            window.extendBy(header.dataWindow());
        }
        if (flat.empty()) fail(file + ": holds deep pixels only");
        exr_image image(in.header(flat[0]));
        image.header_.dataWindow() = window;
        for (int p : flat) {
            const Imf::Header& header = in.header(p);
            Imf::FrameBuffer pixels;
            const std::size_t first = image.channels_.size();
            std::vector<std::string> own;
            for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
                std::string name = c.name();
                if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
                    fail(file + ": channel " + name + " is subsampled, which is not supported");
                const bool names_layer = name.find('.') != std::string::npos;
                if (header.hasName() && (image.header_.channels().findChannel(name) || (p != flat[0] && !names_layer)))
                    name = header.name() + "." + name;
                image.add(name, c.channel().type);
                own.emplace_back(c.name());
            }
            for (std::size_t i = 0; i < own.size(); ++i)
                pixels.insert(own[i].c_str(), image.slice(image.channels_[first + i]));
            Imf::InputPart part(in, p);
            part.setFrameBuffer(pixels);
            part.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
        }
        for (auto& channel : image.channels_) channel.convert();
        return image;
    } catch (const invalid_input&) {
        throw;
    } catch (const std::exception& e) {
        detail::fail_to_read(file, e.what());
    }
}

/// Writes one scanline part with the compression of the image's header.  The file appears whole or not at all.
inline void write_exr(const std::filesystem::path& path, const exr_image& image) {
    atomic_file file(path);
    try {
        detail::exr_stream stream(file, path.string());
        Imf::OutputFile out(stream, image.header());
        Imf::FrameBuffer pixels;
        for (const auto& channel : image.channels_) pixels.insert(channel.name.c_str(), image.slice(channel));
        out.setFrameBuffer(pixels);
        out.writePixels(image.size().height);
    } catch (const invalid_input&) {
        throw;
    } catch (const std::exception& e) {
        fail("cannot write " + path.string() + ": " + detail::one_line(e.what()));
    }
    file.commit();
}

}  // namespace winnow::io
