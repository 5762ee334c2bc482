// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Deep OpenEXR files: every sample of every pixel.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <winnow/core/error.hpp>
#include <winnow/frame/samples.hpp>
#include <winnow/io/channel_names.hpp>
#include <winnow/io/exr_file.hpp>

namespace winnow::io {

/// The samples of a file, with as many in each pixel as it happens to have; all channels as float.
struct deep_image {
    std::string file;
    rectangle window;                        ///< where the pixels are, in the coordinates of the file
    std::vector<std::string> names;          ///< of the channels
    std::vector<std::uint64_t> first;        ///< of pixel i: its samples are first[i] ... first[i + 1] - 1
    std::vector<std::vector<float>> values;  ///< of each channel, pixel by pixel

    /// How many samples a pixel has; (0, 0) is the upper left corner of the window.
    std::size_t count(int x, int y) const { return first[index(x, y) + 1] - first[index(x, y)]; }
    /// What channel number c of `names` has there.
    std::span<const float> at(std::size_t c, int x, int y) const {
        return {values[c].data() + first[index(x, y)], count(x, y)};
    }
    /// The number of a channel; -1 where there is none.
    int find(const std::string& name) const {
        const auto found = std::find(names.begin(), names.end(), name);
        return found == names.end() ? -1 : static_cast<int>(found - names.begin());
    }

private:
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * window.size().width + x; }
};

namespace detail {

/// What OpenEXR calls the base of a row that begins at x0: where pixel 0 would be.
template <class T>
char* base_of_row(std::vector<T>& row, int x0) {
    return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(row.data()) -
                                   std::intptr_t{x0} * std::intptr_t{sizeof(T)});
}

/// One row of a channel, for OpenEXR: a pointer for each pixel.
inline Imf::DeepSlice deep_row(std::vector<char*>& row, int x0, std::size_t sample_bytes) {
    return Imf::DeepSlice(Imf::FLOAT, base_of_row(row, x0), sizeof(char*), 0, sample_bytes);
}

}  // namespace detail

/// Writes all samples, with the channels of `channel_names`, losslessly compressed, and text attributes of the
/// caller's.  The file appears whole or not at all.
template <class Planes>
void write_deep_exr(const std::filesystem::path& path, const samples<Planes>& all,
                    const std::vector<std::pair<std::string, std::string>>& attributes = {}) {
    atomic_file file(path);
    try {
        const extent size = all.size();
        Imf::Header header(size.width, size.height);
        header.setType(Imf::DEEPSCANLINE);
        header.compression() = Imf::ZIPS_COMPRESSION;
        for (const auto& [name, text] : attributes) header.insert(name.c_str(), Imf::StringAttribute(text));

        std::vector<unsigned> counts(size.width, static_cast<unsigned>(all.per_pixel()));
        Imf::DeepFrameBuffer pixels;
        pixels.insertSampleCountSlice(Imf::Slice(Imf::UINT, detail::base_of_row(counts, 0), sizeof(unsigned), 0));
        const std::vector<std::string> names = channel_names(Planes{});
        std::vector<std::vector<char*>> rows(names.size(), std::vector<char*>(size.width));
        for (std::size_t c = 0; c < names.size(); ++c) {
            header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
            pixels.insert(names[c], detail::deep_row(rows[c], 0, sizeof(sample<Planes>)));
        }

        detail::exr_stream stream(file, path.string());
        Imf::DeepScanLineOutputFile out(stream, header);
        out.setFrameBuffer(pixels);
        for (int y = 0; y < size.height; ++y) {
            for (std::size_t c = 0; c < names.size(); ++c)
                for (int x = 0; x < size.width; ++x)  // OpenEXR does not write to what it is given to write to the file
                    rows[c][x] = reinterpret_cast<char*>(const_cast<float*>(&all.at(x, y, 0).values[c]));
            out.writePixels(1);
        }
    } catch (const invalid_input&) {
        throw;
    } catch (const std::exception& e) {
        fail("cannot write " + path.string() + ": " + detail::one_line(e.what()));
    }
    file.commit();
}

/// Reads the first deep part of a file: any number of samples in each pixel, any type of channel.
inline deep_image read_deep_exr(const std::filesystem::path& path) {
    const std::string file = path.string();
    detail::check_exr(path);
    try {
        Imf::MultiPartInputFile in(file.c_str());
        int deep = 0;
        while (deep < in.parts() && !(in.header(deep).hasType() && Imf::isDeepData(in.header(deep).type()))) ++deep;
        if (deep == in.parts()) fail(file + ": holds no deep pixels");
        const Imf::Header& header = in.header(deep);
        if (header.type() != Imf::DEEPSCANLINE) fail(file + ": holds deep tiles; only deep scan lines are supported");

        const auto& box = header.dataWindow();
        deep_image image{file, {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}, {}, {}, {}};
        const extent size = image.window.size();
        std::size_t sample_bytes = 0;
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
            image.names.emplace_back(c.name());
            sample_bytes += c.channel().type == Imf::HALF ? 2 : 4;
        }
        // No compression of OpenEXR makes things smaller than that: a damaged file may say anything.
        const std::uint64_t most = 1100 * std::filesystem::file_size(path);
        const std::uint64_t pixels = static_cast<std::uint64_t>(size.pixels());
        if (pixels > most / sizeof(unsigned))
            fail(file + ": damaged or truncated (more pixels than the file can hold)");

        std::vector<unsigned> counts(pixels);
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, counts.data(), box));
        Imf::DeepScanLineInputPart part(in, deep);
        part.setFrameBuffer(buffer);
        part.readPixelSampleCounts(box.min.y, box.max.y);
        image.first.assign(pixels + 1, 0);
        std::partial_sum(counts.begin(), counts.end(), image.first.begin() + 1,
                         [](std::uint64_t sum, unsigned n) { return sum + n; });
        const std::uint64_t total = image.first.back();
        if (sample_bytes > 0 && total > most / sample_bytes)
            fail(file + ": damaged or truncated (more samples than the file can hold)");

        image.values.assign(image.names.size(), std::vector<float>(total));
        std::vector<std::vector<char*>> rows(image.names.size(), std::vector<char*>(size.width));
        for (std::size_t c = 0; c < rows.size(); ++c)
            buffer.insert(image.names[c], detail::deep_row(rows[c], box.min.x, sizeof(float)));
        part.setFrameBuffer(buffer);
        part.readPixelSampleCounts(box.min.y, box.max.y);
        for (int y = 0; y < size.height; ++y) {
            for (std::size_t c = 0; c < rows.size(); ++c)
                for (int x = 0; x < size.width; ++x)
                    rows[c][x] = reinterpret_cast<char*>(image.values[c].data() +
                                                         image.first[static_cast<std::size_t>(y) * size.width + x]);
            part.readPixels(box.min.y + y);
        }
        return image;
    } catch (const invalid_input&) {
        throw;
    } catch (const std::exception& e) {
        detail::fail_to_read(file, e.what());
    }
}

/// The samples of the guides in a list, from a file that has as many in each pixel.  Fails where a channel is missing,
/// or where the numbers of samples vary.
template <class Planes>
samples<Planes> samples_of(const deep_image& image) {
    std::vector<std::size_t> channels;
    for (const std::string& name : channel_names(Planes{})) {
        const int c = image.find(name);
        if (c < 0) fail(image.file + ": there is no channel " + name);
        channels.push_back(static_cast<std::size_t>(c));
    }
    const extent size = image.window.size();
    const std::size_t n = image.count(0, 0);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (image.count(x, y) != n)
                fail(image.file + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") has " +
                     std::to_string(image.count(x, y)) + " samples, pixel (0, 0) has " + std::to_string(n));
    samples<Planes> all(size, static_cast<int>(n));
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < all.per_pixel(); ++i) {
                sample<Planes> s;
                for (std::size_t c = 0; c < channels.size(); ++c) s.values[c] = image.at(channels[c], x, y)[i];
                all.set(x, y, i, s);
            }
    return all;
}

}  // namespace winnow::io
