// SPDX-License-Identifier: Apache-2.0
// The table of renderers: names, the facts in rows, and rows that a program adds.
#include <gtest/gtest.h>

#include <string>

#include "hogel/error.h"
#include "hogel/render/test_renderers.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

LightFieldGrid grid_of(Face face) {
    LightFieldGrid grid{100, 50, 1e-3, 16, 6, Perspective{0.5, 0.4}, 3};
    std::get<Perspective>(grid.view).face = face;
    return grid;
}

// Memory as in docs/renderers.md: 8 bytes for each ray that a renderer keeps, 32 with a picture per hogel.
TEST(RendererTable, depth_buffers_take_8_or_32_bytes_a_ray) {
    const LightFieldGrid grid = grid_of(Face::front);
    const HogelRange region{7, 3, 20, 10};
    const auto bytes = [](const char* name, const LightFieldGrid& of, const HogelRange& hogels) {
        return renderers().find(name).cost(of, hogels, 0).bytes;
    };
    EXPECT_EQ(bytes("simplex", grid, region), 8.0 * 20 * 10 * 16 * 6);
    EXPECT_EQ(bytes("simploid", grid, region), 8.0 * 20 * 10 * 16);
    EXPECT_EQ(bytes("simploid", grid_of(Face::left), region), 8.0 * 20 * 10 * 6);
    EXPECT_EQ(bytes("simplex3d", grid, region), 8.0 * 20 * 16 * 6);
    EXPECT_EQ(bytes("oblique", grid, region), 8.0 * 20 * 10);
    EXPECT_EQ(bytes("zbuffer", grid, region), 32.0 * 16 * 6);
    for (const char* name : {"raytrace", "mvr", "epi"}) EXPECT_FALSE(renderers().find(name).cost) << name;
}

TEST(RendererTable, depth_buffers_larger_than_any_memory_have_a_size) {
    LightFieldGrid grid = grid_of(Face::front);
    grid.hogels_s = grid.hogels_t = 1 << 20;
    grid.directions_u = grid.directions_v = 1 << 14;
    EXPECT_EQ(renderers().find("simplex").cost(grid, {0, 0, 1 << 20, 1 << 20}, 0).bytes, 0x1p71);
}

// The code and the message of the error when making a renderer.
std::string complaint(std::string_view name, const LightFieldGrid& grid) {
    try {
        make_renderer(name, std::make_shared<const ShadedScene>(), grid);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.what();
    }
    return {};
}

TEST(RendererTable, an_unknown_name_is_refused_with_the_nearest_and_the_known_ones) {
    const std::string message = complaint("zbufer", grid_of(Face::front));
    EXPECT_NE(message.find("did you mean 'zbuffer'"), std::string::npos) << message;
    EXPECT_NE(message.find("raytrace, zbuffer"), std::string::npos) << message;
}

TEST(RendererTable, rows_say_which_renderers_take_frequencies) {
    LightFieldGrid grid{4, 4, 1_mm, 5, 5, Frequencies{{0.3, 0.3}}, 1};
    std::size_t taking = 0;
    for (const RendererInfo& info : renderers().rows()) {
        const std::string message = complaint(info.name, grid);
        EXPECT_EQ(message.empty(), info.takes_frequencies) << info.name << ": " << message;
        if (!message.empty()) {
            EXPECT_NE(message.find("(but not raytrace, zbuffer, oblique"), std::string::npos) << message;
        }
        taking += info.takes_frequencies ? 1 : 0;
    }
    EXPECT_GT(taking, 0u);
}

// A light field source of a program, which is not a Renderer.
class OwnRays final : public LightFieldSource {
  public:
    OwnRays(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : source_(make_renderer("raytrace", std::move(scene), grid)) {
        ++made;
    }
    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return true; }
    void read(LightFieldTile& tile) const override { source_->read(tile); }

    static inline int made = 0;

  private:
    std::unique_ptr<LightFieldSource> source_;
};

TEST(RendererTable, a_renderer_that_a_program_adds_is_used_like_any_other) {
    renderers().add(
        {.name = "own-rays",
         .text = "rays of a test",
         .make = [](std::shared_ptr<const ShadedScene> scene,
                    const LightFieldGrid& grid) { return std::make_unique<OwnRays>(std::move(scene), grid); },
         .takes_frequencies = true});
    EXPECT_THROW(renderers().add(renderers().find("own-rays")), Error);
    EXPECT_EQ(renderers().names().back(), "own-rays");
    const LightFieldGrid grid{3, 2, 1_mm, 9, 7, Perspective{0.4, 0.3}, 3};
    std::mt19937 random(1);
    const ShadedScene first = random_scene(random, 20, true), second = random_scene(random, 20, true);
    EXPECT_TRUE(same_bytes(render("own-rays", first, grid), render("raytrace", first, grid)));
    EXPECT_TRUE(same_bytes(render("own-rays", first, grid, {2, 3}), render("raytrace", first, grid, {2, 3})));
    EXPECT_EQ(OwnRays::made, 2);
    // A new source is made for another scene.
    const auto renderer = make_renderer("own-rays", std::make_shared<const ShadedScene>(first), grid);
    renderer->set_scene(std::make_shared<const ShadedScene>(second));
    LightFieldBuffer seen(grid, true);
    copy(*renderer, seen);
    EXPECT_TRUE(same_bytes(seen, render("raytrace", second, grid)));
    EXPECT_EQ(OwnRays::made, 4);
}

}  // namespace
}  // namespace hogel::render
