// SPDX-License-Identifier: Apache-2.0
#include "hogel/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/core/object_pool.h"
#include "hogel/core/require_positive.h"
#include "hogel/core/stop_scope.h"
#include "hogel/units.h"
#include "hogel/work/shared_tiles.h"

namespace hogel {
namespace {

constexpr std::size_t region_samples = std::size_t{1} << 20;  // 8 MiB
// Minimum number of rows of a region, so that a row of a narrow source is not a region.
constexpr std::size_t min_rows = 64;
constexpr std::size_t max_samples = (std::numeric_limits<std::size_t>::max() >> 1) / sizeof(std::complex<float>);

// A longer wavelength indicates a wrong unit.
constexpr double max_wavelength = 0.1e-3;

void require_wavelength(double wavelength, ErrorCode code, const std::string& what) {
    core::require_positive(wavelength, "wavelength", code, what, "the wavelength");
    if (wavelength <= max_wavelength) return;
    double nanometres = wavelength;
    while (nanometres < 100) nanometres *= 1000;
    throw Error(
        code, "wavelength",
        fmt::format("{}: the wavelength is {:g} m; expected at most {}: {:g} nanometres are {:g}nm, or in "
                    "programs {:g}*nm, {:g}e-9 metres",
                    what, wavelength, format_length(max_wavelength), nanometres, nanometres, nanometres, nanometres));
}

// Returns the largest multiple of `alignment` up to a number, at least `alignment`.
std::size_t aligned(std::size_t number, std::size_t alignment) {
    return std::max(number / alignment, std::size_t{1}) * alignment;
}

// Returns the size of the regions in which a field is copied. Long rows in a file are written much faster than short
// rows; overlapping samples are computed least often for a square.
// @param whole_rows  regions must be whole rows
Region copied_region(const FieldSource& source, bool whole_rows) {
    const std::size_t alignment = source.alignment(), width = source.grid().plane.width;
    if (whole_rows) return {0, 0, width, aligned(region_samples / width, alignment)};
    const std::size_t height =
        aligned(source.overlap() > 0 ? static_cast<std::size_t>(std::sqrt(region_samples)) : min_rows, alignment);
    return {0, 0, aligned(region_samples / height, alignment), height};
}

}  // namespace

void validate(const FieldGrid& grid, ErrorCode code, const std::string& what) {
    const Grid& plane = grid.plane;
    if (plane.width == 0 || plane.height == 0)
        throw Error(code, "size, pitch",
                    fmt::format("{}: {}x{} samples, but at least 1x1 are needed", what, plane.width, plane.height));
    require_wavelength(grid.wavelength, code, what);
    core::require_positive(plane.pitch_x, "pitch", code, what, "the pitch in x");
    core::require_positive(plane.pitch_y, "pitch", code, what, "the pitch in y");
    core::require_positive(plane.size_x(), "size, pitch", code, what, "the width");
    core::require_positive(plane.size_y(), "size, pitch", code, what, "the height");
    if (!std::isfinite(plane.center_x) || !std::isfinite(plane.center_y))
        throw Error(code, fmt::format("{}: its centre ({}, {}) is not finite", what, plane.center_x, plane.center_y));
    if (plane.width > max_samples / plane.height)
        throw Error(code, "size, pitch",
                    fmt::format("{}: {}x{} samples are more than can be addressed", what, plane.width, plane.height));
}

void validate(const Region& region, const FieldGrid& grid, const Shape<2>& array) {
    const Grid& plane = grid.plane;
    if (region.width == 0 || region.height == 0 || region.x0 >= plane.width || region.width > plane.width - region.x0 ||
        region.y0 >= plane.height || region.height > plane.height - region.y0)
        throw Error(ErrorCode::usage,
                    fmt::format("region of {}x{} samples at ({}, {}) is not inside a field of {}x{}", region.width,
                                region.height, region.x0, region.y0, plane.width, plane.height));
    if (array != Shape<2>{region.height, region.width})
        throw Error(ErrorCode::usage, fmt::format("an array of {}x{} samples was given for a region of {}x{}", array[1],
                                                  array[0], region.width, region.height));
}

const Provenance& FieldSource::provenance() const {
    static const Provenance unknown;
    return unknown;
}

Field::Field(const FieldGrid& grid) : grid_(grid) {
    validate(grid, ErrorCode::usage, "field");
    samples = Array<std::complex<float>, 2>({grid.plane.height, grid.plane.width});
}

void Field::read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const {
    validate(region, grid_, out.shape());
    if (look >= looks())
        throw Error(ErrorCode::usage, fmt::format("a field in memory has one look, but look {} was read", look));
    for (std::size_t y = 0; y < region.height; ++y)
        std::copy_n(&samples(region.y0 + y, region.x0), region.width, &out(y, 0));
}

void Field::write(const Region& region, View<const std::complex<float>, 2> values) {
    validate(region, grid_, values.shape());
    for (std::size_t y = 0; y < region.height; ++y)
        std::copy_n(&values(y, 0), region.width, &samples(region.y0 + y, region.x0));
}

void copy(const FieldSource& source, FieldSink& sink, std::size_t look, const Progress& progress) {
    const core::StopScope scope(progress);
    const Grid& plane = source.grid().plane;
    // Whole rows are contiguous in memory: the source can read them directly into the sink.
    const View<std::complex<float>, 2> destination = sink.in_memory();
    const bool in_place = destination.size() > 0;
    const Region tile = copied_region(source, in_place);
    const std::size_t across = (plane.width + tile.width - 1) / tile.width,
                      down = (plane.height + tile.height - 1) / tile.height;
    core::ObjectPool<Array<std::complex<float>, 1>> scratch_pool;
    const auto shared = dynamic_cast<work::SharedSink*>(&sink);
    work::for_each_tile(across * down, shared, progress, [&](std::size_t i) {
        Region region{(i % across) * tile.width, (i / across) * tile.height, tile.width, tile.height};
        region.width = std::min(region.width, plane.width - region.x0);
        region.height = std::min(region.height, plane.height - region.y0);
        if (in_place) {
            source.read(region, look, {&destination(region.y0, 0), {region.height, region.width}});
        } else if (!sink.has_already(region)) {
            auto scratch = scratch_pool.take();
            if (scratch->size() < region.samples()) *scratch = Array<std::complex<float>, 1>({region.samples()});
            const View<std::complex<float>, 2> values(scratch->data(), {region.height, region.width});
            source.read(region, look, values);
            sink.write(region, values);
        }
    });
    sink.finish();
}

}  // namespace hogel
