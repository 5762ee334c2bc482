// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Staged planes that a test fills by hand: what a policy looks at, without an executor.
#include <support/scattered.hpp>
#include <vector>
#include <winnow/frame/pixel_pair.hpp>

namespace winnow::test {

/// How a neighbourhood is filled: every value lies in (0, its scale].
struct scales {
    float guide = 1;
    float variance = 0.05f;
    float gradient = 0.05f;
};

/// What the laws are tried on: usual noise, none, bright, dark, and noise that explains every difference.
inline constexpr scales all_scales[] = {
    {1, 0.05f, 0.05f}, {1, 0, 0}, {1e4f, 1e3f, 1e3f}, {1e-4f, 1e-12f, 1e-12f}, {1, 1e6f, 0}};

template <class Planes>
class neighbourhood {
public:
    /// Everything is covered and 0.
    explicit neighbourhood(extent size) : size_(size), floats_(size.width * size.height * (1 + Planes::count) + 64) {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) covered(x, y) = 1;
    }
    /// Everything is covered and differs.
    neighbourhood(extent size, scales s) : neighbourhood(size) {
        std::uint32_t number = 1;
        Planes::for_each([&]<class G>(G g) {
            const bool variance = G::name().ends_with(".variance"), gradient = G::name().ends_with(".gradient");
            for (int c = 0; c < G::channels; ++c)
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        at(g, x, y, c) = scattered(number++) * (variance   ? s.variance
                                                                : gradient ? s.gradient
                                                                           : s.guide);
        });
    }

    extent size() const { return size_; }
    float& covered(int x, int y) { return plane(0, x, y); }
    template <class G>
    float& at(G, int x, int y, int c = 0) {
        return plane(1 + slot_of<G>(Planes{}) + c, x, y);
    }

    template <class Real = float>
    pixel_pair<Real, Planes> pair(int x, int y, int dx, int dy) {
        const std::ptrdiff_t row = size_.width * (1 + Planes::count);
        return {&plane(0, x, y), &plane(0, x + dx, y + dy), {size_.width, row}, dx, dy};
    }

private:
    float& plane(int index, int x, int y) { return floats_[(y * (1 + Planes::count) + index) * size_.width + x]; }

    extent size_;
    std::vector<float> floats_;
};

/// Calls f(neighbourhood, x, y, dx, dy) for pairs of pixels that differ in every way that a policy can see.
template <class Policy, class F>
void for_pairs(const Policy&, const F& f) {
    for (const scales& s : all_scales) {
        neighbourhood<typename Policy::reads> around({32, 9}, s);
        for (int x = 4; x < 12; x += 3)
            for (int dy = -2; dy <= 2; ++dy)
                for (int dx = -2; dx <= 2; ++dx) f(around, x, 4, dx, dy);
    }
}

}  // namespace winnow::test
