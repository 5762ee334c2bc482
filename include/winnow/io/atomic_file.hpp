// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A file that appears whole or not at all.
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <utility>
#include <winnow/core/error.hpp>

namespace winnow::io {

/// Writes beside its target and takes the target's place in `commit`.  Without a commit nothing is left behind, and
/// what was there before stays.  Every failure, a full disk as well, is told by `fail` with the name of the target.
class atomic_file {
public:
    /// Fails at once where nothing can be written, so that it can be asked before the work is done.
    explicit atomic_file(const std::filesystem::path& target) : shown_(target.string()) {
        std::error_code error;
        target_ = std::filesystem::weakly_canonical(target, error);  // a link stays a link
        if (error || target_.empty()) target_ = target;
        // A device or a folder would be replaced, not written to.
        if (std::filesystem::exists(target_, error) && !std::filesystem::is_regular_file(target_, error))
            fail("cannot write " + shown_ + ": not a regular file");
        std::random_device random;
        for (int attempt = 0; attempt < 16 && !file_; ++attempt) {
            temporary_ = target_;
            temporary_ += ".part" + std::to_string(random());
            file_ = std::fopen(temporary_.c_str(), "wbx");
            if (!file_ && errno != EEXIST) break;
        }
        if (!file_) fail("cannot write " + shown_ + ": " + std::strerror(errno));
    }
    atomic_file(const atomic_file&) = delete;
    atomic_file& operator=(const atomic_file&) = delete;
    ~atomic_file() {
        if (file_) std::fclose(file_);
        if (!committed_) std::remove(temporary_.c_str());
    }

    void write(const void* bytes, std::size_t count) {
        if (std::fwrite(bytes, 1, count, file_) != count) broken(errno);
    }
    std::uint64_t position() {
        const auto at = std::ftell(file_);
        if (at < 0) broken(errno);
        return static_cast<std::uint64_t>(at);
    }
    void seek(std::uint64_t position) {
        if (std::fseek(file_, static_cast<long>(position), SEEK_SET) != 0) broken(errno);
    }

    /// Gives the file its name.  Fails if any write before failed, even where its exception was swallowed.
    void commit() {
        const bool flushed = std::fflush(file_) == 0;
        if (!flushed && !error_) error_ = errno;
        const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
        if (!closed && !error_) error_ = errno;
        if (error_) broken(error_);
        std::error_code error;
        std::filesystem::rename(temporary_, target_, error);
        if (error) broken(error.value());
        committed_ = true;
    }

private:
    [[noreturn]] void broken(int error) {
        error_ = error ? error : EIO;
        fail("cannot write " + shown_ + ": " + std::strerror(error_));
    }

    std::string shown_;
    std::filesystem::path target_, temporary_;
    std::FILE* file_ = nullptr;
    int error_ = 0;
    bool committed_ = false;
};

}  // namespace winnow::io
