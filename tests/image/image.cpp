// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <support/scattered.hpp>

using namespace winnow;
using namespace winnow::test;

TEST_CASE("an image is zero at first, and every pixel is its own") {
    image<> made({3, 2}, 2);
    CHECK(made.size() == extent{3, 2});
    CHECK(made.channels() == 2);
    for (int i = 0; i < 12; ++i) {
        CHECK(made.at(i % 3, i / 3 % 2, i / 6) == 0);
        made.at(i % 3, i / 3 % 2, i / 6) = static_cast<float>(i);
    }
    for (int i = 0; i < 12; ++i) CHECK((&made.at(0, 0))[i] == static_cast<float>(i));
}

TEST_CASE("a copy of an image has memory of its own") {
    image<> first = pattern({3, 2});
    const image<> copy = first;
    first.at(1, 1) = 9;
    CHECK(copy.at(1, 1) == pattern({3, 2}).at(1, 1));
    CHECK(copy.view().data != first.view().data);
}

TEST_CASE("an image of nothing is allowed") {
    CHECK(image<>({0, 0}, 3).size().pixels() == 0);
    CHECK(image<half>().channels() == 0);
}
