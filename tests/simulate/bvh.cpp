// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/simulate/bvh.hpp>

#include <random>
#include <support/catch.hpp>

using namespace winnow::simulate;

namespace {

/// Spheres of many sizes, some of them in the same place.
std::vector<ellipsoid> spheres(int count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-5, 5), size(0.01, 0.6);
    std::vector<ellipsoid> all;
    for (int i = 0; i < count; ++i)
        all.push_back(i % 7 == 6 ? all.back() : sphere({u(random), u(random), u(random)}, size(random)));
    return all;
}

double nearest(const std::vector<ellipsoid>& all, const ray& r) {
    double t = infinity;
    for (const ellipsoid& s : all) t = std::min(t, s.intersect(r, 0));
    return t;
}

double nearest(const bvh& tree, const std::vector<ellipsoid>& all, const ray& r, int* tests = nullptr) {
    double nearest = infinity;
    tree.walk(r, infinity, [&](int i, double far) {
        if (tests) ++*tests;
        const double t = all[i].intersect(r, 0);
        if (t < far) nearest = far = t;
        return far;
    });
    return nearest;
}

bvh tree_of(const std::vector<ellipsoid>& all) {
    std::vector<bounds> boxes;
    for (const ellipsoid& s : all) boxes.push_back(s.bounding());
    return bvh(boxes);
}

}  // namespace

TEST_CASE("the tree finds what a search through all finds, with far fewer tests") {
    for (const int count : {0, 1, 2, 5, 1000}) {
        const auto all = spheres(count);
        const bvh tree = tree_of(all);
        std::mt19937 random(2);
        std::uniform_real_distribution<double> u(-6, 6);
        int hits = 0, tests = 0;
        for (int i = 0; i < 2000; ++i) {
            vec3 d(u(random), u(random), u(random));
            if (i % 5 == 0) d = vec3(i % 2 ? 1 : -1, 0, 0);  // along an axis: slabs divide by zero
            const ray r{{u(random), u(random), u(random)}, d.normalized()};
            const double expected = nearest(all, r);
            CHECK(nearest(tree, all, r, &tests) == expected);
            hits += expected < infinity;
        }
        if (count == 1000) {
            CHECK(hits > 500);
            CHECK(tests < 2000 * count / 20);
        }
    }
}

TEST_CASE("flat boxes are met, from within their plane as well") {
    const quad floor({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    const bvh tree({floor.bounding()});
    int asked = 0;
    const auto count = [&](int, double far) { return ++asked, far; };
    tree.walk({{0, 0, 1}, {0, 0, -1}}, infinity, count);
    CHECK(asked == 1);
    tree.walk({{-3, 0, 0}, {1, 0, 0}}, infinity, count);
    CHECK(asked == 2);
    tree.walk({{-3, 0, 1}, {1, 0, 0}}, infinity, count);
    CHECK(asked == 2);
    tree.walk({{0, 0, 1}, {0, 0, -1}}, 0.5, count);  // ends before it
    CHECK(asked == 2);
}

TEST_CASE("a thousand boxes in one place make a tree") {
    const bvh tree(std::vector<bounds>(1000, sphere({0, 0, 0}, 1).bounding()));
    int asked = 0;
    tree.walk({{0, 0, 3}, {0, 0, -1}}, infinity, [&](int, double far) { return ++asked, far; });
    CHECK(asked == 1000);
}
