// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "hogel/error.h"

namespace hogel::image {
namespace {

std::string refusal(void (*change)(Camera&)) {
    Camera camera;
    camera.picture = {64, 48, 1e-4, 1e-4, 0, 0};
    change(camera);
    try {
        validate(camera);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.what();
    }
    return "";
}

TEST(Camera, validate_names_what_is_wrong) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal([](Camera&) {}), "");
    EXPECT_EQ(refusal([](Camera& c) { c.focus_depth = -0.29; }), "");
    EXPECT_NE(refusal([](Camera& c) { c.eye.z = 0; }).find("eye"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.eye.x = nan; }).find("eye"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.focus_depth = -0.3; }).find("focus"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.focus_depth = nan; }).find("focus"), std::string::npos);
    EXPECT_EQ(refusal([](Camera& c) { c.focus_slope_x = 50; }), "");
    EXPECT_NE(refusal([](Camera& c) { c.focus_slope_x = 100; }).find("slopes"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.focus_slope_y = nan; }).find("slopes"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.pupil = 0; }).find("pupil"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.picture.height = 0; }).find("64x0"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.picture.width = c.picture.height = std::size_t{1} << 32; }).find("addressed"),
              std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.picture.pitch_y = -1; }).find("pitch"), std::string::npos);
    EXPECT_NE(refusal([](Camera& c) { c.picture.center_y = nan; }).find("centre"), std::string::npos);
}

// The point in focus is on the line of sight and on the plane in focus.
TEST(Camera, focus_ratio_gives_the_point_in_focus) {
    Camera camera;
    camera.eye = {0.02, -0.01, 0.25};
    camera.focus_depth = 4e-3;
    EXPECT_DOUBLE_EQ(focus_ratio(camera, 1e-3, 7e-3), 1 + 4e-3 / 0.25);
    camera.focus_slope_x = 0.3;
    camera.focus_slope_y = -0.2;
    for (const Vec3 h : {Vec3{0, 0, 0}, Vec3{5e-3, -2e-3, 0}, Vec3{-8e-3, 1e-3, 0}}) {
        const Vec3 p = camera.eye + focus_ratio(camera, h.x, h.y) * (h - camera.eye);
        EXPECT_NEAR(-p.z, 4e-3 + 0.3 * p.x - 0.2 * p.y, 1e-12);
    }
}

}  // namespace
}  // namespace hogel::image
