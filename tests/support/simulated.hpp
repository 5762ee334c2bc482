// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Renders of small scenes, and what their films say with its standard error.
#include <support/statistics.hpp>
#include <winnow/executor/pool.hpp>
#include <winnow/simulate/film_for.hpp>
#include <winnow/simulate/render.hpp>

namespace winnow::test {

/// A film of the planes of the list.
template <class Planes, class World>
film<Planes> rendered(const World& w, extent size, const simulate::render_settings& settings, int threads = 2) {
    film<Planes> f(size);
    simulate::render(w, f, settings, executor::fresh_threads{threads});
    return f;
}

/// One value of every sample of a render: value(sample, x, y).
template <class Planes, class World, class Value>
statistic of_samples(const World& w, extent size, const simulate::render_settings& settings, const Value& value) {
    const simulate::path_tracer<World, Planes> trace(w, size, settings.direct);
    statistic all;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < settings.samples; ++i) {
                const simulate::random_numbers<typename World::effects> random(
                    simulate::sample_numbers(settings.pattern, settings.seed, w.frame(), x, y, i));
                value(all, trace(x, y, random), x, y);
            }
    return all;
}
/// The mean of a channel, over all samples of all pixels.
template <class Planes, class World, class G>
statistic mean_of(const World& w, extent size, const simulate::render_settings& settings, G g, int channel = 0) {
    return of_samples<Planes>(w, size, settings,
                              [&](statistic& all, const auto& s, int, int) { all.add(s.at(g, channel)); });
}

}  // namespace winnow::test
