// SPDX-License-Identifier: Apache-2.0
// Estimates of the resources of work. Memory and disk space follow from the sizes of arrays. Times are estimates from
// rates measured on one machine.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "hogel/core/available_memory.h"
#include "hogel/error.h"
#include "hogel/lightfield/exposure.h"
#include "hogel/pipeline.h"
#include "hogel/pipeline/plan_rates.h"
#include "hogel/units.h"

namespace hogel {
namespace {

// Processor seconds, measured on two cores of an AMD EPYC (Zen 5) with g++ 12, 2026-11-22 (docs/performance.md).
// Seconds per ray with epi: a constant, and an addition per million triangles.
constexpr double seconds_a_ray = 1.9e-9, seconds_a_ray_and_million_triangles = 2.0e-9;
// Seconds per sample to compress a light field with the coder hogel to 40 dB, including the search for the step: 126e-9
// for the pumpkin and 251e-9 for the church, at 48 x 48 directions. Other coders were not measured.
constexpr double seconds_a_coded_sample = 190e-9;
// Seconds per operation that propagation_method() counts.
constexpr double seconds_a_propagation_operation = 0.35e-9;

// Seconds per point of the pupil and hogel, and per point of the pupil and pixel, of a photograph by rays in three
// colours; of 200 x 200 hogels and pictures of 16 x 16 to 800 x 800 pixels, by one thread of an EPYC (Zen 5) with
// nothing else on it. Bytes per point of the pupil.
constexpr double seconds_a_seen_hogel = 13e-9, seconds_a_seen_pixel = 2.7e-9, bytes_a_lens_point = 32;
// Seconds per ray that gathers reflected light (440e-9 for the pumpkin, 490e-9 for the church), and bytes per triangle
// of the result, while it is computed and in a file.
constexpr double seconds_a_gathered_ray = 450e-9, bytes_a_baked_triangle = 310, file_bytes_a_baked_triangle = 31;

// What a region of a face takes: its values, what the renderer needs and, with several samples per ray, a block of the
// finer light field.
RenderCost cost_of_region(const LightFieldSource& face, const LightFieldRequest& request, std::size_t values,
                          std::size_t triangles) {
    const auto tile_bytes = [&](const LightFieldGrid& grid, const HogelRange& region) {
        return static_cast<double>(values * grid.directions()) * static_cast<double>(region.hogels()) * sizeof(float);
    };
    const HogelRange region = face.preferred_tile();
    const bool finely = request.samples.count() > 1;
    const LightFieldGrid grid = finely ? finer(face.grid(), request.samples) : face.grid();
    const HogelRange part =
        finely ? HogelRange{0, 0, request.samples.hogel * region.ns, request.samples.hogel * region.nt} : region;
    const RendererInfo& renderer = renderers().find(request.renderer);
    RenderCost cost = renderer.cost ? renderer.cost(grid, part, triangles) : RenderCost();
    if (request.interpolate > 0) cost.bytes *= 2;  // colours beside depths
    cost.bytes += tile_bytes(face.grid(), region) + (finely ? tile_bytes(grid, part) : 0);
    return cost;
}

// Whether a model of shading computes light where rays hit. How long that takes depends on lamps, textures and how many
// points the cache keeps, of which nothing was measured that would hold for other scenes.
bool is_shaded_at_samples(const std::string& model) { return model == "direct" || model == "shadowed"; }

}  // namespace

Plan plan_light_field(const LightField& rendered, const LightFieldRequest& request, std::size_t triangles,
                      const LightFieldFileOptions& file) {
    Plan plan;
    for (const LightField::Source& face : rendered.faces()) {
        const LightFieldGrid& grid = face->grid();
        const std::size_t values = grid.channels + (file.with_depth ? 1 : 0);
        const HogelRange region = face->preferred_tile();
        const std::size_t regions =
            ((grid.hogels_s + region.ns - 1) / region.ns) * ((grid.hogels_t + region.nt - 1) / region.nt);
        const auto at_once = static_cast<double>(std::min(thread_count(), regions)),
                   count = static_cast<double>(triangles);
        const RenderCost cost = cost_of_region(*face, request, values, triangles);
        plan.memory = std::max(plan.memory, at_once * cost.bytes + count * cost.bytes_a_triangle);
        const double rays = static_cast<double>(grid.directions()) * static_cast<double>(grid.hogels());
        const std::size_t sample = file.type == SampleType::half ? 2 : 4;
        plan.disk += rays * static_cast<double>(grid.channels * sample + (file.with_depth ? sizeof(float) : 0));
        const double each = seconds_a_ray + seconds_a_ray_and_million_triangles * 1e-6 * count;
        plan.seconds += on_all_threads(rays * static_cast<double>(request.samples.count()) * each *
                                       renderers().find(request.renderer).time_of_a_ray) +
                        cost.rays * static_cast<double>(regions) * seconds_a_ray / at_once;
    }
    if (is_shaded_at_samples(request.shading.model)) plan.seconds = 0;
    return plan;
}

double hologram_samples(std::span<const LightFieldGrid> faces, const HologramRequest& request) {
    double samples = 0;
    for (const Channel& channel : request.channels)
        samples += static_cast<double>(hologram_grid(faces, request.options(channel, faces)).plane.samples());
    return samples;
}

Plan plan_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                    const HologramFileOptions& file) {
    const double samples = hologram_samples(faces, request);
    Plan plan;
    plan.disk = samples * (file.type == SampleType::half ? 4 : 8);
    plan.seconds = on_all_threads(samples * seconds_a_sample);
    // Tiles of complex samples that are in progress, with their rays; for each frequency of a hogel its directions and
    // their weights; and on every thread a hogel's moduli, its transform and its samples.
    constexpr double tiles = 4 * double{1 << 24}, table = 52, transform = 28;
    const auto hogels = static_cast<double>(std::max<std::size_t>(faces.front().hogels(), 1));
    const double hogel =
        static_cast<double>(hologram_grid(faces, request.options(request.channels.front(), faces)).plane.samples()) /
        hogels;
    const auto threads = static_cast<double>(thread_count());
    plan.memory = threads * tiles + hogel * (table + std::min(threads, hogels) * transform);
    return plan;
}

Plan plan_ray_photographs(std::span<const LightFieldGrid> faces, std::span<const Camera> cameras,
                          const RayPhotographOptions& options) {
    Plan plan;
    double hogels = 0;
    for (const LightFieldGrid& face : faces) hogels += static_cast<double>(face.hogels());
    const auto points = static_cast<double>(std::max<std::size_t>(options.pupil_samples, 1));
    for (const Camera& camera : cameras) {
        const auto pixels = static_cast<double>(camera.picture.samples());
        const double rays = points * static_cast<double>(lightfield::bytes_of_rays(faces.front(), camera));
        const std::size_t most = lightfield::max_kept_rays / cameras.size();
        const bool are_kept = rays <= static_cast<double>(most);
        plan.memory += points * bytes_a_lens_point +
                       pixels * static_cast<double>(faces.front().channels) * sizeof(float) + (are_kept ? rays : 0);
        plan.seconds += on_all_threads(points * (hogels * seconds_a_seen_hogel + pixels * seconds_a_seen_pixel));
    }
    // Blocks of hogels that are being read.
    constexpr double block = 64 << 20;
    plan.memory += (static_cast<double>(thread_count()) + 1) * block;
    return plan;
}

namespace {

// Maximum bytes of the file: a quantiser alone needs one bit per 6.02 dB.
double compressed_bytes(const LightField& light_field, const CompressionTarget& target) {
    const double samples = light_field.samples();
    if (const auto* rate = std::get_if<PixelsPerBit>(&target)) {
        // Rules meet the rate approximately; that of whole bit planes misses it by up to a factor of two.
        const double may_exceed = rate->rule == RateRule::search ? 1 : 2;
        return may_exceed * samples / static_cast<double>(light_field.grid().channels) / 8 / rate->rate;
    }
    if (const auto* sqnr = std::get_if<Sqnr>(&target)) return samples * (sqnr->decibels / 6.02 + 0.5) / 8;
    return samples * sizeof(float);
}

}  // namespace

Plan plan_compression(const LightField& light_field, const CompressionOptions& options) {
    const LightFieldGrid& grid = light_field.grid();
    const bool exact =
        std::holds_alternative<MaxError>(options.target) || std::holds_alternative<Lossless>(options.target);
    CodingMethod method = exact ? CodingMethod() : options.method;
    const CoderInfo& info = coders().find(method.coder);
    if (method.transform.empty()) method.transform = info.transform;
    const auto coder = info.make(method, grid, {});
    HogelRange tile = options.tile.value_or(coder->preferred_tile(grid));
    tile.ns = std::min(tile.ns, grid.hogels_s);
    tile.nt = std::min(tile.nt, grid.hogels_t);
    const double tiles = std::ceil(static_cast<double>(grid.hogels()) / static_cast<double>(tile.hogels()));
    const double at_once =
        std::min(tiles, static_cast<double>(std::min<std::size_t>(coder->max_at_once(), thread_count())));
    // A tile, its prediction, its residual and its coefficients, for each of the tiles in progress.
    constexpr double arrays = 4;
    const double tile_samples = static_cast<double>(tile.hogels() * grid.directions() * grid.channels);
    Plan plan;
    plan.memory = arrays * at_once * tile_samples * sizeof(float);
    plan.disk = compressed_bytes(light_field, options.target);
    if (options.with_depth) plan.disk += light_field.samples() / static_cast<double>(grid.channels) * sizeof(float);
    plan.seconds = on_all_threads(light_field.samples() * seconds_a_coded_sample);
    return plan;
}

Plan plan_propagation(std::span<const FieldGrid> fields, double distance, const PropagateOptions& options) {
    Plan plan;
    for (const FieldGrid& field : fields) {
        const PropagationMethod method = propagation_method(field, distance, options);
        const bool in_file = method.bytes > static_cast<double>(options.scratch.memory);
        const double result =
            static_cast<double>(options.output.value_or(field.plane).samples()) * sizeof(std::complex<float>);
        // Besides the work array, every thread transforms sixteen lines at a time, padded to about three times their
        // frequencies. Pages of a file stay in memory where there is room, but the system may take that back.
        const double lines = 3 * 16 * static_cast<double>(std::max(method.frequencies_x, method.frequencies_y)) *
                             sizeof(std::complex<float>) * static_cast<double>(thread_count());
        plan.memory =
            std::max(plan.memory, std::min(method.bytes, static_cast<double>(options.scratch.memory)) + lines);
        plan.disk += result + (in_file ? method.bytes : 0);
        plan.seconds += on_all_threads(method.operations * seconds_a_propagation_operation);
    }
    return plan;
}

Plan plan_bake(const Scene& scene, const BakeOptions& options) {
    const double triangles = static_cast<double>(triangle_count(scene)) * static_cast<double>(options.tessellation) *
                             static_cast<double>(options.tessellation);
    double vertices = 0;
    for (const Mesh& mesh : scene.meshes) vertices += static_cast<double>(mesh.positions.size());
    Plan plan;
    plan.memory = triangles * bytes_a_baked_triangle;
    plan.disk = triangles * file_bytes_a_baked_triangle;
    plan.seconds = on_all_threads(vertices * static_cast<double>(options.rays) *
                                  (1 + static_cast<double>(options.bounces) / 8) * seconds_a_gathered_ray);
    return plan;
}

void require_resources(const Plan& plan, const std::string& what, const std::filesystem::path& file) {
    if (const double available = core::available_memory(); plan.memory > available)
        throw Error(ErrorCode::usage, fmt::format("{} takes {} of memory; expected at most the {} that are free", what,
                                                  format_bytes(plan.memory), format_bytes(available)));
    if (file.empty()) return;
    std::error_code none;
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    const auto space = std::filesystem::space(folder, none);
    if (!none && plan.disk > static_cast<double>(space.available))
        throw Error(ErrorCode::cannot_write,
                    fmt::format("{}: takes {} of disk, and {} are free", file.string(), format_bytes(plan.disk),
                                format_bytes(static_cast<double>(space.available))));
}

}  // namespace hogel
