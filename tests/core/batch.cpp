// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <support/catch.hpp>
#include <winnow/core/batch.hpp>
#include <winnow/executor/lanes.hpp>

using namespace winnow;

TEST_CASE("batch_of: a number is a batch of one") {
    CHECK(batch_of<double>::size == 1);
    const float from = 3.5f;
    float to = 0;
    batch_of<double>::store(batch_of<double>::load(&from), &to);
    CHECK(to == 3.5f);
    CHECK(batch_of<float>::largest(-2.0f) == -2.0f);
}

TEST_CASE("batch_of: lanes") {
    constexpr int size = batch_of<lanes>::size;
    REQUIRE(size == lanes::size);
    float from[size], to[size];
    for (int i = 0; i < size; ++i) from[i] = static_cast<float>((i * 5) % size) - 2;
    batch_of<lanes>::store(batch_of<lanes>::load(from), to);
    for (int i = 0; i < size; ++i) CHECK(to[i] == from[i]);
    CHECK(batch_of<lanes>::largest(lanes::load(from)) == static_cast<float>(size) - 3);
}
