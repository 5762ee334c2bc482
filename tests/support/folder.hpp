// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A folder of its own for a test, and a disk that is full.
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <support/catch.hpp>
#include <winnow/core/error.hpp>

namespace winnow::test {

/// Removed with all that is in it at the end.
class folder {
public:
    folder() {
        std::string name = (std::filesystem::temp_directory_path() / "winnow-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    folder(const folder&) = delete;
    folder& operator=(const folder&) = delete;
    ~folder() { std::filesystem::remove_all(path_); }

    std::filesystem::path operator/(const std::string& file) const { return path_ / file; }
    std::string name(const std::string& file) const { return (path_ / file).string(); }
    void write(const std::string& file, const std::string& bytes) const {
        std::ofstream(path_ / file, std::ios::binary) << bytes;
    }
    std::string read(const std::string& file) const {
        std::ifstream in(path_ / file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// How many files there are.
    int files() const { return static_cast<int>(std::distance(std::filesystem::directory_iterator(path_), {})); }

private:
    std::filesystem::path path_;
};

/// f() while no file can grow beyond so many bytes: as on a disk that is nearly full.
template <class F>
auto with_files_of_at_most(rlim_t bytes, const F& f) {
    rlimit before;
    ::getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{bytes, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    auto result = f();
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    return result;
}

/// What invalid_input says, or nothing where f() runs through.
template <class F>
std::string message_of(const F& f) {
    try {
        f();
    } catch (const invalid_input& e) {
        return e.what();
    }
    return "";
}

}  // namespace winnow::test
