// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Renders a world into a film, on all threads, with the same bits whatever their number.
#include <atomic>
#include <cstdint>
#include <limits>
#include <winnow/core/error.hpp>
#include <winnow/frame/sample.hpp>
#include <winnow/image/extent.hpp>
#include <winnow/simulate/integrator.hpp>

namespace winnow::simulate {

/// What is not the scene's.
struct render_settings {
    int samples = 8;  ///< per pixel
    /// Number of the first sample: parts of a render may be made anywhere, and merged.  Where there are caustics, parts
    /// are the render bit by bit only if they begin at multiples of 16.
    int first = 0;
    std::uint64_t seed = 1;  ///< renders with other seeds are independent
    simulate::pattern pattern = pattern::stratified;
    direct_light direct = direct_light::both;
    int tile = 32;  ///< pixels a side
};

/// How far a render is; may be read, and `cancel` set, from any thread while it goes on.
struct render_progress {
    std::atomic<std::int64_t> done = 0;  ///< samples that are finished
    std::atomic<bool> cancel = false;    ///< set it, and the render stops before its next tile or photons
};

namespace detail {

/// Samples between new photons: the memory that they take is bounded, however long a render is.
inline constexpr int samples_per_photon_map = 16;

template <class World, class Pool>
photon_map shoot_photons(const World& w, const render_settings& s, extent size, int first, int samples, int half,
                         const Pool& pool, const std::atomic<bool>& cancel) {
    constexpr int chunk = 1 << 14;
    const double wanted = w.description().photons_per_sample * static_cast<double>(size.pixels()) * ((samples + 1) / 2);
    const int count = static_cast<int>(std::min(wanted, 1e9));
    const std::uint64_t stream = mixed(mixed(s.seed, 0x70686f746f6e73u), static_cast<std::uint64_t>(first));
    std::vector<std::vector<photon>> found(static_cast<std::size_t>((count + chunk - 1) / chunk));
    std::atomic<int> next = 0;
    pool.run(pool.size(), [&](int) {
        for (int c; (c = next++) < static_cast<int>(found.size()) && !cancel;)
            for (int i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i)
                if (photon p; trace_photon(w, stream, half, i, p)) found[c].push_back(p);
    });
    // In the order of their numbers, whoever found them.
    std::vector<photon> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    // Cells about as large as what a pixel sees of the middle of the world.
    const view seen_by(w.camera_at(w.frame()), size);
    const double distance = std::max((w.centre() - seen_by.eye()).norm(), 0.1 * w.radius());
    const double pixel =
        std::sqrt(seen_by.solid_angle(seen_by.through({size.width / 2.0, size.height / 2.0}).direction));
    return photon_map(std::move(all), count, 2 * pixel * distance);
}

}  // namespace detail

/// Adds samples to every pixel of the film; a film of guides that the scene cannot give does not compile.  The pool is
/// anything with size() and run(count, task); see executor/pool.hpp.
template <class World, class Film, class Pool>
requires gives_all<typename World::effects::gives, typename Film::inputs>
void render(const World& w, Film& film, const render_settings& settings, const Pool& pool, render_progress& progress) {
    if (settings.samples < 1) fail(std::to_string(settings.samples) + " samples per pixel: there must be at least one");
    if (settings.first < 0 || settings.first > std::numeric_limits<int>::max() - settings.samples)
        fail("the first sample is number " + std::to_string(settings.first) + ", of " +
             std::to_string(settings.samples));
    if (settings.tile < 1) fail("tiles of " + std::to_string(settings.tile) + " pixels: there must be at least one");
    const extent size = film.size();
    const path_tracer<World, typename Film::inputs> trace(w, size, settings.direct);
    constexpr bool photons = World::effects::template has<effect::caustics>;
    const int batch = photons ? detail::samples_per_photon_map : settings.samples;
    const std::int64_t side = settings.tile, columns = (size.width + side - 1) / side;
    const std::int64_t tiles = columns * ((size.height + side - 1) / side);
    const int last = settings.first + settings.samples;
    for (int from = settings.first, to; from < last; from = to) {
        to = last - from > batch ? from + batch : last;
        std::array<photon_map, photons ? 2 : 0> maps;
        if constexpr (photons)
            for (int half = 0; half < 2; ++half)
                maps[half] = detail::shoot_photons(w, settings, size, from, to - from, half, pool, progress.cancel);
        std::atomic<std::int64_t> next = 0;
        pool.run(pool.size(), [&](int) {
            for (std::int64_t tile; (tile = next++) < tiles && !progress.cancel;) {
                const int x0 = static_cast<int>(tile % columns * side), y0 = static_cast<int>(tile / columns * side);
                const int x1 = static_cast<int>(std::min<std::int64_t>(x0 + side, size.width));
                const int y1 = static_cast<int>(std::min<std::int64_t>(y0 + side, size.height));
                for (int y = y0; y < y1; ++y)
                    for (int x = x0; x < x1; ++x)
                        for (int i = from; i < to; ++i) {
                            const random_numbers<typename World::effects> random(
                                sample_numbers(settings.pattern, settings.seed, w.frame(), x, y, i));
                            const photon_map* map = nullptr;
                            if constexpr (photons) map = &maps[static_cast<std::size_t>(i % 2)];
                            film.add(x, y, i, trace(x, y, random, map));
                        }
                progress.done += std::int64_t{x1 - x0} * (y1 - y0) * (to - from);
            }
        });
        if (progress.cancel) return;
    }
}
template <class World, class Film, class Pool>
void render(const World& w, Film& film, const render_settings& settings, const Pool& pool) {
    render_progress unwatched;
    render(w, film, settings, pool, unwatched);
}

}  // namespace winnow::simulate
