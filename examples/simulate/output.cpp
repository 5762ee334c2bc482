// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "output.hpp"

#include <unistd.h>

namespace simulator {

const image<float>* find_plane(const result& r, const std::string& guide) {
    for (const plane& p : r.planes)
        if (p.guide == guide) return &p.values;
    return nullptr;
}

const image<float>& plane_of(const result& r, const std::string& guide) {
    const image<float>* const found = find_plane(r, guide);
    if (!found) winnow::fail("the scene does not give " + guide);
    return *found;
}

void check_memory(const entry& scene, const job& j) {
    const std::size_t needed = scene.bytes(j.size, j.deep.empty() ? 0 : j.settings.samples);
    const auto there =
        static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    if (needed > there)
        winnow::fail(scene.name() + " at " + to_string(j.size) + " takes " + std::to_string(needed) +
                     " bytes of memory, this machine has " + std::to_string(there));
}

}  // namespace simulator
