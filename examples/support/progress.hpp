// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Time that has passed, and a line that says how far a run is.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>

namespace programs {

class stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Says on stderr, until it is destroyed, how far a run is and how long it will still take; share() is in [0, 1].
class progress_line {
public:
    template <class Share>
    progress_line(bool shown, const std::string& who, const Share& share) {
        if (!shown) return;
        watcher_ = std::jthread([who, share](const std::stop_token& stop) {
            const stopwatch since;
            while (!stop.stop_requested()) {
                const double done = share();
                std::fprintf(stderr, "\r%s: %ld %%", who.c_str(), std::lround(100 * done));
                if (done > 0.01) std::fprintf(stderr, ", %.0f s left   ", since.seconds() * (1 - done) / done);
                std::fflush(stderr);
                std::this_thread::sleep_for(std::chrono::milliseconds(50));
            }
            std::fprintf(stderr, "\r%*s\r%s: %ld %%\n", static_cast<int>(who.size()) + 30, "", who.c_str(),
                         std::lround(100 * share()));
        });
    }

private:
    std::jthread watcher_;
};

}  // namespace programs
