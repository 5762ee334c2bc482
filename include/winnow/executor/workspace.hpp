// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Memory that outlives a run, so that the next run allocates nothing.
#include <atomic>
#include <cstddef>
#include <memory>
#include <new>
#include <winnow/executor/sweep.hpp>
#include <winnow/frame/output.hpp>
#include <winnow/frame/variance.hpp>

namespace winnow {

/// How far a run is; may be read, and `cancel` set, from any thread while the run goes on.
struct progress {
    std::atomic<int> done = 0;            ///< tiles of the current pass that are finished
    std::atomic<int> total = 0;           ///< tiles of the current pass
    std::atomic<float> from = 0, to = 1;  ///< which part of the whole run the current pass is
    float first = 0, last = 1;            ///< which part of it the current filter is, of several in a row
    std::atomic<bool> cancel =
        false;  ///< set it, and the run stops before its next tile; the output is then incomplete

    /// The share of the run that is finished, 0 to 1.
    float share() const {
        const int all = total;
        const float of_pass = all ? static_cast<float>(done) / static_cast<float>(all) : 0.0f;
        return from + (to - from) * of_pass;
    }
    /// What follows is this part of what the current filter does.
    void enter(float from_share, float to_share) {
        done = 0;
        from = first + (last - first) * from_share;
        to = first + (last - first) * to_share;
    }
    /// The filter that follows is this part of the whole run.
    void enter_filter(float from_share, float to_share) {
        first = from_share;
        last = to_share;
        enter(0, 1);
    }
};

/// Bytes aligned to a cache line, grown on demand and never shrunk.
class scratch_memory {
public:
    static constexpr std::size_t alignment = 64;

    std::byte* reserve(std::size_t bytes) {
        if (bytes > size_) {
            memory_.reset();
            size_ = 0;
            memory_.reset(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{alignment})));
            size_ = bytes;
        }
        return memory_.get();
    }
    std::size_t size() const { return size_; }

private:
    struct release {
        void operator()(std::byte* p) const { ::operator delete (p, std::align_val_t{alignment}); }
    };
    std::unique_ptr<std::byte, release> memory_;
    std::size_t size_ = 0;
};

/// All memory that a run needs beside the caller's images.  One run at a time.
struct workspace {
    scratch_memory tiles;   ///< the executor's
    scratch_memory images;  ///< whole images between the passes of a filter with several
    scratch_memory clean;   ///< whole images that a pre-filter hands to the filter behind it
    sweep_buffers buffers;
    std::vector<output> passes;  ///< where the passes of a filter with several write
    variance_memory noise;
    winnow::progress progress;

    /// The i-th of `passes`, anew.
    output& pass(const target& mean, std::size_t i = 0) {
        if (passes.size() <= i) passes.resize(i + 1);
        return passes[i].reset(mean);
    }
};

}  // namespace winnow
