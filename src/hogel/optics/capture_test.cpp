// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/capture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::optics {
namespace {

using namespace literals;

Field speckle() {
    Field field({{900, 800, 1_um, 1_um, 0.1_mm, 0}, 633_nm});
    std::mt19937 random(11);
    std::normal_distribution<float> normal;
    for (auto& value : field.samples.elements()) value = {normal(random), normal(random)};
    return field;
}

std::vector<Camera> walk() {
    std::vector<Camera> cameras;
    for (const Vec3 eye : {Vec3{0, 0, 80_mm}, Vec3{9_mm, -4_mm, 80_mm}})
        for (const double focus : {2e-3, 0.0, -1e-3}) {
            Camera& camera = cameras.emplace_back();
            camera.eye = eye;
            camera.pupil = focus == 0 ? 2_mm : 3_mm;
            camera.focus_depth = focus;
            camera.picture = {40, 36, 20_um, 20_um, 0.1_mm, 0};
        }
    return cameras;
}

bool same(const Image& a, const Image& b) { return std::ranges::equal(a.pixels.elements(), b.pixels.elements()); }

// Photographs from captured light are bit for bit those of the hologram.
TEST(Capture, photographs_equal_those_of_the_hologram) {
    const Field field = speckle();
    const std::vector<Camera> cameras = walk();
    const std::vector<Image> direct = photograph(field, cameras);
    const auto check = [&](const PhotographOptions& options) {
        const std::vector<CapturedEye> eyes = capture(field, cameras, options);
        ASSERT_EQ(eyes.size(), 2u);
        for (std::size_t c = 0; c < cameras.size(); ++c) {
            const CapturedEye& eye = eyes[c / 3];
            EXPECT_EQ(eye.eye(), cameras[c].eye);
            EXPECT_TRUE(same(eye.photograph(cameras[c]), direct[c])) << c;
        }
    };
    check({});
    check({.memory = 3 << 20});  // one eye at a time
    const ThreadLimit one(1);
    check({});
}

TEST(Capture, refuses_cameras_beyond_those_captured) {
    const Field field = speckle();
    const std::vector<Camera> cameras = walk();
    const CapturedEye eye = std::move(capture(field, std::span(cameras).first(3)).front());
    const auto refused = [&](auto change) {
        Camera camera = cameras[0];
        eye.photograph(camera);
        change(camera);
        try {
            eye.photograph(camera);
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage;
        }
        return false;
    };
    EXPECT_TRUE(refused([](Camera& camera) { camera.eye.x = 1e-6; }));
    EXPECT_TRUE(refused([](Camera& camera) { camera.pupil = 3.1e-3; }));
    EXPECT_TRUE(refused([](Camera& camera) { camera.focus_depth = 3e-3; }));
    EXPECT_THROW(capture(field, cameras, {.memory = 1000}), Error);
    // A distant focus needs a larger film, whichever camera has it.
    std::vector<Camera> far(2, cameras[0]);
    far[1].focus_depth = -0.95 * far[1].eye.z;
    far[1].pupil = 0.9 * far[0].pupil;
    capture(field, std::span(far).first(1), {.memory = 3 << 20});
    EXPECT_THROW(capture(field, far, {.memory = 3 << 20}), Error);
}

}  // namespace
}  // namespace hogel::optics
