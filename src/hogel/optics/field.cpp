// SPDX-License-Identifier: Apache-2.0
#include "hogel/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/core/object_pool.h"
#include "hogel/core/parallel.h"
#include "hogel/core/shared_tiles.h"

namespace hogel {
namespace {

constexpr std::size_t region_side = 1024;  // 8 MiB of samples
constexpr std::size_t max_samples = (std::numeric_limits<std::size_t>::max() >> 1) / sizeof(std::complex<float>);

void require_positive(double value, ErrorCode code, const std::string& what, const char* member) {
    if (!(std::isfinite(value) && value > 0))
        throw Error(code, fmt::format("{}: {} is {}, but must be positive and finite", what, member, value));
}

// The largest multiple of `alignment` up to region_side, at least one.
std::size_t aligned_side(std::size_t alignment) {
    return std::max(region_side / alignment, std::size_t{1}) * alignment;
}

// A multiple of `alignment` rows with about as many samples as a square region.
std::size_t aligned_rows(std::size_t alignment, std::size_t width) {
    return std::max(region_side * region_side / (alignment * width), std::size_t{1}) * alignment;
}

}  // namespace

void validate(const FieldGrid& grid, ErrorCode code, const std::string& what) {
    const Grid& plane = grid.plane;
    if (plane.width == 0 || plane.height == 0)
        throw Error(code,
                    fmt::format("{}: {}x{} samples, but at least 1x1 are needed", what, plane.width, plane.height));
    require_positive(grid.wavelength, code, what, "the wavelength");
    require_positive(plane.pitch_x, code, what, "the pitch in x");
    require_positive(plane.pitch_y, code, what, "the pitch in y");
    require_positive(plane.size_x(), code, what, "the width");
    require_positive(plane.size_y(), code, what, "the height");
    if (!std::isfinite(plane.center_x) || !std::isfinite(plane.center_y))
        throw Error(code, fmt::format("{}: its centre ({}, {}) is not finite", what, plane.center_x, plane.center_y));
    if (plane.width > max_samples / plane.height)
        throw Error(code,
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
    const std::size_t side = aligned_side(source.alignment());
    // Whole rows are contiguous in memory, so regions of whole rows can be read directly into the sink.
    const View<std::complex<float>, 2> whole = sink.in_memory();
    const bool in_place = whole.size() > 0;
    const std::size_t width = in_place ? plane.width : side,
                      height = in_place ? aligned_rows(source.alignment(), plane.width) : side;
    const std::size_t across = (plane.width + width - 1) / width, down = (plane.height + height - 1) / height;
    core::ObjectPool<Array<std::complex<float>, 1>> scratch_pool;
    const auto shared = dynamic_cast<core::SharedSink*>(&sink);
    core::for_each_tile(across * down, shared, progress, [&](std::size_t i) {
        Region region{(i % across) * width, (i / across) * height, width, height};
        region.width = std::min(region.width, plane.width - region.x0);
        region.height = std::min(region.height, plane.height - region.y0);
        if (in_place) {
            source.read(region, look, {&whole(region.y0, 0), {region.height, region.width}});
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
