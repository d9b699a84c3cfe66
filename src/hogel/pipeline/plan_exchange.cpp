// SPDX-License-Identifier: Apache-2.0
// Resources of reading and writing sets of views.
#include <algorithm>

#include "hogel/pipeline/plan_rates.h"

namespace hogel {
namespace {

// Processor seconds a sample of the light field: reading and decoding PNG files, and writing half floats; and encoding
// PNG files. Measured with 81 photographs of 960x640 (docs/exchange.md).
constexpr double seconds_an_imported_sample = 15e-9, seconds_an_exported_sample = 150e-9;
// One of a view between views: a set of 9x9 views of 512x512 pixels made 17x17.
constexpr double seconds_an_interpolated_sample = 80e-9;

}  // namespace

Plan plan_import(const ImportedViews& views, const ViewOptions& options, const LightFieldFileOptions& file) {
    const LightFieldGrid& grid = views.light_field.grid();
    const double samples = grid.samples(), stored = views.bits <= 8 ? 1 : views.bits <= 16 ? 2 : 4;
    const HogelRange tile = views.light_field.front().preferred_tile();
    const double tile_bytes = static_cast<double>(tile.hogels() * grid.directions() * grid.channels) * sizeof(float);
    const double picture = static_cast<double>(grid.hogels() * grid.channels) * stored;
    // Without a spool file each band decodes all pictures again.
    const double bands = views.spool_bytes > 0 ? 1 : std::max(1.0, samples * stored / options.memory);
    Plan plan;
    plan.memory =
        std::min(samples * stored, options.memory) + static_cast<double>(thread_count()) * (2 * picture + tile_bytes);
    plan.disk = samples * (file.type == SampleType::half ? 2 : 4) + views.spool_bytes;
    const auto densified = static_cast<double>(options.densify * options.densify);
    if (options.densify > 1 || options.with_depth)  // maps of disparity, and pictures of the set
        plan.memory += std::min(samples / static_cast<double>(grid.channels) * sizeof(float), options.memory) +
                       std::min(samples / densified * stored, options.memory);
    plan.seconds = on_all_threads(samples * bands *
                                  (seconds_an_imported_sample + seconds_an_interpolated_sample * (1 - 1 / densified)));
    return plan;
}

Plan plan_export(const LightField& light_field, const ViewExportOptions& options) {
    const double samples = light_field.grid().samples();
    Plan plan;
    plan.memory = std::min(samples * sizeof(float), options.memory) * 1.5;
    if (options.layout == "mat" || options.layout == "quilt") plan.memory += samples * 4;  // are written at once
    plan.disk = samples * (options.bits == 0 || options.bits <= 8 ? 1 : 2);
    plan.seconds = on_all_threads(samples * seconds_an_exported_sample);
    return plan;
}

}  // namespace hogel
