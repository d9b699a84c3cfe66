// SPDX-License-Identifier: Apache-2.0
// Outputs other than light fields and holograms, and checks of outputs before work begins.
#include <fmt/format.h>

#include <chrono>

#include "hogel/core/output_file.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace {

// Copies the directions of one hogel of a row to a column of a picture.
void paste(const LightFieldTile& row, std::size_t hogel, Image& picture, std::size_t column) {
    const auto& radiance = row.radiance;
    for (std::size_t c = 0; c < radiance.extent(0); ++c)
        for (std::size_t v = 0; v < radiance.extent(3); ++v)
            for (std::size_t u = 0; u < radiance.extent(4); ++u)
                picture.pixels(v, column + u, c) = radiance(c, 0, hogel, v, u);
}

}  // namespace

std::vector<std::filesystem::path> write_printer_images(const std::filesystem::path& folder, const LightField& rays,
                                                        const PrinterImageOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    const LightField light_field = with_common_directions(rays);  // the optics are the same for all hogels
    if (!(options.exposure > 0)) throw Error(ErrorCode::usage, "exposure", "exposure: a positive number was expected");
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t pictures = options.rows ? grid.hogels_t : grid.hogels();
    const std::size_t digits = std::to_string(pictures).size();
    const auto name = [&](std::size_t i) {
        return fmt::format("{}_{:0{}}.png", options.rows ? "row" : "hogel", i + 1, digits);
    };
    // Returns the index of the i-th printed hogel of a row.
    const auto hogel_at = [&](std::size_t i, std::size_t row) {
        return options.serpentine && row % 2 == 1 ? grid.hogels_s - 1 - i : i;
    };
    core::write_set(folder, [&](const std::filesystem::path& temporary) {
        for (std::size_t t = 0; t < grid.hogels_t; ++t) {
            progress.report(static_cast<double>(t) / static_cast<double>(grid.hogels_t));
            LightFieldTile row(grid, {0, t, grid.hogels_s, 1}, false);
            light_field.front().read(row);
            if (options.rows) {
                Image picture(grid.hogels_s * grid.directions_u, grid.directions_v, grid.channels);
                for (std::size_t i = 0; i < grid.hogels_s; ++i)
                    paste(row, hogel_at(i, t), picture, i * grid.directions_u);
                write_image(temporary / name(t), picture, options.exposure,
                            with_history(options.metadata, to_metadata(light_field.provenance())));
                continue;
            }
            work::parallel_for(grid.hogels_s, [&](std::size_t i) {
                Image picture(grid.directions_u, grid.directions_v, grid.channels);
                paste(row, hogel_at(i, t), picture, 0);
                write_image(temporary / name(t * grid.hogels_s + i), picture, options.exposure);
            });
        }
    });
    std::vector<std::filesystem::path> names;
    for (std::size_t i = 0; i < pictures; ++i) names.push_back(folder / name(i));
    return names;
}

void require_writable(const std::filesystem::path& file, std::span<const std::string> inputs) {
    core::require_target(file);
    std::error_code error;
    for (const std::string& input : inputs)
        if (std::filesystem::equivalent(file, input, error))
            throw Error(
                ErrorCode::usage,
                fmt::format("{}: is an input, which the output would replace; expected another name", file.string()));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    core::write_file(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

std::string describe_input(const std::string& name) {
    std::error_code error;
    const auto size = std::filesystem::file_size(name, error);
    if (error) return name;
    const auto date = std::filesystem::last_write_time(name, error).time_since_epoch();
    return fmt::format("{}, {} bytes, {} ns", name, size, std::chrono::nanoseconds(date).count());
}

std::string describe_input(const std::string& name, const Scene& scene) {
    return fmt::format("{} showing {:08x}", name, checksum(scene));
}

}  // namespace hogel
