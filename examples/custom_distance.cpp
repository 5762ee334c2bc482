// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
/// \file
/// A distance of one's own, over a buffer of one's own: pixels count as alike where they belong to the same object.
#include <cstdio>
#include <winnow/executor/openmp.hpp>
#include <winnow/winnow.hpp>

namespace mine {

using namespace winnow;

/// A buffer that winnow has never heard of: the number of the object at the first hit.
WINNOW_GUIDE(object, 1);

/// Squared difference of object numbers: 0 within an object, at least 1 across two.
struct other_object {
    using role = role::distance;
    using reads = planes<object_t>;

    template <class Pair>
    WINNOW_HD auto operator()(const Pair& pq) const {
        return math::square(pq.p(object) - pq.q(object));
    }
};
static_assert(distance_policy<other_object>);

}  // namespace mine

using namespace winnow;

int main() {
    const extent size{64, 48};
    image<> rgb(size, 3), objects(size), result(size, 3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            objects.at(x, y) = x < 30 ? 1.0f : 2.0f;
            for (int c = 0; c < 3; ++c) rgb.at(x, y, c) = objects.at(x, y) + ((x + y) % 2 ? 0.3f : -0.3f);
        }

    // It runs on every executor, lanes included, and combines with every other part.
    const filter within_object{gaussian(spatial, 3.0f) * cutoff(mine::other_object{}, 0.5f)};
    within_object(frame{color = rgb.view(), mine::object = objects.view()}, result, executor::openmp{});

    std::printf("left of the edge %.3f (1 without noise), right of it %.3f (2)\n", result.at(29, 24),
                result.at(30, 24));
    return result.at(29, 24) < 1.1f && result.at(30, 24) > 1.9f ? 0 : 1;
}
