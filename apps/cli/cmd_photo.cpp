#include <fmt/format.h>

#include "commands.h"
#include "hogel/lightfield/photograph.h"
#include "hogel/optics/photograph.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    RenderOptions render;
    HologramOptions hologram;
    Vec3 eye{0, 0, defaults.eye_distance};
    double focus = 0;
    double pupil = defaults.pupil;
    std::size_t resolution = defaults.resolution;
    std::size_t looks = defaults.looks;
    std::size_t pupil_samples = defaults.pupil_samples;
    std::string exposure = "auto";
    std::string camera{defaults.camera};
    bool geometric = false, wave = false;

    // Where the full camera may put what does not fit into memory: beside the picture.
    std::optional<std::filesystem::path> scratch() const {
        if (camera != "full") return {};
        return std::filesystem::absolute(output).parent_path();
    }
};

double parse_exposure(const std::string& text) {
    double exposure = 0;
    if (!CLI::detail::lexical_cast(text, exposure) || !(exposure > 0 && exposure < 1e12))
        throw Error(ErrorCode::usage, fmt::format("--exposure: '{}' is neither auto nor a positive number", text));
    return exposure;
}

Camera make_camera(const Options& options, double width, double height) {
    Camera camera = camera_for(width, height, options.resolution);
    camera.eye = options.eye;
    camera.focus_depth = options.focus;
    camera.pupil = options.pupil;
    validate(camera);
    return camera;
}

Image photograph_of_hologram(const Options& options, const Session& session) {
    const HologramFile file = open_hologram(options.input);
    if (file.fields.size() != 1 && file.fields.size() != 3)
        throw Error(ErrorCode::bad_input, fmt::format("{}: has {} wavelengths; a photograph takes one or three",
                                                      options.input, file.fields.size()));
    const Grid& plane = file.fields.front()->grid().plane;
    const Camera camera = make_camera(options, plane.size_x(), plane.size_y());
    for (const auto& field : file.fields) require_light_towards(field->grid(), camera);
    Stage stage(session, "wave photograph");
    return photograph_colours(stage, file.fields, {&camera, 1}, options.scratch()).front();
}

Image photograph_of_light_field(const Options& options, const Session& session, InputKind kind, bool geometric) {
    auto faces = open_or_render_faces(session, options.input, options.render);
    const LightFieldGrid grid = faces.front()->grid();
    const Camera camera = make_camera(options, grid.pitch * static_cast<double>(grid.hogels_s),
                                      grid.pitch * static_cast<double>(grid.hogels_t));
    if (geometric) {
        Stage stage(session, "geometric photograph");
        std::vector<const LightFieldSource*> sources;
        for (const auto& face : faces) sources.push_back(face.get());
        return photograph(sources, {&camera, 1}, options.pupil_samples, stage.progress()).front();
    }
    auto light_field = std::move(faces.front());
    require_holograms(grid, options.hologram, {&camera, 1});
    if (kind == InputKind::scene)
        light_field = render_once(session, std::move(light_field), needs_depth(options.hologram));
    const auto holograms = make_holograms(session, *light_field, options.hologram, options.looks);
    Stage stage(session, "wave photograph");
    return photograph_colours(stage, holograms, {&camera, 1}, options.scratch()).front();
}

int photo(const Options& options, const Session& session) {
    const double given = options.exposure == "auto" ? 0 : parse_exposure(options.exposure);
    const InputKind kind = input_kind(options.input);
    require_picture_name(options.output);
    require_writable(options.output);
    if (kind == InputKind::hologram && options.geometric)
        throw Error(ErrorCode::usage, "--geometric: a hologram has no rays to follow; give its light field or scene");
    if (kind == InputKind::scene && options.render.hemicube && !options.geometric)
        throw Error(ErrorCode::usage, "--hemicube: only a photograph by rays has use for the sides; add --geometric");
    const bool geometric = options.geometric || (kind == InputKind::light_field && !options.wave);
    if (geometric && options.camera != defaults.camera)
        throw Error(ErrorCode::usage, "--camera full: photographs waves; give --wave or a hologram");
    const Image picture = kind == InputKind::hologram ? photograph_of_hologram(options, session)
                                                      : photograph_of_light_field(options, session, kind, geometric);
    const double exposure = given > 0 ? given : automatic_exposure(picture);
    Metadata metadata = describe_run(session);
    metadata.emplace_back("exposure", fmt::format("{:.9g}", exposure));
    write_image(options.output, picture, exposure, metadata);
    session.say(
        fmt::format("{}: {}x{} pixels, exposure {:.6g}", options.output, picture.width(), picture.height(), exposure));
    return 0;
}

void add_camera_options(CLI::App* command, Options& options) {
    const auto group = [](CLI::Option* option) { option->group("Camera"); };
    group(add_point(command, "--eye", options.eye, "Centre of the lens; the hologram is around 0,0,0"));
    group(add_length(command, "--focus", options.focus,
                     "Depth in focus: positive behind the hologram, negative in front"));
    group(add_length(command, "--pupil", options.pupil, "Diameter of the lens"));
    group(add_count(command, "--resolution", options.resolution, "Pixels across"));
    group(add_count(command, "--looks", options.looks,
                    "Photographs averaged against speckle, unless of a hologram file"));
    group(command->add_option("--exposure", options.exposure, "What linear values are multiplied by in PNG, or auto")
              ->type_name("NUMBER|auto")
              ->capture_default_str());
    group(command
              ->add_option("--camera", options.camera,
                           "How waves are photographed:\nnarrow: the band that enters the lens, tile by tile"
                           "\nfull: plane waves to the lens and back, exact and slow")
              ->type_name("narrow|full")
              ->check(CLI::IsMember({"narrow", "full"}).description(""))
              ->capture_default_str());
    CLI::Option* geometric =
        command->add_flag("--geometric", options.geometric, "By rays rather than waves (default for a light field)");
    group(geometric);
    group(command->add_flag("--wave", options.wave, "By waves, through the hologram (default for a scene)")
              ->excludes(geometric));
    group(
        add_count(command, "--pupil-samples", options.pupil_samples, "Points of the pupil in a geometric photograph"));
}

}  // namespace

void add_photo(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "photo", "Photograph a hologram, a light field or a scene",
                                    "  hogel photo hologram.h5 -o left.png --eye -30,0,300mm --focus 5mm\n"
                                    "  hogel photo pumpkin.h5 -o truth.exr --focus -4mm\n"
                                    "  hogel photo pumpkin -o wave.png --hogels 128x128 --size 8mm --looks 8",
                                    [options, &session] { return photo(*options, session); });
    command->add_option("input", options->input, "Hologram, light field, mesh file or built-in scene")
        ->type_name("F.h5|X.h5|SCENE")
        ->required();
    command->add_option("-o,--output", options->output, "Picture to write: .png, .tif (sRGB) or .exr (linear)")
        ->type_name("FILE")
        ->required();
    add_camera_options(command, *options);
    add_hologram_options(command, options->hologram);
    add_render_options(command, options->render);
    add_hemicube_option(command, options->render);
}

}  // namespace hogel::cli
