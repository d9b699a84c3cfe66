// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string scene, output;
    LightFieldParameters place;
    BakeOptions bake{.rays = defaults.bake_rays, .bounces = defaults.bake_bounces};
};

int bake(Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_baked_scene_name(options.output);
    require_writable(options.output, {&options.scene, 1});
    BakeOptions bake_options = options.bake;
    bake_options.seed = session.seed;
    const Scene scene = load_scene(session, options.scene, options.place);
    with_parameter("tessellate",
                   [&] { state_plan(session, plan_bake(scene, bake_options), "baking", options.output); });
    Stage stage(session, "baking");
    const Scene baked =
        with_parameter("tessellate", [&] { return hogel::bake_scene(scene, bake_options, stage.progress()); });
    write_baked_scene(options.output, baked, run_metadata(session));
    session.say(fmt::format("{}: {} triangles, {}; render it with --as-is", options.output, triangle_count(baked),
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    report_file(session, options.output, {{"triangles", triangle_count(baked)}});
    return 0;
}

}  // namespace

void add_bake(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel bake church -o church.glb\n"
        "  hogel render church.glb -o church.h5 --as-is --shading given");
    command.basics({"rays", "bounces", "size", "rotate", "light", "scale", "move", "up", "ground"});
    command.positional("scene", options->scene, "SCENE", "Mesh file or built-in scene");
    command.text("-o,--output", options->output, "FILE", "Mesh to write, with the radiance of every vertex: .glb")
        .required()
        .never_acts();
    command.count("--rays", options->bake.rays, "From every vertex, for reflected light");
    command.count("--bounces", options->bake.bounces, "How often light is reflected");
    command.count("--tessellate", options->bake.tessellation, "Parts into which the sides of triangles are cut");
    command.positive_length("--size", options->place.size, "Width of the hologram that the scene is fitted to");
    options->place.scene.declare(command);
    command.look_up("seed")->acts_if([] { return true; });
    command.add_like_option();
    command.work([options, &session] { return bake(*options, session); });
}

}  // namespace hogel::cli
