// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Renders a world into a film, on all threads, with the same bits whatever their number.
#include <atomic>
#include <cstdint>
#include <limits>
#include <winnow/core/error.hpp>
#include <winnow/frame/sample.hpp>
#include <winnow/frame/sample_counts.hpp>
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

/// Which samples of each pixel: numbers first(x, y) to first(x, y) + count(x, y) - 1.  A render that goes on where each
/// pixel has stopped, with the counts so far as `first`, continues its sequence and keeps its halves in balance.
struct pixel_samples {
    const sample_counts& first;
    const sample_counts& count;
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

/// Sample numbers first .. last - 1.
struct sample_range {
    int first, last;

    sample_range within(const sample_range& r) const {
        const int from = std::max(first, r.first);
        return {from, std::max(from, std::min(last, r.last))};
    }
};

/// Those of each pixel, or the same of all.
struct sample_ranges {
    sample_range all;                     ///< from the lowest to the highest number that any pixel has
    const pixel_samples* each = nullptr;  ///< null: all

    sample_range operator()(int x, int y) const {
        if (!each) return all;
        const int from = each->first.at(x, y);
        return {from, from + each->count.at(x, y)};
    }
    /// The lowest number from `from` on that a pixel has; all.last where there is none.
    int next(int from, extent size) const {
        if (!each) return std::min(from, all.last);
        int lowest = all.last;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                if (const sample_range own = (*this)(x, y); own.first < own.last && from < own.last)
                    lowest = std::min(lowest, std::max(from, own.first));
        return lowest;
    }
};

inline sample_ranges ranges_of(const render_settings& s) {
    if (s.samples < 1) fail(std::to_string(s.samples) + " samples per pixel: there must be at least one");
    if (s.first < 0 || s.first > std::numeric_limits<int>::max() - s.samples)
        fail("the first sample is number " + std::to_string(s.first) + ", of " + std::to_string(s.samples));
    return {{s.first, s.first + s.samples}};
}
inline sample_ranges ranges_of(const pixel_samples& samples, extent size) {
    for (const sample_counts* map : {&samples.first, &samples.count})
        if (map->size() != size)
            fail("the map of sample counts is " + to_string(map->size()) + ", the film is " + to_string(size));
    sample_range all{std::numeric_limits<int>::max(), 0};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int first = samples.first.at(x, y), count = samples.count.at(x, y);
            if (first < 0 || count < 0 || first > std::numeric_limits<int>::max() - count)
                fail("pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is to get " + std::to_string(count) +
                     " samples from number " + std::to_string(first) + " on");
            if (count > 0) all = {std::min(all.first, first), std::max(all.last, first + count)};
        }
    return {all, &samples};
}

template <class World, class Film, class Pool>
void render_ranges(const World& w, Film& film, const sample_ranges& samples, const render_settings& settings,
                   const Pool& pool, render_progress& progress) {
    if (settings.tile < 1) fail("tiles of " + std::to_string(settings.tile) + " pixels: there must be at least one");
    const extent size = film.size();
    const path_tracer<World, typename Film::inputs> trace(w, size, settings.direct);
    constexpr bool photons = World::effects::template has<effect::caustics>;
    const std::int64_t side = settings.tile, columns = (size.width + side - 1) / side;
    const std::int64_t tiles = columns * ((size.height + side - 1) / side);
    for (sample_range batch = samples.all; batch.first < samples.all.last;
         batch.first = samples.next(batch.last, size)) {
        batch.last = samples.all.last;
        std::array<photon_map, photons ? 2 : 0> maps;
        if constexpr (photons) {
            if (batch.last - batch.first > samples_per_photon_map) batch.last = batch.first + samples_per_photon_map;
            for (int half = 0; half < 2; ++half)
                maps[half] = shoot_photons(w, settings, size, batch.first, batch.last - batch.first, half, pool,
                                           progress.cancel);
        }
        std::atomic<std::int64_t> next = 0;
        pool.run(pool.size(), [&](int) {
            for (std::int64_t tile; (tile = next++) < tiles && !progress.cancel;) {
                const int x0 = static_cast<int>(tile % columns * side), y0 = static_cast<int>(tile / columns * side);
                const int x1 = static_cast<int>(std::min<std::int64_t>(x0 + side, size.width));
                const int y1 = static_cast<int>(std::min<std::int64_t>(y0 + side, size.height));
                std::int64_t done = 0;
                for (int y = y0; y < y1; ++y)
                    for (int x = x0; x < x1; ++x) {
                        const sample_range own = samples(x, y).within(batch);
                        for (int i = own.first; i < own.last; ++i) {
                            const random_numbers<typename World::effects> random(
                                sample_numbers(settings.pattern, settings.seed, w.frame(), x, y, i));
                            const photon_map* map = nullptr;
                            if constexpr (photons) map = &maps[static_cast<std::size_t>(i % 2)];
                            film.add(x, y, i, trace(x, y, random, map));
                        }
                        done += own.last - own.first;
                    }
                progress.done += done;
            }
        });
        if (progress.cancel) return;
    }
}

}  // namespace detail

/// Adds samples to every pixel of the film; a film of guides that the scene cannot give does not compile.  The pool is
/// anything with size() and run(count, task); see executor/pool.hpp.
template <class World, class Film, class Pool>
requires gives_all<typename World::effects::gives, typename Film::inputs>
void render(const World& w, Film& film, const render_settings& settings, const Pool& pool, render_progress& progress) {
    detail::render_ranges(w, film, detail::ranges_of(settings), settings, pool, progress);
}
template <class World, class Film, class Pool>
void render(const World& w, Film& film, const render_settings& settings, const Pool& pool) {
    render_progress unwatched;
    render(w, film, settings, pool, unwatched);
}

/// The same with other samples in each pixel; `samples` and `first` of the settings are not looked at:
///     render(w, film, {.first = had, .count = more}, settings, pool);  had += more;
/// Counts that are all the same give the bits of the render above.  Photons are shot anew for each 16 numbers, from the
/// lowest on that a pixel asks for, and as many as if every pixel asked for all of them: a pixel alone sees as many
/// photons for each of its samples as in company.
template <class World, class Film, class Pool>
requires gives_all<typename World::effects::gives, typename Film::inputs>
void render(const World& w, Film& film, const pixel_samples& samples, const render_settings& settings, const Pool& pool,
            render_progress& progress) {
    detail::render_ranges(w, film, detail::ranges_of(samples, film.size()), settings, pool, progress);
}
template <class World, class Film, class Pool>
void render(const World& w, Film& film, const pixel_samples& samples, const render_settings& settings,
            const Pool& pool) {
    render_progress unwatched;
    render(w, film, samples, settings, pool, unwatched);
}

}  // namespace winnow::simulate
