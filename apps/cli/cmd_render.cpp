// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "hogel/compress.h"
#include "hogel/core/parallel.h"
#include "hogel/renderer.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"
#include "resources.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string scene, output;
    RenderOptions render;
    LightFieldFileOptions file;
    bool single = false, resume = false;
    std::optional<double> sqnr;  // of a compressed light field
    Counts region;               // none: what the renderer prefers

    bool compressed() const { return std::filesystem::path(output).extension() == ".hgl"; }
};

using Faces = std::vector<std::unique_ptr<LightFieldSource>>;

// A renderer that is given regions of another size than it prefers.
class InRegions final : public LightFieldSource {
  public:
    InRegions(std::unique_ptr<LightFieldSource> source, const Counts& region) : source_(std::move(source)) {
        const LightFieldGrid& g = source_->grid();
        size_ = {0, 0, std::min(region.columns, g.hogels_s), std::min(region.rows, g.hogels_t)};
    }

    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return size_; }
    void read(LightFieldTile& tile) const override { source_->read(tile); }

  private:
    std::unique_ptr<LightFieldSource> source_;
    HogelRange size_;
};

// What a renderer takes that is given a region at once; with several samples a ray, of the finer light field, which is
// averaged in blocks.
double renderer_bytes(const Options& options, const LightFieldGrid& grid, const HogelRange& region,
                      const HogelRange& block, std::size_t values) {
    const SamplesPerRay samples = options.render.samples_per_ray();
    if (samples.count() == 1) return depth_buffer_bytes(options.render.algorithm, grid, region);
    const LightFieldGrid fine = finer(grid, samples);
    const HogelRange part{0, 0, samples.hogel * std::min(region.ns, block.ns),
                          samples.hogel * std::min(region.nt, block.nt)};
    return depth_buffer_bytes(options.render.algorithm, fine, part) +
           static_cast<double>(values * fine.directions()) * static_cast<double>(part.hogels()) * sizeof(float);
}

// Says how much memory regions will take before they do, or that they would not fit.
// @param block  the region that the renderer prefers
void state_memory(const Options& options, const LightFieldSource& source, const HogelRange& block,
                  const Session& session) {
    const LightFieldGrid& grid = source.grid();
    const HogelRange region = source.preferred_tile();
    const std::size_t kept = grid.channels + (options.file.with_depth ? 1 : 0);
    const double buffer = renderer_bytes(options, grid, region, block, kept);
    const double values =
        static_cast<double>(kept * grid.directions()) * static_cast<double>(region.hogels()) * sizeof(float);
    const std::size_t regions =
        ((grid.hogels_s + region.ns - 1) / region.ns) * ((grid.hogels_t + region.nt - 1) / region.nt);
    const std::size_t at_once = std::min(thread_count(), regions);
    const double bytes = static_cast<double>(at_once) * (buffer + values);
    const std::string text = fmt::format("{}: regions of {}x{} hogels, {} at once, take {}", options.render.algorithm,
                                         region.ns, region.nt, at_once, format_bytes(bytes));
    if (const double available = memory_available(); bytes > available)
        throw Error(ErrorCode::usage, fmt::format("{}; expected at most the {} that are free (see --region)", text,
                                                  format_bytes(available)));
    if (buffer > 0 || options.region.columns > 0)
        session.say(text);
    else
        session.detail(text);
}

// As it is rendered, with no file between.
int write_compressed(const Options& options, Faces rendered, const Session& session) {
    // It is read several times, in tiles of the coder's own.
    const Faces sources = render_for_reading(session, std::move(rendered), 2, options.file.with_depth);
    std::vector<const LightFieldSource*> faces;
    for (const auto& source : sources) faces.push_back(source.get());
    CompressionOptions compression;
    compression.target = Sqnr{options.sqnr.value_or(defaults.sqnr)};
    compression.with_depth = options.file.with_depth;
    compression.metadata = describe_run(session);
    Stage stage(session, "compressing");
    const CompressionResult result = compress(borrow(faces), options.output, compression, stage.progress());
    say_what_was_compressed(session, options.output, result);
    return 0;
}

int write_hdf5(const Options& options, const Faces& sources, const std::optional<std::string>& resume,
               const Session& session) {
    LightFieldFileOptions file = options.file;
    file.type = options.single ? SampleType::single : SampleType::half;
    file.metadata = describe_run(session);
    file.resume = resume;
    const auto sinks = create_light_field_faces(options.output, grids_of(sources), file);
    Stage stage(session, "rendering");
    for (std::size_t i = 0; i < sources.size(); ++i) copy(*sources[i], *sinks[i], stage.progress(i, sources.size()));
    const LightFieldGrid& front = sources.front()->grid();
    session.say(fmt::format("{}: {}x{} hogels of {}x{} directions{}, {}", options.output, front.hogels_s,
                            front.hogels_t, front.directions_u, front.directions_v,
                            sources.size() == 1   ? ""
                            : sources.size() == 3 ? " and two sides"
                                                  : " and four sides",
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    return 0;
}

int render(const Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    if (options.compressed() && (options.single || options.resume))
        throw Error(ErrorCode::usage,
                    fmt::format("--float, --resume: belong to HDF5 files; {} is a compressed one", options.output));
    if (options.sqnr && !options.compressed())
        throw Error(
            ErrorCode::usage,
            fmt::format("--sqnr: belongs to compressed files, whose names end in .hgl, not to {}", options.output));
    require_writable(options.output);
    options.render.grids();  // complains before there is a scene
    std::optional<std::string> resume;
    Faces sources = [&] {
        const Scene scene = load_scene(session, options.scene, options.render);
        if (options.resume) resume = describe_input(options.scene, scene);
        return render_faces_on_demand(session, scene, options.render);
    }();
    const HogelRange block = sources.front()->preferred_tile();
    if (options.region.columns > 0)
        for (auto& source : sources) source = std::make_unique<InRegions>(std::move(source), options.region);
    state_memory(options, *sources.front(), block, session);
    return options.compressed() ? write_compressed(options, std::move(sources), session)
                                : write_hdf5(options, sources, resume, session);
}

}  // namespace

void add_render(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "render", "Render a scene into a light field",
                                    "  hogel render pumpkin -o pumpkin.h5\n"
                                    "  hogel render bunny.ply -o bunny.h5 --hogels 128x128 --size 20mm --depth\n"
                                    "  hogel render tower -o all.h5 --hemicube --directions 128x128\n"
                                    "  hogel render pumpkin -o pumpkin.hgl --sqnr 35",
                                    [options, &session] { return render(*options, session); });
    command->add_option("scene", options->scene, "Mesh file or built-in scene")->type_name("SCENE")->required();
    command->add_option("-o,--output", options->output, "Light field to write: HDF5, or compressed if it ends in .hgl")
        ->type_name("FILE")
        ->required();
    command->add_flag("--depth", options->file.with_depth, "Store the depth of every ray too");
    command->add_flag("--float", options->single, "Store 32-bit floats rather than 16-bit ones");
    command
        ->add_option("--sqnr", options->sqnr,
                     fmt::format("Signal to error of a compressed light field, within 0.1 dB above (default: {})",
                                 defaults.sqnr))
        ->type_name("DB");
    add_resume_flag(command, options->resume);
    add_render_options(command, options->render);
    add_counts(command, "--region", options->region,
               "Hogels that a renderer is given at once (default: what it prefers)")
        ->default_str("")
        ->group("Light field of a scene");
    add_hemicube_option(command, options->render);
    add_frequencies_option(command, options->render);
}

}  // namespace hogel::cli
