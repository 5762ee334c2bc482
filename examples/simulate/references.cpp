// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "references.hpp"

#include <OpenEXR/ImfStringAttribute.h>

#include <cstdio>
#include <support/progress.hpp>

#include "output.hpp"

namespace simulator {

namespace {

using namespace winnow;

constexpr const char* key_name = "winnow:fingerprint";
constexpr std::uint64_t first_seed = 1'000'001;  // no render has it by chance

/// What a reference depends on.
std::string key_of(const entry& scene, const job& j) {
    const bool stratified = j.settings.pattern == simulate::pattern::stratified;
    return std::to_string(scene.fingerprint()) + " " + to_string(j.size) + " " + std::to_string(j.settings.samples) +
           " frame " + std::to_string(j.frame) + (stratified ? "" : " independent");
}

bool is_there(const std::filesystem::path& file, const std::string& key) {
    if (!std::filesystem::exists(file)) return false;
    const io::exr_image known = io::read_exr(file);
    const auto* attribute = known.header().findTypedAttribute<Imf::StringAttribute>(key_name);
    return attribute && attribute->value() == key;
}

/// Means alone: a reference needs no variance.
bool is_mean(const std::string& plane) { return plane.find('.') == std::string::npos; }

void make(const entry& scene, job j, const std::filesystem::path& folder, bool shown,
          simulate::render_progress& progress) {
    const std::string key = key_of(scene, j);
    for (int i = 0; i < 2 && !progress.cancel; ++i) {
        const std::filesystem::path file = folder / (scene.name() + "_" + std::to_string(i + 1) + ".exr");
        if (is_there(file, key)) {
            std::printf("%s: there already\n", file.c_str());
            continue;
        }
        check_memory(scene, j);
        j.settings.seed = first_seed + static_cast<std::uint64_t>(i);
        const double all = static_cast<double>(j.size.pixels()) * j.settings.samples;
        progress.done = 0;
        const result r = [&] {
            const programs::progress_line line(shown, scene.name(),
                                               [&progress, all] { return static_cast<double>(progress.done) / all; });
            return scene.render(j, progress);
        }();
        if (progress.cancel) return;
        io::exr_image image = as_exr(scene, j, r, is_mean);
        image.set_attribute(key_name, key);
        io::write_exr(file, image);
        std::printf("%s: %.1f s, %.0f ns a sample on each of %d threads, %lld bad samples of %.0f\n", file.c_str(),
                    r.seconds, 1e9 * r.seconds * j.threads / all, j.threads, static_cast<long long>(r.rejected), all);
        std::fflush(stdout);
    }
}

}  // namespace

void make_references(const options& o, simulate::render_progress& progress) {
    const std::filesystem::path folder = o.folder;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder)) fail("cannot make the folder " + o.folder);
    job j = o.what;
    if (!o.sampled) j.settings.samples = 768;
    if (!o.scene.empty()) return make(find_scene(o.scene), j, folder, o.progress, progress);
    for (const auto& scene : scenes())
        if (!progress.cancel) make(*scene, j, folder, o.progress, progress);
}

}  // namespace simulator
