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
    bool single = false, resume = false;
};

int render(const Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_writable(options.output);
    const std::vector<LightFieldGrid> grids = options.render.grids();
    const auto sources =
        render_faces_on_demand(session, load_scene(session, options.scene, options.render), options.render);

    LightFieldFileOptions file = options.file;
    file.type = options.single ? SampleType::single : SampleType::half;
    file.metadata = describe_run(session);
    if (options.resume) file.resume = describe_input(options.scene);
    const auto sinks = create_light_field_faces(options.output, grids, file);
    Stage stage(session, "rendering");
    for (std::size_t i = 0; i < sources.size(); ++i) copy(*sources[i], *sinks[i], stage.progress(i, sources.size()));
    const LightFieldGrid& front = grids.front();
    session.say(fmt::format("{}: {}x{} hogels of {}x{} directions{}, {}", options.output, front.hogels_s,
                            front.hogels_t, front.directions_u, front.directions_v,
                            grids.size() == 1 ? "" : " and four sides",
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    return 0;
}

}  // namespace

void add_render(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "render", "Render a scene into a light field",
                                    "  hogel render pumpkin -o pumpkin.h5\n"
                                    "  hogel render bunny.ply -o bunny.h5 --hogels 128x128 --size 20mm --depth\n"
                                    "  hogel render tower -o all.h5 --hemicube --directions 128x128",
                                    [options, &session] { return render(*options, session); });
    command->add_option("scene", options->scene, "Mesh file or built-in scene")->type_name("SCENE")->required();
    command->add_option("-o,--output", options->output, "Light field to write, HDF5")->type_name("FILE")->required();
    command->add_flag("--depth", options->file.with_depth, "Store the depth of every ray too");
    command->add_flag("--float", options->single, "Store 32-bit floats rather than 16-bit ones");
    add_resume_flag(command, options->resume);
    add_render_options(command, options->render);
    add_hemicube_option(command, options->render);
    add_frequencies_option(command, options->render);
}

}  // namespace hogel::cli
