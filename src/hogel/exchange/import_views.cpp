// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>

#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/exchange/densify.h"
#include "hogel/exchange/geometry.h"
#include "hogel/exchange/parallax.h"
#include "hogel/exchange/rectified.h"
#include "hogel/exchange/sparse_views.h"
#include "hogel/exchange/view_light_field.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace exchange {
namespace {

constexpr std::size_t max_densify = 64;

// Returns the disparity maps of a set, or an estimate if the options allow it.
std::shared_ptr<const Disparities> disparities_of(const std::filesystem::path& source, const ViewSet& set,
                                                  const ViewImportOptions& options, std::vector<std::string>& notes) {
    if (!(options.depth_scale >= 0 && std::isfinite(options.depth_scale)))
        throw Error(ErrorCode::usage, "depth_scale",
                    fmt::format("the scale of depth is {}, but must be positive and finite", options.depth_scale));
    const double map_bytes = static_cast<double>(set.width * set.height) * sizeof(float);
    const auto kept = static_cast<std::size_t>(std::clamp(options.memory / map_bytes, 16.0, 1e4));
    if (options.mirror_columns || options.mirror_rows)
        throw Error(ErrorCode::usage, "mirror", "disparity maps cannot be used with mirrored views");
    std::error_code none;
    if (std::filesystem::is_directory(source, none) || source.extension() == ".json")
        if (auto disparities = find_disparities(source, set, kept, options.depth_scale)) return disparities;
    if (!options.estimate_disparity)
        throw Error(
            ErrorCode::usage, "estimate_disparity",
            fmt::format("views are interpolated, and rays get depth, by disparity, and {} has no map of it; it can be "
                        "estimated",
                        source.string()));
    const ParallaxEvidence evidence = parallax_of(set);
    notes.emplace_back("the disparity was estimated from the views");
    return estimated_disparities(set, 1.5 * std::max(evidence.across, evidence.down / set.geometry.spacing_ratio) + 1,
                                 kept);
}

void densify(const ViewImportOptions& options, const std::shared_ptr<const Disparities>& disparities, ViewSet& set,
             Placement& placement) {
    const std::size_t before = set.rows * set.columns;
    set = densified(std::move(set), disparities, options.densify, options.memory);
    densify(placement, options.densify);
    validate(placement.grid, ErrorCode::usage, set.layout);
    const std::size_t views = set.rows * set.columns;
    set.notes.push_back(fmt::format("{} of {} views are interpolated between those of the set by {}", views - before,
                                    views, disparities->origin()));
}

// Adds a note if vignetting of a light field camera darkens the corner views.
void note_dark_corners(ViewSet& set) {
    if (set.rows < 5 || set.columns < 5) return;
    constexpr double dark = 0.5;
    const auto mean = [&](std::size_t row, std::size_t column) {
        const Array<float, 2> grey = grey_view(set, row, column);
        double sum = 0;
        for (const float value : grey.elements()) sum += value;
        return sum / static_cast<double>(grey.size());
    };
    const double middle = mean(set.rows / 2, set.columns / 2);
    for (const std::size_t row : {std::size_t{0}, set.rows - 1})
        for (const std::size_t column : {std::size_t{0}, set.columns - 1})
            if (const double corner = mean(row, column); corner < dark * middle) {
                set.notes.push_back(fmt::format(
                    "views at the rim are dark: {} has {:.0f} % of the middle view's mean; the middle {}x{} or fewer "
                    "can be taken alone",
                    set.pictures->name(row, column), 100 * corner / middle, set.columns - 2, set.rows - 2));
                return;
            }
}

}  // namespace
}  // namespace exchange

ImportedViews import_views(const std::filesystem::path& source, const ViewImportOptions& options,
                           const Progress& progress) {
    using namespace exchange;
    const core::StopScope scope(progress);
    ViewSet set = open_views(source, options);
    Placement placement = place(set, options);
    const Transfer transfer = options.transfer.value_or(set.bits == 32 ? Transfer::linear : Transfer::srgb);
    const ParallaxEvidence evidence = parallax_of(set, options.disparity);
    require_rectified(set, options.disparity == 0 ? evidence : parallax_of(set));
    note_dark_corners(set);
    if (options.densify < 1 || options.densify > max_densify)
        throw Error(
            ErrorCode::usage, "densify",
            fmt::format("views can be densified by factors from 1 to {}, not by {}", max_densify, options.densify));
    std::shared_ptr<const Disparities> disparities;
    if (options.densify > 1 || options.with_depth) disparities = disparities_of(source, set, options, set.notes);
    const bool estimated = disparities != nullptr && disparities->is_estimate();
    if (options.densify > 1) densify(options, disparities, set, placement);
    const double parallax = std::max(evidence.across, evidence.down) / static_cast<double>(options.densify);
    Provenance provenance;
    provenance.entries = {{"views", set.layout},
                          {"views bits", fmt::format("{}", set.bits)},
                          {"views transfer", transfer_names()[static_cast<std::size_t>(transfer)]}};
    std::string summary = describe(set, placement, parallax);
    std::vector<std::string> notes = set.notes;
    if (parallax > 1) std::ranges::copy(sparse_views(placement.grid, parallax), std::back_inserter(notes));
    set.pictures->forget();
    const std::string layout = set.layout;
    const std::size_t columns = set.columns, rows = set.rows;
    const unsigned bits = set.bits;
    auto views = std::make_shared<ViewLightField>(std::move(set), placement, transfer, options.memory, options.spool);
    const double spool_bytes = options.spool.empty() ? 0 : views->spool_bytes();
    if (options.with_depth) views->set_depth(std::move(disparities), options.densify, options.disparity);
    LightField light_field(std::move(views));
    return {light_field.with(std::move(provenance)),
            layout,
            columns,
            rows,
            bits,
            transfer,
            placement.spacing,
            placement.distance,
            placement.scale,
            parallax,
            estimated,
            spool_bytes,
            std::move(summary),
            placement.assumed,
            std::move(notes)};
}

Plan plan_import(const ImportedViews& views, const ViewImportOptions& options, const LightFieldFileOptions& file) {
    namespace rates = core::rates;
    const LightFieldGrid& grid = views.light_field.grid();
    const double samples = grid.samples(), stored = views.bits <= 8 ? 1 : views.bits <= 16 ? 2 : 4;
    const HogelRange tile = views.light_field.front().preferred_tile();
    const double tile_bytes = static_cast<double>(tile.hogels() * grid.directions() * grid.channels) * sizeof(float);
    const double picture = static_cast<double>(grid.hogels() * grid.channels) * stored;
    // Without a spool file, each band decodes all pictures again.
    const double bands = views.spool_bytes > 0 ? 1 : std::max(1.0, samples * stored / options.memory);
    Plan plan;
    plan.memory =
        std::min(samples * stored, options.memory) + static_cast<double>(thread_count()) * (2 * picture + tile_bytes);
    plan.disk = samples * (file.type == SampleType::half ? 2 : 4) + views.spool_bytes;
    const auto densified = static_cast<double>(options.densify * options.densify);
    if (options.densify > 1 || options.with_depth)  // disparity maps, and pictures of the set
        plan.memory += std::min(samples / static_cast<double>(grid.channels) * sizeof(float), options.memory) +
                       std::min(samples / densified * stored, options.memory);
    plan.seconds = rates::on_all_threads(samples * bands *
                                         (rates::imported_sample + rates::interpolated_sample * (1 - 1 / densified)));
    return plan;
}

void write_views(const LightField& light_field, LightFieldSink& sink, const Progress& progress) {
    using namespace exchange;
    const core::StopScope scope(progress);
    const auto* views = dynamic_cast<const ViewLightField*>(&light_field.front());
    if (views == nullptr) return copy(light_field.front(), sink, progress);
    const LightFieldGrid& grid = views->grid();
    for (std::size_t t = 0; t < grid.hogels_t; t += views->band_rows()) {
        const std::size_t rows = std::min(views->band_rows(), grid.hogels_t - t);
        const HogelRange tile_size = views->preferred_tile();
        const std::size_t tiles = (rows + tile_size.nt - 1) / tile_size.nt;
        std::atomic<std::size_t> done = 0;
        work::parallel_for(tiles, [&](std::size_t i) {
            const std::size_t t0 = t + i * tile_size.nt;
            const HogelRange range{0, t0, grid.hogels_s, std::min(tile_size.nt, t + rows - t0)};
            if (!sink.has_already(range)) {
                LightFieldTile tile(grid, range, views->has_depth() && sink.wants_depth());
                views->read(tile);
                sink.write(tile);
            }
            ++done;
        });
        progress.report(static_cast<double>(t + rows) / static_cast<double>(grid.hogels_t));
    }
    sink.finish();
}

}  // namespace hogel
