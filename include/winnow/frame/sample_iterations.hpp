// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Adaptive sampling in several iterations: what each of them may spend, and where.
#include <winnow/frame/sample_counts.hpp>

namespace winnow {

/// A budget in equal shares, sampled one after the other: the first uniformly, the others in proportion to the density
/// that a filter of all samples so far asks for, whatever a pixel has had.
///     sample_counts had(plan.size);
///     for (int k = 0; k < plan.iterations; ++k) {
///         const sample_counts more = plan.counts(k, density);
///         render(world, film, {.first = had, .count = more}, settings, pool);
///         had += more;
///         // filter film.develop(), and find the next density
///     }
struct sample_iterations {
    extent size{};
    std::int64_t budget = 0;  ///< samples of all pixels in all iterations
    int iterations = 4;
    int cap =
        0;  ///< the most that a pixel gets in one iteration, against outliers; 0: the budget per pixel, rounded up

    /// Samples of iteration k; they differ by at most one, and their sum is the budget.
    std::int64_t share(int k) const {
        check(k);
        return before(k + 1) - before(k);
    }

    /// The samples that each pixel gets in iteration k, share(k) in all.  The density is not looked at in iteration 0.
    /// Throws invalid_input where the first iteration would leave a pixel with fewer than two samples, from which no
    /// filter learns a variance.
    sample_counts counts(int k, const source& density = {}) const {
        check(k);
        if (k > 0 && density.size != size)
            fail("the density is " + to_string(density.size) + ", the iterations are for " + to_string(size));
        const std::int64_t per_pixel = (budget + size.pixels() - 1) / size.pixels();
        // The golden ratio spreads the phases: where the density stays, other pixels are rounded up each time.
        const double turns = 0.5 + 0.6180339887498949 * k;
        const sample_budget now{
            .total = share(k),
            .cap = cap != 0 ? cap : static_cast<int>(std::min<std::int64_t>(per_pixel, sample_budget{}.cap)),
            .phase = turns - std::floor(turns)};
        const image<float> uniform(k == 0 ? size : extent{});
        return counts_from_density(k == 0 ? source(uniform.view()) : density, now);
    }

private:
    /// Samples of all iterations before k: the budget times k / iterations, rounded down.
    std::int64_t before(int k) const { return budget / iterations * k + budget % iterations * k / iterations; }
    void check(int k) const {
        if (size.width < 1 || size.height < 1) fail("iterations for " + to_string(size) + " have no pixels");
        if (iterations < 1) fail(std::to_string(iterations) + " iterations: there must be at least one");
        if (k < 0 || k >= iterations)
            fail("there is no iteration " + std::to_string(k) + " of " + std::to_string(iterations));
        if (iterations > 1 && before(1) / 2 < size.pixels())
            fail("a budget of " + std::to_string(budget) + " samples in " + std::to_string(iterations) +
                 " iterations begins with fewer than two in each of " + std::to_string(size.pixels()) + " pixels");
    }
};

}  // namespace winnow
