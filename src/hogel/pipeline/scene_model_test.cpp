// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <fstream>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::pipeline {
namespace {

using namespace hogel::literals;

class SceneModels : public ::testing::Test {
  protected:
    SceneModels() {
        std::string name = std::filesystem::temp_directory_path() / "hogel_model_XXXXXX";
        folder_ = mkdtemp(name.data());
        request_.grid = {40, 40, 0.1_mm, 16, 16, field_of_view(16_deg)};
        holograms_.channels = rgb(633_nm, 532_nm, 460_nm);
    }
    ~SceneModels() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
    LightFieldRequest request_;
    HologramRequest holograms_;
};

// After any rotation, resizing, lighting and shift, a scene equals one loaded with these settings.
TEST_F(SceneModels, place_scenes_as_they_are_loaded) {
    const std::filesystem::path file = folder_ / "one.ply";
    std::ofstream(file) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                           "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n0.3 0.2 1\n3 0 1 2\n3 0 3 1\n";
    for (const std::string& name : {std::string("sphere"), std::string("two-planes"), file.string()}) {
        SceneModel model(name);
        EXPECT_EQ(model.is_file(), name == file.string());
        LightFieldRequest request = request_;
        const auto check = [&](const char* what) {
            EXPECT_EQ(checksum(model.placed(request)), checksum(load_scene(name, request))) << name << what;
        };
        check("first");
        request.pose.rotation = {0.2, 0.7, -0.1};
        check("turned");
        request.grid.pitch *= 3;
        check("larger");
        request.front = 0.8;
        request.pose.shift = {0, 0, 1_mm};
        check("nearer");
        request.pose.lights = {Light{}};
        check("lit");
        request = request_;
        check("first again");
    }
    EXPECT_THROW(SceneModel("spher"), Error);
    EXPECT_THROW(SceneModel((folder_ / "none.ply").string()), Error);
}

const Advice* find(const std::vector<Advice>& all, const std::string& parameter) {
    for (const Advice& advice : all)
        if (advice.parameter == parameter) return &advice;
    return nullptr;
}

// The advised value is enough, and a little less is not; require_holograms() agrees about pitches.
TEST_F(SceneModels, advise_pitches_that_do_not_alias) {
    const std::vector<LightFieldGrid> faces = request_.grids();
    for (const double pitch : {1_um, 1.6_um, 1.7_um, 2_um, 5_um, 30_um, 150_um, 300_um}) {
        holograms_.pitch = pitch;
        const Bounds flat{{-1e-3, -1e-3, 0}, {1e-3, 1e-3, 0}};
        const std::vector<Advice> all = advise(flat, request_, holograms_);
        const Advice* advice = find(all, "pitch");
        const auto possible = [&] {
            try {
                require_holograms(faces, holograms_);
                return true;
            } catch (const Error&) {
                return false;
            }
        };
        EXPECT_EQ(advice == nullptr, possible()) << pitch;
        EXPECT_EQ(diffracting_pitch(faces, holograms_), advice == nullptr ? pitch : advice->enough);
        if (advice == nullptr) continue;
        EXPECT_TRUE(advice->refused);
        holograms_.pitch = advice->enough;
        EXPECT_TRUE(possible()) << pitch;
        holograms_.pitch = 100_um / (std::round(100_um / advice->enough) - 1);
        EXPECT_FALSE(possible()) << pitch;
    }
}

// Rays of neighbouring directions are one hogel apart at the depth of the advice.
TEST_F(SceneModels, advise_directions_and_hogels_for_the_depth) {
    for (const double depth : {0.5_mm, 3_mm, 20_mm, 60_mm}) {
        const Bounds scene{{-1e-3, -1e-3, -depth}, {1e-3, 1e-3, 0.2 * depth}};
        LightFieldRequest request = request_;
        const std::vector<Advice> all = advise(scene, request, holograms_);
        const Advice* directions = find(all, "directions");
        EXPECT_EQ(directions == nullptr, depth * request.grid.step_u() <= request.grid.pitch) << depth;
        if (directions != nullptr) {
            EXPECT_FALSE(directions->refused);
            const auto enough = static_cast<std::size_t>(directions->enough);
            request.grid.directions_u = request.grid.directions_v = enough;
            EXPECT_EQ(find(advise(scene, request, holograms_), "directions"), nullptr) << depth;
            request.grid.directions_u = request.grid.directions_v = enough - 1;
            EXPECT_NE(find(advise(scene, request, holograms_), "directions"), nullptr) << depth;
        }
        const Advice* hogels = find(all, "hogels");
        EXPECT_EQ(hogels == nullptr, 633_nm * depth <= request.grid.pitch * request.grid.pitch) << depth;
        if (hogels != nullptr) {
            const double width = request.grid.width();
            for (const std::size_t more : {0, 1}) {
                request.grid.hogels_s = request.grid.hogels_t = static_cast<std::size_t>(hogels->enough) + more;
                request.grid.pitch = width / static_cast<double>(request.grid.hogels_s);
                EXPECT_EQ(find(advise(scene, request, holograms_), "hogels") == nullptr, more == 0) << depth;
            }
        }
    }
}

}  // namespace
}  // namespace hogel::pipeline
