// SPDX-License-Identifier: Apache-2.0
// A build without Embree renders everything that needs no rays, and names the refused part otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "hogel/error.h"
#include "hogel/render/test_renderers.h"
#include "hogel/scene.h"
#include "hogel/shading.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid grid{5, 4, 1_mm, 33, 31, Perspective{0.5, 0.4}, 3};

// Returns the fraction of samples with equal depth and radiance. At silhouettes rounding decides.
double share_of_equal_samples(const LightFieldBuffer& a, const LightFieldBuffer& b) {
    std::size_t equal = 0;
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
        const float first = a.depth.data()[i], second = b.depth.data()[i];
        bool same = std::isinf(first) ? std::isinf(second) : std::abs(first - second) < 1e-7f;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * a.depth.size() + i;
            same = same && std::abs(a.radiance.data()[at] - b.radiance.data()[at]) < 1e-3f;
        }
        equal += same ? 1 : 0;
    }
    return static_cast<double>(equal) / static_cast<double>(a.depth.size());
}

void expect_refusal(const std::string& what, const std::function<void()>& work) {
    try {
        work();
        ADD_FAILURE() << what << " was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::not_built_in);
        EXPECT_EQ(error.what(),
                  what + ": this build of hogel lacks Embree; the build option HOGEL_EMBREE=ON brings it");
    }
}

TEST(WithoutEmbree, the_other_renderers_agree) {
    std::mt19937 random(1);
    for (int round = 0; round < 4; ++round) {
        const ShadedScene scene = random_scene(random, 16, true);
        const LightFieldBuffer reference = render("zbuffer", scene, grid);
        EXPECT_TRUE(std::ranges::any_of(reference.depth.elements(), [](float depth) { return std::isfinite(depth); }));
        for (const std::string& name : renderer_names("raytrace"))
            EXPECT_GT(share_of_equal_samples(reference, render(name, scene, grid)), 0.97) << name;
    }
}

TEST(WithoutEmbree, scenes_without_shadows_are_shaded) {
    Scene scene = make_scene("pumpkin", 20_mm);
    for (const char* model : {"vertex", "direct", "shadowed"})
        expect_refusal(std::string("shadows, in the shading model '") + model + "'",
                       [&] { shade_scene(scene, {.model = model}); });
    for (Light& light : scene.lights) light.casts_shadows = false;
    for (const char* model : {"vertex", "direct", "shadowed"}) {
        const LightFieldBuffer seen = render("epi", shade_scene(scene, {.model = model}), grid);
        EXPECT_TRUE(std::ranges::any_of(seen.radiance.elements(), [](float value) { return value > 0; })) << model;
    }
}

TEST(WithoutEmbree, what_casts_rays_is_refused_by_name) {
    const Scene scene = make_scene("two-planes", 20_mm);
    const auto shaded = std::make_shared<const ShadedScene>(shade_scene(scene));
    expect_refusal("the renderer 'raytrace'", [&] { make_renderer("raytrace", shaded, grid); });
    expect_refusal("baking", [&] { bake_scene(scene); });
}

}  // namespace
}  // namespace hogel::render
