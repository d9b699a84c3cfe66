#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "hogel/core/parallel.h"
#include "hogel/core/units.h"
#include "hogel/render/region_memory.h"
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
    Counts region;  // none: what the renderer prefers
};

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

int render(const Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_writable(options.output);
    const std::vector<LightFieldGrid> grids = options.render.grids();
    auto sources = render_faces_on_demand(session, load_scene(session, options.scene, options.render), options.render);
    const HogelRange block = sources.front()->preferred_tile();
    if (options.region.columns > 0)
        for (auto& source : sources) source = std::make_unique<InRegions>(std::move(source), options.region);
    state_memory(options, *sources.front(), block, session);

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
                            grids.size() == 1   ? ""
                            : grids.size() == 3 ? " and two sides"
                                                : " and four sides",
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
    add_counts(command, "--region", options->region,
               "Hogels that a renderer is given at once (default: what it prefers)")
        ->group("Light field of a scene");
    add_hemicube_option(command, options->render);
    add_frequencies_option(command, options->render);
}

}  // namespace hogel::cli
