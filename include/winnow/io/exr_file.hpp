// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What reading and writing OpenEXR files of any kind has in common: the checks before, the words of failures, and
/// output through an atomic_file.
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <winnow/io/atomic_file.hpp>

namespace winnow::io::detail {

/// OpenEXR refuses an empty data window in words that do not say so; this finds it in the raw header.
inline bool declares_no_pixels(const std::string& file) {
    std::string head(4096, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    static constexpr char key[] = "dataWindow\0box2i";
    const std::size_t at = head.find(std::string(key, sizeof key));
    std::int32_t window[4];
    if (at == std::string::npos || at + sizeof key + 4 + sizeof window > head.size()) return false;
    std::memcpy(window, head.data() + at + sizeof key + 4, sizeof window);
    return window[2] < window[0] || window[3] < window[1];
}

inline std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// Fails where there is no file that OpenEXR could read.
inline void check_exr(const std::filesystem::path& path) {
    const std::string file = path.string();
    std::error_code error;
    if (!std::filesystem::exists(path, error)) fail(file + ": no such file");
    if (std::filesystem::is_directory(path, error)) fail(file + ": is a folder, not an EXR file");
    if (!std::ifstream(file, std::ios::binary)) fail(file + ": cannot be opened");
    if (!Imf::isOpenExrFile(file.c_str())) fail(file + ": not an EXR file");
}

/// Tells in our words what OpenEXR says about a file.
[[noreturn]] inline void fail_to_read(const std::string& file, const std::string& reason) {
    if (declares_no_pixels(file)) fail(file + ": the image is 0x0, there are no pixels");
    fail(file + ": damaged or truncated (" + one_line(reason) + ")");
}

/// An atomic_file as OpenEXR wants it.
class exr_stream : public Imf::OStream {
public:
    exr_stream(atomic_file& file, const std::string& name) : OStream(name.c_str()), file_(file) {}
    void write(const char bytes[], int count) override { file_.write(bytes, static_cast<std::size_t>(count)); }
    std::uint64_t tellp() override { return file_.position(); }
    void seekp(std::uint64_t position) override { file_.seek(position); }

private:
    atomic_file& file_;
};

}  // namespace winnow::io::detail
