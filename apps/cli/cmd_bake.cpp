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
    BakeParameters bake;
};

int bake(Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_baked_scene_name(options.output);
    require_writable(options.output, {&options.scene, 1});
    BakeOptions bake_options = options.bake.options;
    bake_options.seed = session.seed;
    const Scene scene = load_scene(session, options.scene, options.bake.place);
    with_parameter("tessellate",
                   [&] { check_plan(session, plan_bake(scene, bake_options), "baking", options.output); });
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
    command.positional("scene", options->scene, "SCENE", "Picture, mesh file or built-in scene");
    command.text("-o,--output", options->output, "FILE", "Mesh to write, with the radiance of every vertex: .glb")
        .required()
        .never_acts();
    options->bake.declare(command);
    command.look_up("seed")->acts_if([] { return true; });
    command.add_like_option();
    command.work([options, &session] { return bake(*options, session); });
}

}  // namespace hogel::cli
