// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bench/measure.h"
#include "bench/render/render.h"
#include "hogel/renderer.h"
#include "hogel/units.h"

namespace hogel::bench {
namespace {

struct Rendered {
    LightFieldTile tile;
    double milliseconds = 0;  // per hogel
};

// Renders a square of hogels, and measures the processor time of this thread.
Rendered render(const LightFieldSource& source, std::size_t side) {
    Rendered result{LightFieldTile(source.grid(), {0, 0, side, side}, false)};
    const double began = thread_seconds();
    source.read(result.tile);
    result.milliseconds = 1e3 * (thread_seconds() - began) / static_cast<double>(side * side);
    return result;
}

struct Error2 {
    double psnr = 0, sqnr = 0, differing = 0;
};

// Computes [K] (4.7) and (4.8) with the largest value as peak, and the fraction of values off by more than peak/64.
Error2 error(const LightFieldTile& exact, const LightFieldTile& approximate) {
    double peak = 0, energy = 0, squares = 0, differing = 0;
    for (const float value : exact.radiance.elements()) peak = std::max(peak, double{value});
    for (std::size_t i = 0; i < exact.radiance.size(); ++i) {
        const double value = exact.radiance.data()[i], difference = approximate.radiance.data()[i] - value;
        energy += value * value;
        squares += difference * difference;
        differing += std::abs(difference) > peak / 64 ? 1 : 0;
    }
    const auto count = static_cast<double>(exact.radiance.size());
    return {10 * std::log10(peak * peak * count / squares), 10 * std::log10(energy / squares), differing / count};
}

void measure_scene(const std::string& name, const RenderOptions& options, const Session& session) {
    const std::size_t side = options.max_side.value_or(16);
    LightFieldOptions light_field = options.light_field(render_defaults.dense_across, render_defaults.directions);
    light_field.cache_spacing = 0;
    light_field.across = light_field.hogels.columns;
    light_field.hogels = {side, side};
    const LightFieldGrid grid = light_field.grid();
    for (const std::string shading : {"vertex", "shadowed", "direct"}) {
        if (!options.shading.empty() && shading != options.shading) continue;
        light_field.shading = shading;
        // The scene stays as large as the whole hologram.
        const auto scene = bench_scene(session, name, light_field);
        const Rendered exact = render(*make_renderer("simplex", scene, grid), side);
        for (std::size_t region = side; region >= 2; region /= 2) {
            stop_if_interrupted();
            const Rendered approximate = render(*make_interpolating_renderer(scene, grid, region), side);
            const Error2 deviation = error(exact.tile, approximate.tile);
            fmt::print("| {}, {} triangles | {} | {} | {:.1f} | {:.1f} | {:.2f} % | {:.3g} | {:.3g} |\n", name,
                       scene->triangles.size(), shading, region, deviation.psnr, deviation.sqnr,
                       100 * deviation.differing, exact.milliseconds, approximate.milliseconds);
            std::fflush(stdout);
        }
    }
}

}  // namespace

void measure_interpolation(const RenderOptions& options, const Session& session) {
    const LightFieldOptions light_field = options.light_field(render_defaults.dense_across, render_defaults.directions);
    const LightFieldGrid grid = light_field.grid();
    fmt::print(
        "{}x{} directions over {:.4g} degrees, hogels {} apart; processor time of one core.\n\n"
        "| scene | shading | region | PSNR, dB | SQNR, dB | differ | `simplex`, ms a hogel | interpolated |\n"
        "|---|---|---|---|---|---|---|---|\n",
        grid.directions_u, grid.directions_v, light_field.field_of_view.across * 180 / std::numbers::pi,
        format_length(grid.pitch));
    for (const std::string& name :
         options.scenes.empty() ? std::vector<std::string>{"pumpkin", "church"} : options.scenes)
        measure_scene(name, options, session);
}

}  // namespace hogel::bench
