// SPDX-License-Identifier: Apache-2.0
// A stop ends every function that takes a Progress, wherever in the library it is working. How soon is counted in work
// that begins or ends after the stop, because seconds depend on the machine.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "hogel/compress.h"
#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"
#include "hogel/core/test_stop.h"
#include "hogel/hologram.h"
#include "hogel/pattern.h"
#include "hogel/photograph.h"
#include "hogel/propagate.h"
#include "hogel/render/test_renderers.h"
#include "hogel/renderer.h"
#include "hogel/scene.h"
#include "hogel/scene_hologram.h"
#include "hogel/shading.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace {

using namespace literals;

// What reading a slow light field or hologram takes: the test's own work.
core::StoppedWork* items = nullptr;

// Work that takes a minute on all threads.
void work_for_a_minute() {
    work::parallel_for(60000 * thread_count(), [](std::size_t) { items->item(); });
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
             photograph(waves, {&camera, 1}, BandCamera(), progress);
         }},
        {"photograph_behind_a_diffuser",
         [](const Progress& progress) {
             const Camera camera = camera_of(grid.plane);
             photograph(waves, {&camera, 1}, BandCamera{.vertical_diffuser = true}, progress);
         }},
        {"photograph_with_plane_waves",
         [](const Progress& progress) {
             const Camera camera = camera_of(grid.plane);
             photograph(waves, {&camera, 1}, PlaneWaveCamera(), progress);
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

const Scene& lit() {
    static const Scene scene = lit_ball();
    return scene;
}

// Verbs that read a scene and report the steps of their work.
std::vector<Verb> scene_verbs_in_steps() {
    static const ShadedScene ball = shade_scene_vertices(make_scene("sphere", 0.5_mm));
    return {
        {"bake_scene", [](const Progress& progress) { bake_scene(lit(), {.rays = 100000}, progress); }},
        {"a_scene_straight_to_a_field",
         [](const Progress& progress) {
             scene_hologram_methods()
                 .find("points-visible")
                 .make(ball, slow_waves().grid(), {.spacing = 1_um}, progress);
         }},
    };
}

// Verbs that read a scene.
std::vector<Verb> scene_verbs() {
    std::vector<Verb> all = scene_verbs_in_steps();
    all.push_back({"shade_scene", [](const Progress& progress) { shade_scene(lit(), {.model = "vertex"}, progress); }});
    return all;
}

// Light that counts the samples that show it, and requests a stop at one of them.
class CountingLight final : public SampleLighting {
  public:
    // `at`: the sample, from 1; 0: none.
    explicit CountingLight(std::size_t at = 0) : at_(at) {}
    Size size_of_light(std::size_t) const override { return {1, 0}; }
    bool light_is_radiance(std::size_t) const override { return false; }
    void light_on(const ShadedScene&, std::size_t, const std::array<float, 3>&, std::span<float> light) const override {
        light[0] = 1;
    }
    Rgb radiance(const ShadedScene&, std::size_t, const std::array<float, 3>&, std::span<const float>, Rgb texture,
                 const ViewSample&) const override {
        if (++samples_ == at_) stop_.request_stop();
        return texture;
    }
    Progress progress() const { return Progress(stop_.get_token()); }
    std::size_t samples() const { return samples_; }

  private:
    std::size_t at_;
    mutable std::stop_source stop_;
    mutable std::atomic<std::size_t> samples_{0};
};

// Discards all values.
class NullSink final : public LightFieldSink {
  public:
    void write(const LightFieldTile&) override {}
};

// A scene behind the hologram, where every renderer can draw it.
ShadedScene pumpkin_behind() {
    Scene scene = make_scene("pumpkin", 16_mm);
    const double front = bounds(scene).high.z + 1_mm;
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position.z -= front;
    return shade_scene(scene, {.model = "vertex"});
}

std::vector<std::string> renderer_names() {
    std::vector<std::string> names;
    for (const RendererInfo& renderer : renderers().rows()) names.push_back(renderer.name);
    return names;
}

// Requests a stop while work is going on.
std::jthread soon(const std::stop_source& stop) {
    return std::jthread([stop]() mutable {
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        stop.request_stop();
    });
}

constexpr const char* at_its_end = "came to its end";

class StopOfReading : public testing::TestWithParam<Verb> {};
INSTANTIATE_TEST_SUITE_P(LightFields, StopOfReading, testing::ValuesIn(light_field_verbs()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Fields, StopOfReading, testing::ValuesIn(field_verbs()),
                         [](const auto& test) { return test.param.name; });

TEST_P(StopOfReading, lets_each_thread_begin_one_more_item_at_most) {
    core::StoppedWork work(20 * thread_count());
    items = &work;
    EXPECT_TRUE(core::is_cancelled([&] { GetParam().call(work.progress()); })) << at_its_end;
    EXPECT_LE(work.most_begun_later(), 1u);
}

class StopOfSceneWork : public testing::TestWithParam<Verb> {};
INSTANTIATE_TEST_SUITE_P(Scenes, StopOfSceneWork, testing::ValuesIn(scene_verbs()),
                         [](const auto& test) { return test.param.name; });

// The work takes half a minute or more.
TEST_P(StopOfSceneWork, comes_before_its_end) {
    std::stop_source stop;
    const std::jthread other = soon(stop);
    EXPECT_TRUE(core::is_cancelled([&] { GetParam().call(Progress(stop.get_token())); })) << at_its_end;
}

class StopOfSteps : public testing::TestWithParam<Verb> {};
INSTANTIATE_TEST_SUITE_P(Scenes, StopOfSteps, testing::ValuesIn(scene_verbs_in_steps()),
                         [](const auto& test) { return test.param.name; });

// The stop is that of work around this one, because a Progress reports nothing more after a stop of its own.
TEST_P(StopOfSteps, lets_each_thread_end_one_more_step_at_most) {
    std::stop_source stop;
    const core::StopScope scope{Progress(stop.get_token())};
    std::size_t steps = 0, later = 0;
    const Progress progress([&](double) {
        if (stop.stop_requested()) ++later;
        if (++steps == 2) stop.request_stop();
        return later <= 2 * thread_count();
    });
    EXPECT_TRUE(core::is_cancelled([&] { GetParam().call(progress); })) << at_its_end;
    EXPECT_GE(steps, 2u);
    EXPECT_LE(later, thread_count());
}

class StopOfRendering : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, StopOfRendering, testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return render::test_name(test.param); });

const LightFieldGrid stopped_grid{32, 32, 0.5_mm, 32, 32, field_of_view(30_deg), 1};

std::unique_ptr<LightFieldSource> renderer_in(const std::string& name, std::shared_ptr<const CountingLight> light) {
    static const ShadedScene pumpkin = pumpkin_behind();
    const auto scene = std::make_shared<ShadedScene>(pumpkin);
    scene->lighting = std::move(light);
    return make_renderer(name, scene, stopped_grid);
}

// How many samples show the scene.
std::size_t samples_of_the_scene() {
    const auto light = std::make_shared<CountingLight>();
    NullSink sink;
    copy(*renderer_in("epi", light), sink);
    return light->samples();
}

TEST_P(StopOfRendering, leaves_most_samples_undone) {
    static const std::size_t all = samples_of_the_scene();
    const auto light = std::make_shared<CountingLight>(100);
    NullSink sink;
    EXPECT_TRUE(core::is_cancelled([&] { copy(*renderer_in(GetParam(), light), sink, light->progress()); }))
        << at_its_end;
    EXPECT_GE(light->samples(), 100u);
    EXPECT_LT(light->samples(), all / 8) << "of " << all;
}

// Some renderers find the first sample when most of their work is done.
TEST_P(StopOfRendering, comes_before_the_first_sample) {
    const auto light = std::make_shared<CountingLight>();
    const auto source = renderer_in(GetParam(), light);
    LightFieldTile tile(stopped_grid, {0, 0, stopped_grid.hogels_s, stopped_grid.hogels_t}, false);
    std::stop_source stop;
    stop.request_stop();
    const core::StopScope scope{Progress(stop.get_token())};
    EXPECT_TRUE(core::is_cancelled([&] { source->read(tile); })) << at_its_end;
    EXPECT_EQ(light->samples(), 0u);
}

}  // namespace
}  // namespace hogel
