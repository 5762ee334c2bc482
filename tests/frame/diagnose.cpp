// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include <winnow/frame/diagnose.hpp>

#include <limits>
#include <random>
#include <support/catch.hpp>
#include <winnow/image/image.hpp>

using namespace winnow;

namespace {

const float nan_value = std::numeric_limits<float>::quiet_NaN();
const float infinite = std::numeric_limits<float>::infinity();
constexpr extent size{40, 30};

/// Buffers that nobody can find fault with.
struct sane {
    image<float> rgb{size, 3}, noise{size, 3}, a{size, 3}, b{size, 3}, texture{size, 3}, normals{size, 3};

    sane() {
        std::mt19937 random(3);
        std::normal_distribution<float> gauss;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    a.at(x, y, c) = 2 + 0.2f * gauss(random);
                    b.at(x, y, c) = 2 + 0.2f * gauss(random);
                    rgb.at(x, y, c) = (a.at(x, y, c) + b.at(x, y, c)) / 2;
                    noise.at(x, y, c) = 0.02f;
                    texture.at(x, y, c) = 0.1f + 0.01f * static_cast<float>(x + c);
                }
                normals.at(x, y, x % 3) = x % 2 ? -1.0f : 1.0f;
            }
    }
    diagnosis operator()() const {
        return diagnose(frame{color = rgb.view(), variance(color) = noise.view(), first_half(color) = a.view(),
                              second_half(color) = b.view(), albedo = texture.view(), normal = normals.view()});
    }
    bool warns(const std::string& beginning) const {
        for (const std::string& w : (*this)().warnings)
            if (w.starts_with(beginning)) return true;
        return false;
    }
};

}  // namespace

TEST_CASE("bad pixels are counted by pixel and located in reading order") {
    image<float> v(size, 3);
    v.at(5, 7, 0) = nan_value;
    v.at(5, 7, 2) = nan_value;
    v.at(1, 2, 1) = -infinite;
    for (int x = 10; x < 16; ++x) v.at(x, 4, 1) = -1;
    const layer_diagnosis found = diagnose("noise", v.view(), true);
    CHECK(found.name == "noise");
    CHECK(found.nan.count == 1);
    CHECK(found.nan.first == std::vector<bad_pixels::position>{{5, 7}});
    CHECK(found.inf.count == 1);
    CHECK(found.inf.first == std::vector<bad_pixels::position>{{1, 2}});
    CHECK(found.negative.count == 6);
    CHECK(found.negative.first == std::vector<bad_pixels::position>{{10, 4}, {11, 4}, {12, 4}, {13, 4}});
    CHECK_FALSE(found.clean());
    CHECK(diagnose("colour", v.view()).negative.count == 0);
}

TEST_CASE("a sane frame has clean layers and no warnings, known at compile time or not") {
    const sane s;
    const diagnosis d = s();
    CHECK(d.warnings.empty());
    REQUIRE(d.layers.size() == 6);
    CHECK(d.layers[0].name == "color");
    CHECK(d.layers[1].name == "color.variance");
    for (const auto& layer : d.layers) CHECK(layer.clean());

    named_layers late;
    late.bind("normal", s.normals.view());
    late.bind("color.halfB", s.b.view());
    CHECK(diagnose(late).layers.size() == 2);
    CHECK(diagnose(late).warnings.empty());
}

TEST_CASE("normals encoded to [0, 1] are noticed, normals that only point one way are not") {
    sane s;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c) s.normals.at(x, y, c) = (s.normals.at(x, y, c) + 1) / 2;
    CHECK(s.warns("normal looks encoded"));
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c) s.normals.at(x, y, c) = c == 1 ? 1.0f : 0.0f;
    CHECK_FALSE(s.warns("normal"));
    s.normals = image<float>(size, 3);
    CHECK(s.warns("normal is zero everywhere"));
}

TEST_CASE("emission in the albedo is noticed") {
    sane s;
    s.texture.at(3, 3, 1) = 40;
    CHECK(s.warns("albedo is above 1 in 1 pixels (up to 40"));
}

TEST_CASE("halves that are one image, that are of another image, and a variance of another scale are noticed") {
    sane same;
    same.b = same.a;
    same.rgb = same.a;
    CHECK(same.warns("color: both halves are the same image"));
    sane other;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) other.rgb.at(x, y, 0) += 1;
    CHECK(other.warns("color is not the mean of its halves in 33 %"));
    for (float factor : {0.2f, 8.0f}) {
        sane scaled;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                for (int c = 0; c < 3; ++c) scaled.noise.at(x, y, c) *= factor;
        CHECK(scaled.warns("color.variance is "));
    }
    sane silent;
    silent.noise = image<float>(size, 3);
    CHECK(silent.warns("color.variance is zero everywhere"));
}
