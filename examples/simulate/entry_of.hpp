// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The entry of a scene type.
#include <support/progress.hpp>
#include <winnow/executor/pool.hpp>
#include <winnow/frame/samples.hpp>
#include <winnow/io/channel_names.hpp>
#include <winnow/io/deep_exr.hpp>
#include <winnow/simulate/film_for.hpp>

#include "entry.hpp"

namespace simulator {

template <class Scene>
class entry_of : public entry {
    using shows = typename Scene::shows;
    using film = winnow::simulate::complete_film<shows>;
    using gives = typename shows::gives;
    using samples = winnow::samples<gives>;

public:
    std::string name() const override { return Scene::name(); }
    std::string summary() const override { return Scene::summary(); }
    std::vector<std::string> effects() const override { return shows::names(); }
    std::vector<std::string> guides() const override {
        std::vector<std::string> all;
        gives::for_each([&]<class G>(G) { all.push_back(G::name()); });
        return all;
    }
    int camera_numbers() const override { return shows::camera_numbers; }
    int vertex_numbers() const override { return shows::vertex_numbers; }
    std::size_t sample_bytes() const override { return sizeof(winnow::sample<gives>); }
    std::size_t bytes(extent size, int kept_samples) const override {
        const std::size_t images = sizeof(float) * film::planes::count * static_cast<std::size_t>(size.pixels());
        return film::bytes(size) + images + (kept_samples ? samples::bytes(size, kept_samples) : 0);
    }

    std::uint64_t fingerprint() const override {
        film small({40, 30});
        winnow::simulate::render(winnow::simulate::world(Scene::make()), small, {.samples = 4},
                                 winnow::executor::fresh_threads{1});
        std::uint64_t hash = 0;
        for (const std::byte b : small.raw())
            hash = winnow::simulate::detail::mixed(hash, static_cast<std::uint64_t>(b));
        return hash;
    }

    result render(const job& j, winnow::simulate::render_progress& progress) const override {
        const winnow::simulate::world world(Scene::make(), j.frame);
        film f(j.size);
        const programs::stopwatch since;
        const winnow::executor::fresh_threads pool{j.threads};
        if (j.deep.empty()) {
            winnow::simulate::render(world, f, j.settings, pool, progress);
        } else {
            samples all(j.size, j.settings.samples);
            both_of kept{f, all};
            winnow::simulate::render(world, kept, j.settings, pool, progress);
            if (!progress.cancel) winnow::io::write_deep_exr(j.deep, all);
        }
        result r;
        r.seconds = since.seconds();
        r.rejected = f.rejected();
        if (progress.cancel) return r;
        f.develop().for_each([&]<class G>(G g, const image<float>& values) {
            r.planes.push_back({G::name(), winnow::io::channel_names(g), values});
        });
        return r;
    }

private:
    /// A film that keeps all samples as well.
    struct both_of {
        using inputs = gives;
        film& first;
        samples& second;

        extent size() const { return first.size(); }
        void add(int x, int y, int i, const winnow::sample<gives>& s) {
            first.add(x, y, i, s);
            second.set(x, y, i, s);
        }
    };
};

}  // namespace simulator
