// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/erase.hpp>
#include <support/filters.hpp>
#include <winnow/distance/combine.hpp>
#include <winnow/distance/noise_normalized.hpp>
#include <winnow/distance/patch.hpp>
#include <winnow/distance/spatial.hpp>
#include <winnow/distance/squared_difference.hpp>
#include <winnow/weight/combine.hpp>
#include <winnow/weight/cutoff.hpp>
#include <winnow/weight/exponential.hpp>
#include <winnow/weight/gaussian.hpp>
#include <winnow/weight/patch_mean.hpp>
#include <winnow/window/a_trous.hpp>
#include <winnow/window/disk.hpp>

namespace winnow::test {

namespace {
/// A user's distance into which no executor can look.
struct hidden_patch {
    using role = role::distance;
    using reads = planes<color_t, variance_of<color_t>>;

    distance::patch<distance::noise_normalized<color_t>> inner;

    template <class Real, class Planes>
    WINNOW_HD Real operator()(const pixel_pair<Real, Planes>& pq) const {
        return inner(pq) + math::square(pq.p(color, 1) - pq.q(color, 1));
    }
    int reach() const { return inner.reach(); }
};

auto patch_with(filter_numbers n) {
    return filter{exponential(patch(noise_normalized(color), {.radius = n.patch_radius})),
                  window::square{.radius = n.radius}}
        .with(n.border);
}
auto nested(filter_numbers n) {
    return filter{exponential(patch(patch(noise_normalized(color), {.radius = 2}), {.radius = n.patch_radius})),
                  window::square{.radius = n.radius}}
        .with(n.border);
}
auto without_patch(filter_numbers n) {
    return filter{gaussian(l2(albedo), 0.2f), window::square{.radius = n.radius}}.with(n.border);
}
auto wide_patch(filter_numbers n) {
    return filter{exponential(patch(noise_normalized(color), {.radius = n.patch_radius + 2})),
                  window::square{.radius = n.radius}}
        .with(n.border);
}
auto opaque_in_patch(filter_numbers n) {
    return filter{
        exponential(patch(hidden_patch{patch_with({.patch_radius = 1}).weight.distance}, {.radius = n.patch_radius})),
        window::square{.radius = n.radius}}
        .with(n.border);
}
}  // namespace

any_filter with_holes(filter_numbers n) {
    return erase("holes", filter{gaussian(spatial, 3) * patch_with(n).weight * gaussian(l2(albedo), 0.3f),
                                 window::a_trous{.level = 1, .radius = n.radius}}
                              .with(n.border));
}

any_filter opaque_patch(filter_numbers n) {
    return erase(
        "opaque patch",
        filter{exponential(hidden_patch{patch_with(n).weight.distance}), window::square{.radius = n.radius}}.with(
            n.border));
}

any_filter mean_of_weights(filter_numbers n) {
    return erase("mean of weights", filter{patch_mean(exponential(patch(noise_normalized(color), {.radius = 1})),
                                                      {.radius = n.patch_radius}) *
                                               gaussian(l2(albedo), 0.3f),
                                           window::square{.radius = n.radius}}
                                        .with(n.border));
}

any_filter patch_of_patch(filter_numbers n) { return erase("patch of patch", nested(n)); }

any_filter unlike_candidates(filter_numbers n) {
    return erase("unlike candidates", candidates{without_patch(n), wide_patch(n), nested(n), opaque_in_patch(n)});
}

std::vector<any_filter> parts_of_unlike_candidates(filter_numbers n) {
    return {erase("without patch", without_patch(n)), erase("wide patch", wide_patch(n)), erase("nested", nested(n)),
            erase("opaque in patch", opaque_in_patch(n))};
}

any_filter product_with_cutoff(filter_numbers n) {
    // No squared difference of depths is near the limit: they are multiples of 2^-16.
    return erase("product with cutoff", filter{exponential(patch(noise_normalized(color), {.radius = n.patch_radius})) *
                                                   cutoff(l2(depth), 0.25f + 0x1p-18f) * gaussian(spatial, 2.5f),
                                               window::square{.radius = n.radius}}
                                            .with(n.border));
}

any_filter two_patches(filter_numbers n) {
    return erase("two patches", filter{min(exponential(patch(noise_normalized(color), {.radius = n.patch_radius})),
                                           gaussian(max(patch(l2(albedo), {.radius = 2}), l2(normal)), 0.2f)),
                                       window::disk{.radius = n.radius}}
                                    .with(n.border));
}

std::vector<any_filter> all_filters(filter_numbers n) {
    return {joint_bilateral(n),     bilateral(n),        nlm(n),
            nlm_with_error(n),      nlm_dual_buffer(n),  nlm_as_released(n),
            rdfc_candidate(n),      max_and_sum(n),      disk(n),
            opaque_patch(n),        patch_of_patch(n),   mean_of_weights(n),
            two_patches(n),         three_candidates(n), unlike_candidates(n),
            product_with_cutoff(n), guided(n),           with_holes(n)};
}

std::string to_string(const how& h) {
    const char* names[] = {"serial<double>", "serial", "simd", "openmp", "openmp_over<serial>", "pool"};
    return std::string(names[static_cast<int>(h.kind)]) + ", " + std::to_string(h.threads) + " threads, tile " +
           winnow::to_string(h.tile);
}

}  // namespace winnow::test
