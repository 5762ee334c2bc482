// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The entry of a scene type.
#include <optional>
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
    using complete = winnow::simulate::complete_film<shows>;
    using gives = typename shows::gives;
    using samples_of_all = winnow::samples<gives>;

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
        const std::size_t images = sizeof(float) * complete::planes::count * static_cast<std::size_t>(size.pixels());
        const std::size_t film = complete::bytes(size) + images;
        return film + photon_bytes(size) + (kept_samples ? samples_of_all::bytes(size, kept_samples) : 0);
    }

    std::uint64_t fingerprint() const override {
        job j;
        j.size = {40, 30};
        j.settings.samples = 4;
        winnow::simulate::render_progress unwatched;
        std::uint64_t hash = 0;
        const auto add = [&](std::byte b) {
            hash = winnow::simulate::detail::mixed(hash, static_cast<std::uint64_t>(b));
        };
        const kept all = rendered(j, unwatched);
        for (const std::byte b : all.film.raw()) add(b);
        return hash;
    }

    result render(const job& j, winnow::simulate::render_progress& progress) const override {
        const programs::stopwatch since;
        const kept all = rendered(j, progress);
        const double seconds = since.seconds();
        if (progress.cancel) return {{}, all.film.rejected(), seconds};
        if (all.samples) winnow::io::write_deep_exr(j.deep, *all.samples, attributes_of(*this, j));
        return developed(all.film, seconds);
    }
    std::unique_ptr<growing_render> begin(const job& j) const override { return std::make_unique<growing>(j); }

private:
    static result developed(const complete& film, double seconds) {
        result r{{}, film.rejected(), seconds};
        const auto images = film.develop();
        gives::for_each([&]<class G>(G g) {
            using namespace winnow;
            r.keep(G::name(), io::channel_letters(g),
                   {&images[g], &images[variance(g)], &images[first_half(g)], &images[second_half(g)]});
        });
        const auto spread = winnow::covariance(winnow::rest_position);
        r.planes.push_back({spread.name(), winnow::io::channel_names(spread), images[spread]});
        return r;
    }

    /// Two maps at a time; while one is made, its photons are there twice.
    static std::size_t photon_bytes(extent size) {
        if constexpr (!shows::template has<winnow::simulate::effect::caustics>) return 0;
        const double photons = Scene::make().photons_per_sample * static_cast<double>(size.pixels()) *
                               (winnow::simulate::detail::samples_per_photon_map / 2);
        return static_cast<std::size_t>(3 * photons * sizeof(winnow::simulate::photon));
    }

    /// A film, and all samples if they are asked for.
    struct kept {
        using inputs = gives;
        complete film;
        std::optional<samples_of_all> samples;

        extent size() const { return film.size(); }
        void add(int x, int y, int i, const winnow::sample<gives>& s) {
            film.add(x, y, i, s);
            if (samples) samples->set(x, y, i, s);
        }
    };

    static kept rendered(const job& j, winnow::simulate::render_progress& progress) {
        kept all{complete(j.size), {}};
        if (!j.deep.empty()) all.samples.emplace(j.size, j.settings.samples);
        winnow::simulate::render(winnow::simulate::world(Scene::make(), j.frame), all, j.settings,
                                 winnow::executor::fresh_threads{j.threads}, progress);
        return all;
    }

    class growing : public growing_render {
    public:
        explicit growing(const job& j)
            : settings_(j.settings),
              pool_{j.threads},
              world_(Scene::make(), j.frame),
              all_{complete(j.size), {}},
              had_(j.size) {}

        void add(const winnow::sample_counts& more, winnow::simulate::render_progress& progress) override {
            const programs::stopwatch since;
            winnow::simulate::render(world_, all_, {.first = had_, .count = more}, settings_, pool_, progress);
            had_ += more;
            seconds_ += since.seconds();
        }
        result developed() const override { return entry_of::developed(all_.film, seconds_); }

    private:
        winnow::simulate::render_settings settings_;
        winnow::executor::fresh_threads pool_;
        decltype(winnow::simulate::world(Scene::make(), 0)) world_;
        kept all_;
        winnow::sample_counts had_;
        double seconds_ = 0;
    };
};

}  // namespace simulator
