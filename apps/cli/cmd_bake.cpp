// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string scene, output;
    double size = defaults.size;
    BakeOptions bake{.rays = defaults.bake_rays, .bounces = defaults.bake_bounces};
};

int bake(const Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_baked_scene_name(options.output);
    require_writable(options.output);
    RenderOptions place;
    place.size = options.size;
    BakeOptions bake_options = options.bake;
    bake_options.seed = session.seed;
    const Scene scene = load_scene(session, options.scene, place);
    Stage stage(session, "baking");
    const Scene baked = hogel::bake_scene(scene, bake_options, stage.progress());
    write_baked_scene(options.output, baked);
    session.say(fmt::format("{}: {} triangles, {}; render it with --as-is", options.output, triangle_count(baked),
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    return 0;
}

}  // namespace

void add_bake(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "bake", "Light a scene for good, reflected light included",
                                    "  hogel bake church -o church.glb\n"
                                    "  hogel render church.glb -o church.h5 --as-is --shading given",
                                    [options, &session] { return bake(*options, session); });
    command->add_option("scene", options->scene, "Mesh file or built-in scene")->type_name("SCENE")->required();
    command->add_option("-o,--output", options->output, "Mesh to write, with the radiance of every vertex: .glb")
        ->type_name("FILE")
        ->required();
    add_count(command, "--rays", options->bake.rays, "From every vertex, for reflected light");
    add_count(command, "--bounces", options->bake.bounces, "How often light is reflected");
    add_count(command, "--tessellate", options->bake.tessellation, "Parts into which the sides of triangles are cut");
    add_length(command, "--size", options->size, "Width of the hologram that the scene is fitted to");
}

}  // namespace hogel::cli
