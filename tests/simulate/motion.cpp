// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/motion.hpp>

#include <random>
#include <support/catch.hpp>

using namespace winnow::simulate;

namespace {

using moving = effects<effect::translation, effect::rotation>;
const motion wheel{.velocity = {1, 2, -0.5}, .pivot = {3, 0, 1}, .axis = vec3(1, 1, 0).normalized(), .spin = 2.5};

}  // namespace

TEST_CASE("a quarter turn worked by hand") {
    const motion quarter{.pivot = {1, 0, 0}, .spin = pi / 2};
    CHECK(quarter.carry<moving>({2, 0, 5}, 1).isApprox(vec3(1, 1, 5), 1e-12));
    CHECK(quarter.carry_direction<moving>({1, 0, 0}, 1).isApprox(vec3(0, 1, 0), 1e-12));
    CHECK(motion{.velocity = {2, 0, 0}}.carry<moving>({1, 1, 1}, 0.5).isApprox(vec3(2, 1, 1), 1e-12));
}

TEST_CASE("what is carried and brought back is where it was; the pivot only moves straight on") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-4, 4);
    for (int i = 0; i < 200; ++i) {
        const vec3 p(u(random), u(random), u(random));
        const double t = u(random);
        CHECK((wheel.bring_back<moving>(wheel.carry<moving>(p, t), t) - p).norm() < 1e-12);
        CHECK((wheel.bring_back_direction<moving>(wheel.carry_direction<moving>(p, t), t) - p).norm() < 1e-12);
        CHECK(std::abs((wheel.carry<moving>(p, t) - wheel.carry<moving>(wheel.pivot, t)).norm() -
                       (p - wheel.pivot).norm()) < 1e-12);
        CHECK((wheel.carry<moving>(wheel.pivot, t) - (wheel.pivot + t * wheel.velocity)).norm() < 1e-12);
    }
}

TEST_CASE("what does not move stays where it is, bit by bit, and what is not declared does not happen") {
    const vec3 p(0.1, 0.2, 0.3);
    CHECK(motion{}.carry<moving>(p, 0.7) == p);
    CHECK(motion{}.bring_back<moving>(p, 0.7) == p);
    CHECK(wheel.carry<effects<>>(p, 0.7) == p);
    CHECK(wheel.carry<effects<effect::translation>>(p, 2) == p + 2 * wheel.velocity);
}

TEST_CASE("the swept box holds the object at all times") {
    const bounds rest = bounds{}.grow(vec3(2.5, -0.5, 0.5)).grow(vec3(3.7, 0.5, 1.5));
    const bounds swept = wheel.swept<moving>(rest, 3, 4);
    for (int corner = 0; corner < 8; ++corner)
        for (double t = 3; t <= 4; t += 0.05) {
            const vec3 p(corner & 1 ? rest.low.x() : rest.high.x(), corner & 2 ? rest.low.y() : rest.high.y(),
                         corner & 4 ? rest.low.z() : rest.high.z());
            const vec3 at = wheel.carry<moving>(p, t);
            CHECK(((at - swept.low).array() >= -1e-12).all());
            CHECK(((swept.high - at).array() >= -1e-12).all());
        }
}
