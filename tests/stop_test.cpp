// SPDX-License-Identifier: Apache-2.0
// A stop ends every function that takes a Progress within a second, wherever in the library it is working.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "hogel/bake.h"
#include "hogel/compress.h"
#include "hogel/core/parallel.h"
#include "hogel/hologram.h"
#include "hogel/pattern.h"
#include "hogel/photograph.h"
#include "hogel/propagate.h"
#include "hogel/ray_photograph.h"
#include "hogel/render/test_renderers.h"
#include "hogel/renderer.h"
#include "hogel/scene_hologram.h"
#include "hogel/scenes.h"
#include "hogel/shading.h"
#include "hogel/units.h"

namespace hogel {
namespace {

using namespace literals;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// Work that takes a minute on all threads.
void work_for_a_minute() {
    core::parallel_for(60000 * thread_count(), [](std::size_t) { std::this_thread::sleep_for(milliseconds(1)); });
}

class SlowLightField final : public LightFieldSource {
  public:
    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    void read(LightFieldTile&) const override { work_for_a_minute(); }

  private:
    LightFieldGrid grid_{8, 8, 64_um, 16, 16, field_of_view(8_deg), 1};
};

class SlowField final : public FieldSource {
  public:
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region&, std::size_t, View<std::complex<float>, 2>) const override { work_for_a_minute(); }

  private:
    FieldGrid grid_{{256, 256, 2_um, 2_um, 0, 0}, 633_nm};
};

Camera camera_of(const Grid& plane) {
    Camera camera;
    camera.pupil = 2_mm;
    camera.picture = {16, 16, plane.size_x() / 16, plane.size_y() / 16, 0, 0};
    return camera;
}

// A ball with so many lamps that shading takes minutes.
Scene lit_ball() {
    Scene scene = make_scene("sphere", 16_mm);
    Light lamp;
    lamp.kind = Light::Kind::point;
    lamp.intensity = {1, 1, 1};
    for (int i = 0; i < 20000; ++i) {
        lamp.position = {std::cos(i), std::sin(i), 1};
        scene.lights.push_back(lamp);
    }
    return scene;
}

struct Verb {
    std::string name;
    std::function<void(const Progress&)> call;
};

const SlowLightField& slow_rays() {
    static const SlowLightField rays;
    return rays;
}

const SlowField& slow_waves() {
    static const SlowField waves;
    return waves;
}

// Verbs that read a light field.
std::vector<Verb> light_field_verbs() {
    static const SlowLightField& rays = slow_rays();
    static const Grid hologram{8, 8, 64_um, 64_um, 0, 0};
    return {
        {"copy_of_a_light_field",
         [](const Progress& progress) {
             LightFieldBuffer buffer(rays.grid());
             copy(rays, buffer, progress);
         }},
        {"photograph_of_a_light_field",
         [](const Progress& progress) {
             const Camera camera = camera_of(hologram);
             photograph(borrow(rays), {&camera, 1}, {}, progress);
         }},
        {"reading_a_hologram",
         [](const Progress& progress) {
             HologramOptions options;
             options.channel = {532_nm};
             options.pitch = 2_um;
             const auto stereogram = make_hologram(borrow(rays), options);
             Field field(stereogram->grid());
             copy(*stereogram, field, 0, progress);
         }},
        {"compress",
         [](const Progress& progress) {
             CompressionOptions options;
             options.target = Sqnr{30};
             compress(borrow(rays), std::filesystem::path(testing::TempDir()) / "stopped.hgl", options, progress);
         }},
    };
}

// Verbs that read a hologram's field.
std::vector<Verb> field_verbs() {
    static const SlowField& waves = slow_waves();
    static const FieldGrid& grid = waves.grid();
    return {
        {"copy_of_a_field",
         [](const Progress& progress) {
             Field field(grid);
             copy(waves, field, 0, progress);
         }},
        {"photograph_of_a_field",
         [](const Progress& progress) {
             const Camera camera = camera_of(grid.plane);
             photograph(waves, {&camera, 1}, {}, progress);
         }},
        {"photograph_behind_a_diffuser",
         [](const Progress& progress) {
             const Camera camera = camera_of(grid.plane);
             photograph(waves, {&camera, 1}, {.vertical_diffuser = true}, progress);
         }},
        {"photograph_by_plane_waves",
         [](const Progress& progress) {
             const Camera camera = camera_of(grid.plane);
             photograph_by_plane_waves(waves, {&camera, 1}, {}, progress);
         }},
        {"propagate",
         [](const Progress& progress) {
             Field field(grid);
             propagate(waves, 1_mm, field, {}, progress);
         }},
        {"encode_pattern",
         [](const Progress& progress) {
             PatternOptions options;
             options.modulator.pitch = grid.plane.pitch_x;
             options.modulator.width = options.modulator.height = 256;
             encode_pattern(waves, options, progress);
         }},
    };
}

// Verbs that read a scene.
std::vector<Verb> scene_verbs() {
    static const Scene lit = lit_ball();
    static const ShadedScene ball = shade_scene_vertices(make_scene("sphere", 0.5_mm));
    return {
        {"shade_scene", [](const Progress& progress) { shade_scene(lit, {.model = "vertex"}, progress); }},
        {"bake_scene", [](const Progress& progress) { bake_scene(lit, {.rays = 100000}, progress); }},
        {"a_scene_straight_to_a_field",
         [](const Progress& progress) {
             scene_hologram_methods()
                 .find("points-visible")
                 .make(ball, slow_waves().grid(), {.spacing = 0.5_um}, progress);
         }},
    };
}

// Discards all values.
class NullSink final : public LightFieldSink {
  public:
    void write(const LightFieldTile&) override {}
};

// A scene that takes seconds for each tile, behind the hologram, where every renderer can draw it.
std::shared_ptr<const ShadedScene> pumpkin_behind() {
    Scene scene = make_scene("pumpkin", 16_mm);
    const double front = bounds(scene).high.z + 1_mm;
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position.z -= front;
    return std::make_shared<const ShadedScene>(shade_scene(scene, {.model = "vertex"}));
}

std::vector<Verb> renderings() {
    static const auto scene = pumpkin_behind();
    std::vector<Verb> all;
    for (const RendererInfo& renderer : renderers().rows())
        all.push_back({renderer.name, [name = renderer.name](const Progress& progress) {
                           // Rows of few hogels, so that no time goes into the memory of a row.
                           const LightFieldGrid grid{64, 1024, 62.5_um, 256, 256, field_of_view(30_deg), 3};
                           NullSink sink;
                           copy(*make_renderer(name, scene, grid), sink, progress);
                       }});
    return all;
}

class Stop : public testing::TestWithParam<Verb> {};
INSTANTIATE_TEST_SUITE_P(LightFields, Stop, testing::ValuesIn(light_field_verbs()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Fields, Stop, testing::ValuesIn(field_verbs()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Scenes, Stop, testing::ValuesIn(scene_verbs()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Renderers, Stop, testing::ValuesIn(renderings()),
                         [](const auto& test) { return render::test_name(test.param.name); });

TEST_P(Stop, ends_the_work_within_a_second) {
    std::stop_source source;
    Clock::time_point asked;
    std::jthread later([&] {
        std::this_thread::sleep_for(milliseconds(150));
        asked = Clock::now();
        source.request_stop();
    });
    try {
        GetParam().call(Progress(source.get_token()));
        ADD_FAILURE() << "came to its end";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled) << error.what();
    }
    later.join();
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 1);
}

}  // namespace
}  // namespace hogel
