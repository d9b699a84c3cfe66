#include <fmt/format.h>

#include "commands.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string scene, output;
    RenderOptions render;
    LightFieldFileOptions file;
    bool single = false;
};

int render(const Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_writable(options.output);
    const LightFieldGrid grid = options.render.grid();
    const auto source = render_on_demand(session, load_scene(options.scene, options.render), options.render);

    LightFieldFileOptions file = options.file;
    file.type = options.single ? SampleType::single : SampleType::half;
    file.metadata = describe_run(session);
    const auto sink = create_light_field(options.output, grid, file);
    Stage stage(session, "rendering");
    copy(*source, *sink, stage.progress());
    session.say(fmt::format("{}: {}x{} hogels of {}x{} directions, {}", options.output, grid.hogels_s, grid.hogels_t,
                            grid.directions_u, grid.directions_v,
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    return 0;
}

}  // namespace

void add_render(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "render", "Render a scene into a light field",
                                    "  hogel render pumpkin -o pumpkin.h5\n"
                                    "  hogel render bunny.ply -o bunny.h5 --hogels 128x128 --size 20mm --depth",
                                    [options, &session] { return render(*options, session); });
    command->add_option("scene", options->scene, "Mesh file or built-in scene")->type_name("SCENE")->required();
    command->add_option("-o,--output", options->output, "Light field to write, HDF5")->type_name("FILE")->required();
    command->add_flag("--depth", options->file.with_depth, "Store the depth of every ray too");
    command->add_flag("--float", options->single, "Store 32-bit floats rather than 16-bit ones");
    add_render_options(command, options->render);
}

}  // namespace hogel::cli
