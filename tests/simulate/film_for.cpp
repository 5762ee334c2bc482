// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/film_for.hpp>

#include <support/catch.hpp>
#include <winnow/paper/joint_bilateral.hpp>
#include <winnow/paper/rdfc_2013.hpp>
#include <winnow/simulate/scene.hpp>

using namespace winnow;
using namespace winnow::simulate;

namespace {

/// A filter that uses visibility where a scene has lights, and caustics where it has photons.
struct curious {
    using reads = planes<color_t, normal_t>;
    using optional = planes<visibility_t, variance_of<visibility_t>, caustic_t>;
};

using dark = scene<effects<effect::texture>, quad>;
using lit = scene<effects<effect::area_light>, quad>;
using shiny = scene<effects<effect::area_light, effect::mirror, effect::caustics>, quad>;

template <class Scene, class... Filters>
using kept = typename simulate::film_for<Scene, Filters...>::planes;

}  // namespace

// The film of a simulation is that of its filters,
static_assert(
    std::is_same_v<simulate::film_for<dark, paper::joint_bilateral>, winnow::film_for<paper::joint_bilateral>>);
static_assert(std::is_same_v<kept<lit, paper::joint_bilateral>, planes<color_t, albedo_t, normal_t>>);
// with the optional planes that the scene can give, and no others.
static_assert(std::is_same_v<kept<dark, curious>, planes<color_t, normal_t>>);
static_assert(std::is_same_v<kept<lit, curious>, planes<color_t, normal_t, visibility_t, variance_of<visibility_t>>>);
static_assert(std::is_same_v<kept<shiny, curious>,
                             planes<color_t, normal_t, visibility_t, variance_of<visibility_t>, caustic_t>>);
// Of several filters, the union.
static_assert(kept<lit, curious, paper::rdfc_candidate>::count ==
              joined<kept<lit, curious>, kept<lit, paper::rdfc_candidate>>::count);

TEST_CASE(
    "the complete film of a scene has every guide with its variance and its halves, and the spread of positions") {
    using complete = complete_film<lit::effects>;
    CHECK(complete::planes::count == 4 * lit::effects::gives::count + 6);
    CHECK(complete::inputs::count == lit::effects::gives::count);
}
