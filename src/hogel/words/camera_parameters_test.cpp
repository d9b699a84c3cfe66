// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "hogel/error.h"
#include "hogel/requests.h"

namespace hogel {
namespace {

std::string parameter_of_error(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.parameter();
    }
    return "none";
}

TEST(CameraParameters, the_middle_of_the_picture_is_on_the_line_to_the_gaze) {
    CameraParameters parameters;
    parameters.eye = {0.02, -0.03, 0.3};
    parameters.gaze = {0.004, 0.001, -0.05};
    const Camera camera = parameters.cameras(0.02, 0.01).front();
    const Vec3 seen{camera.picture.center_x, camera.picture.center_y, 0};
    const Vec3 away = cross(seen - parameters.eye, parameters.gaze - parameters.eye);
    EXPECT_LT(length(away), 1e-15);
    EXPECT_EQ(camera.picture.width, defaults.resolution);
    EXPECT_NEAR(camera.picture.size_x(), 0.02, 1e-15);
    EXPECT_NEAR(camera.picture.size_y(), 0.01, 1e-15);
}

TEST(CameraParameters, frames_are_evenly_spaced) {
    CameraParameters parameters;
    parameters.frames = 5;
    parameters.last_eye = Vec3{0.04, 0, 0.2};
    parameters.last_focus = -0.01;
    const std::vector<Camera> cameras = parameters.cameras(0.01, 0.01);
    ASSERT_EQ(cameras.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        const double part = static_cast<double>(i) / 4;
        EXPECT_NEAR(cameras[i].eye.x, part * 0.04, 1e-15);
        EXPECT_NEAR(cameras[i].eye.z, defaults.eye_distance + part * (0.2 - defaults.eye_distance), 1e-15);
        EXPECT_NEAR(cameras[i].focus_depth, -0.01 * part, 1e-15);
    }
}

TEST(CameraParameters, the_pupil_is_that_of_the_f_number) {
    CameraParameters parameters;
    Parameters table;
    parameters.declare(table);
    table.look_up("f-number")->read({"8"}, "f-number");
    table.look_up("focal-length")->read({"40mm"}, "focal-length");
    EXPECT_NEAR(parameters.cameras(0.01, 0.01).front().pupil, 0.005, 1e-15);
    EXPECT_FALSE(table.look_up("pupil")->acts());
    EXPECT_TRUE(table.look_up("focal-length")->acts());
}

TEST(CameraParameters, errors_name_the_parameter) {
    const auto refused = [](const std::function<void(CameraParameters&)>& change) {
        CameraParameters parameters;
        change(parameters);
        return parameter_of_error([&] { parameters.cameras(0.01, 0.01); });
    };
    EXPECT_EQ(refused([](CameraParameters&) {}), "none");
    EXPECT_EQ(refused([](CameraParameters& camera) { camera.eye.z = 0; }), "eye");
    EXPECT_EQ(refused([](CameraParameters& camera) { camera.gaze.z = 1; }), "gaze");
    EXPECT_EQ(refused([](CameraParameters& camera) { camera.focus_tilt.down = 2; }), "focus_tilt");
    EXPECT_EQ(refused([](CameraParameters& camera) { camera.angle_of_view = 3.2; }), "angle_of_view");
    EXPECT_EQ(refused([](CameraParameters& camera) { camera.resolution = {1 << 20, 1 << 20}; }), "resolution");
    EXPECT_EQ(refused([](CameraParameters& camera) { camera.last_focus = 0.01; }), "to_eye, to_focus");
}

TEST(WaveCameraParameters, names_of_the_library_are_those_of_the_same_model) {
    for (const auto& [name, source] :
         {std::pair("hogel-spectra", BandSource::hogel_spectra), std::pair("eye", BandSource::hogel_spectra),
          std::pair("samples", BandSource::samples), std::pair("narrow", BandSource::samples),
          std::pair("auto", BandSource::automatic)})
        EXPECT_EQ(std::get<BandCamera>(WaveCameraParameters{.camera = name}.model()).source, source) << name;
    const WaveCameraParameters full{.camera = "plane-waves", .film_distance = 0.02};
    EXPECT_EQ(std::get<PlaneWaveCamera>(full.model()).film_distance, 0.02);
    EXPECT_TRUE(std::holds_alternative<SpeckleFreeCamera>(WaveCameraParameters{.looks = "expected"}.model()));
    EXPECT_EQ((WaveCameraParameters{.speckle = "none"}.number_of_looks()), 1);
    EXPECT_TRUE(std::holds_alternative<SpeckleFreeCamera>(WaveCameraParameters{.speckle = "none"}.model()));
}

// Options that exclude each other, for every source of light.
TEST(WaveCameraParameters, errors_name_the_parameter) {
    using enum PhotographSource;
    const auto refused = [](WaveCameraParameters parameters, PhotographSource source) {
        return parameter_of_error([&] { parameters.resolve(source); });
    };
    for (const PhotographSource source : {rays, hogels, samples}) {
        EXPECT_EQ(refused({}, source), "none");
        EXPECT_EQ(refused({.looks = "some"}, source), "looks");
        EXPECT_EQ(refused({.looks = "expected", .diffuser = "vertical"}, source), "speckle");
        EXPECT_EQ(refused({.film_distance = 0.02}, source), "film_distance");
        EXPECT_EQ(refused({.camera = "samples", .preview = true}, source), source == rays ? "camera" : "preview");
        EXPECT_EQ(refused({.camera = "full", .diffuser = "vertical"}, source), source == rays ? "camera" : "diffuser");
        EXPECT_EQ(refused({.camera = "hogel-spectra"}, source), source == hogels ? "none" : "camera");
        EXPECT_EQ(refused({.looks = "expected"}, source), source == hogels ? "none" : "speckle");
        EXPECT_EQ(refused({.preview = true}, source), source == hogels ? "none" : "preview");
    }
}

}  // namespace
}  // namespace hogel
