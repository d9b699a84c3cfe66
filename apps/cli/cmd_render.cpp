// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/resources.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string scene;
    LightFieldOutput output;
    LightFieldParameters render;
    bool resume = false;
    PartOption part;
    Counts region;  // empty: the size that the renderer prefers

    LightFieldFileOptions file() const {
        LightFieldFileOptions file;
        file.type = output.single ? SampleType::single : SampleType::half;
        file.with_depth = output.with_depth;
        return file;
    }
};

// Wraps a renderer with another region size.
class RegionSource final : public LightFieldSource {
  public:
    RegionSource(LightField::Source source, const Counts& region) : source_(std::move(source)) {
        const LightFieldGrid& g = source_->grid();
        size_ = {0, 0, std::min(region.columns, g.hogels_s), std::min(region.rows, g.hogels_t)};
    }

    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return size_; }
    void read(LightFieldTile& tile) const override { source_->read(tile); }

  private:
    LightField::Source source_;
    HogelRange size_;
};

// Prints the memory needed by regions. Throws if it is not available.
void check_plan(const Options& options, const LightField& rendered, const Scene& scene, const Session& session) {
    const Plan plan = plan_light_field(rendered, options.render.request(scene), triangle_count(scene), options.file());
    const HogelRange region = rendered.front().preferred_tile();
    const LightFieldGrid& grid = rendered.grid();
    const std::size_t regions =
        ((grid.hogels_s + region.ns - 1) / region.ns) * ((grid.hogels_t + region.nt - 1) / region.nt);
    const std::string what =
        fmt::format("rendering by {} in regions of {}x{} hogels, {} at once,", options.render.algorithm, region.ns,
                    region.nt, std::min(thread_count(), regions));
    const bool chosen = options.region.columns > 0;
    with_parameter(chosen ? "region" : "hogels, directions", [&] {
        check_plan(session, plan, what, options.output.compressed() ? "" : options.output.file, chosen);
    });
}

// Writes the light field or a part of it.
// @param input  description of the scene, stored in parts and unfinished files
int write_hdf5(const Options& options, const LightField& light_field, const std::string& input,
               const Session& session) {
    LightFieldFileOptions file = options.file();
    file.metadata = run_metadata(session);
    if (options.resume) file.resume = input;
    Stage stage(session, "rendering");
    if (options.part.part) {
        const std::string name = options.part.file_for(options.output.file);
        write_light_field_part(name, light_field, file, options.part.of(input), stage.progress());
        report_part(session, name, *options.part.part);
        return 0;
    }
    write_light_field(options.output.file, light_field, file, stage.progress());
    const LightFieldGrid& front = light_field.grid();
    const std::size_t faces = light_field.faces().size();
    session.say(fmt::format("{}: {}x{} hogels of {}x{} directions{}, {}", options.output.file, front.hogels_s,
                            front.hogels_t, front.directions_u, front.directions_v,
                            faces == 1   ? ""
                            : faces == 3 ? " and two sides"
                                         : " and four sides",
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output.file)))));
    report_samples(session, options.output.file);
    return 0;
}

int render(Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    options.output.require(options.scene);
    if (options.part.part && options.output.compressed())
        throw Error(ErrorCode::usage, "part",
                    fmt::format("applies to HDF5 files; {} is a compressed one", options.output.file));
    static_cast<void>(options.render.request());  // throws before a scene is loaded
    const Scene scene = load_scene(session, options.scene, options.render);
    const std::string input = options.resume || options.part.part ? describe_input(options.scene, scene) : "";
    LightField rendered = render_light_field(session, scene, options.render);
    if (options.region.columns > 0)
        rendered = rendered.wrapped(
            [&](const LightField::Source& face) { return std::make_shared<const RegionSource>(face, options.region); });
    check_plan(options, rendered, scene, session);
    if (!options.output.compressed()) return write_hdf5(options, rendered, input, session);
    write_compressed(options.output, rendered, session, options.resume ? std::optional(input) : std::nullopt);
    return 0;
}

}  // namespace

void add_render(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel render pumpkin -o pumpkin.h5\n"
        "  hogel render bunny.ply -o bunny.h5 --hogels 128x128 --size 20mm --depth\n"
        "  hogel render tower -o all.h5 --hemicube --directions 128x128\n"
        "  hogel render pumpkin -o pumpkin.hgl --sqnr 35");
    command.basics({"hogels", "directions", "size", "fov", "algorithm", "shading", "rotate", "light", "depth", "sqnr"});
    command.positional("scene", options->scene, "SCENE", "Picture, mesh file or built-in scene");
    add_light_field_output(command, options->output, "Store the depth of every ray too",
                           "Store 32-bit floats rather than 16-bit ones");
    add_resume_flag(command, options->resume);
    add_part_option(command, options->part);
    options->render.declare(command);
    command
        .counts("--region", options->region,
                "Size of the regions that a renderer draws at once, in hogels (default: chosen by the renderer)")
        .no_default()
        .never_acts();
    options->render.declare_hemicube(command);
    options->render.declare_directions(command);
    command.add_like_option();
    command.work([options, &session] { return render(*options, session); });
}

}  // namespace hogel::cli
