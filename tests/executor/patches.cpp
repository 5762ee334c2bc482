// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/executor/patches.hpp>
#include "executor/agreement.hpp"

using namespace winnow;
using namespace winnow::test;

TEST_CASE("patches worked out ahead agree with the definition for every patch radius and border") {
    for (const border rule : all_borders)
        for (const int f : {0, 1, 2, 3, 5}) {
            const filter_numbers n{.radius = 2, .patch_radius = f, .border = rule};
            check_agreement({21, 14}, n, {{executor_kind::simd}},
                            {nlm(n), rdfc_candidate(n), opaque_patch(n), patch_of_patch(n), mean_of_weights(n),
                             two_patches(n), product_with_cutoff(n)});
        }
}

TEST_CASE("patches larger than the image agree with the definition") {
    for (const border rule : all_borders) {
        const filter_numbers n{.radius = 3, .patch_radius = 5, .border = rule};
        for (const extent size : {extent{1, 1}, extent{4, 3}, extent{1, 17}, extent{19, 2}})
            check_agreement(size, n, {{executor_kind::simd}},
                            {nlm(n), two_patches(n), three_candidates(n), patch_of_patch(n)});
    }
}

TEST_CASE("the bits of a patch do not depend on which other patches share its distance") {
    const extent size{37, 19};
    const buffers in = make_buffers(size);
    struct way {
        executor_kind kind;
        int patch_radius;
    };
    // The last two evaluate patches pixel by pixel: small ones suffice.
    const way ways[] = {{executor_kind::simd, 0},
                        {executor_kind::simd, 1},
                        {executor_kind::simd, 3},
                        {executor_kind::serial, 1},
                        {executor_kind::serial_double, 1}};
    for (const way& w : ways)
        for (const border rule : all_borders) {
            const filter_numbers n{.radius = 2, .patch_radius = w.patch_radius, .border = rule};
            const auto check = [&](const any_filter& together, const std::vector<any_filter>& parts) {
                const auto all = together.images(in.layers(), size, {w.kind});
                REQUIRE(all.size() == parts.size());
                for (std::size_t i = 0; i < parts.size(); ++i) {
                    CAPTURE(together.name, parts[i].name, static_cast<int>(w.kind), static_cast<int>(rule),
                            n.patch_radius);
                    const image<> alone = parts[i].images(in.layers(), size, {w.kind})[0];
                    // Compilers are free to fuse a * b + c of scalars in one place and not in another.
                    if (w.kind == executor_kind::simd) CHECK(other_bits(all[i], alone) == "");
                    else CHECK(beyond(1e-6 * largest_magnitude(in.half_a), all[i], alone) == "");
                }
            };
            check(three_candidates(n), parts_of_three_candidates(n));
            check(unlike_candidates(n), parts_of_unlike_candidates(n));
        }
}
