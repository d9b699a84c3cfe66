// SPDX-License-Identifier: Apache-2.0
#include "view/hologram_viewable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>
#include <utility>

#include "hogel/error.h"
#include "hogel/pattern.h"
#include "hogel/pipeline.h"
#include "hogel/reconstruct.h"

namespace hogel::view {
namespace {

// Copies fields into memory if they fit, because every viewpoint reads them.
Fields read_into_memory(Fields fields, std::size_t memory, const Progress& progress) {
    double bytes = 0;
    for (const auto& field : fields)
        bytes += static_cast<double>(field->looks() * field->grid().plane.samples() * sizeof(std::complex<float>));
    for (std::size_t c = 0; c < fields.size(); ++c) {
        const auto& source = fields[c];
        if (source->looks() > 1 || bytes > 0.5 * static_cast<double>(memory)) continue;
        auto field = std::make_shared<Field>(source->grid());
        copy(*source, *field, 0, progress.part(c, fields.size()));
        field->set_provenance(source->provenance());
        fields[c] = std::move(field);
    }
    return fields;
}

Region region_around(const Grid& plane, double x, double y, std::size_t side) {
    const auto first = [side](double middle, std::size_t count) {
        const double max_first = static_cast<double>(count) - static_cast<double>(std::min(side, count));
        return static_cast<std::size_t>(
            std::clamp(std::round(middle - 0.5 * static_cast<double>(side)), 0.0, max_first));
    };
    return {first(plane.column(x), plane.width), first(plane.row(y), plane.height), std::min(side, plane.width),
            std::min(side, plane.height)};
}

bool is_inside_grid(const Grid& plane, double x, double y) {
    const double column = std::round(plane.column(x)), row = std::round(plane.row(y));
    return column >= 0 && row >= 0 && column < static_cast<double>(plane.width) &&
           row < static_cast<double>(plane.height);
}

// Returns the intensity, phase or real part of samples. The highest intensity becomes white.
Image samples_of(const Field& field, const std::string& what) {
    const auto samples = field.samples.view();
    if (what == "phase") return picture_of(samples, FieldQuantity::phase);
    if (what == "real") return picture_of(samples, FieldQuantity::real);
    Image picture = picture_of(samples);
    const std::span<float> pixels = picture.pixels.elements();
    const float brightest = *std::ranges::max_element(pixels);
    if (brightest > 0)
        for (float& value : pixels) value /= brightest;
    return picture;
}

// Returns the power spectrum with a Hann window, which suppresses the edges of the region.
Image spectrum_of(Field field) {
    const std::size_t width = field.grid().plane.width, height = field.grid().plane.height;
    const auto window = [](std::size_t i, std::size_t n) {
        const double s = std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
        return static_cast<float>(s * s);
    };
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) field.samples(y, x) *= window(x, width) * window(y, height);
    return logarithmic(picture_of(fourier_image(field, 1).samples.view()));
}

}  // namespace

HologramViewable::HologramViewable(Fields fields, std::size_t memory, const Progress& progress) {
    if (fields.size() != 1 && fields.size() != 3)
        throw Error(ErrorCode::bad_input,
                    fmt::format("has {} wavelengths; a photograph takes one or three", fields.size()));
    fields_ = read_into_memory(std::move(fields), memory, progress);
    measure(progress);
    waves_ = std::make_unique<Waves>([this] { return fields_; }, fields_.front()->looks(), memory, Progress());
    PictureQuery front;
    front.by = PictureMethod::waves;
    front.camera.resolution = {128, 0};
    exposure_ = automatic_exposure(Viewable::photograph(front, progress).picture);
}

// Estimates the mean and the maximum of |F|² from up to 256 rows of the first wavelength.
void HologramViewable::measure(const Progress& progress) {
    const Grid& plane = fields_.front()->grid().plane;
    constexpr std::size_t max_rows = 256;
    const std::size_t rows = std::min(max_rows, plane.height);
    Array<std::complex<float>, 2> row(Shape<2>{1, plane.width});
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < rows; ++i) {
        fields_.front()->read({0, (2 * i + 1) * plane.height / (2 * rows), plane.width, 1}, 0, row.view());
        for (const std::complex<float>& value : row.elements()) {
            sum += std::norm(value);
            largest = std::max(largest, static_cast<double>(std::norm(value)));
        }
        progress.report(0);
    }
    if (largest > 0) efficiency_ = sum / static_cast<double>(rows * plane.width) / largest;
}

double HologramViewable::width() const { return fields_.front()->grid().plane.size_x(); }
double HologramViewable::height() const { return fields_.front()->grid().plane.size_y(); }

nlohmann::ordered_json HologramViewable::facts() const {
    const FieldGrid& grid = fields_.front()->grid();
    // The diffraction angle at the sample pitch limits the viewpoints.
    const auto max_tangent = [&](double pitch) {
        const double sine = std::min(grid.wavelength / (2 * pitch), 0.95);
        return sine / std::sqrt(1 - sine * sine);
    };
    std::vector<double> wavelengths;
    for (const auto& field : fields_) wavelengths.push_back(field->grid().wavelength);
    return {{"kind", "hologram"},
            {"samples_x", grid.plane.width},
            {"samples_y", grid.plane.height},
            {"pitch_m", grid.plane.pitch_x},
            {"wavelengths_m", wavelengths},
            {"tan_half_u", max_tangent(grid.plane.pitch_x)},
            {"tan_half_v", max_tangent(grid.plane.pitch_y)},
            {"center_u", 0},
            {"center_v", 0},
            {"channels", fields_.size()},
            {"efficiency", efficiency_},
            {"encodings", encodings().names()},
            {"depth", false}};
}

Image HologramViewable::by_rays(const PictureQuery&, const Progress&) {
    throw Error(ErrorCode::usage, "by", "by: a hologram has no rays; use by=waves");
}

void HologramViewable::by_waves(const PictureQuery& query, std::size_t looks, const OnLooks& shown,
                                const Progress& progress) {
    const Camera camera = this->camera(query);
    for (const auto& field : fields_) require_light_towards(field->grid(), camera);
    waves_->photograph(camera, looks, query.preview, shown, progress);
}

Reading HologramViewable::read(const PictureQuery& query, const PickPoint& point) const {
    if (query.eyes > 0)
        return std::apply(
            [&](const PictureQuery& single, const PickPoint& single_point) { return read(single, single_point); },
            single_picture(query, point));
    Reading reading = ray_at(camera(query), point);
    if (!is_inside_grid(fields_.front()->grid().plane, reading.x, reading.y)) return reading;
    reading.inside = true;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::complex<float> sample = samples_around(reading, std::min(c, fields_.size() - 1), 1).samples(0, 0);
        reading.radiance[c] = std::norm(sample);
        if (c == 0) reading.phase = std::arg(sample);
    }
    return reading;
}

Field HologramViewable::samples_around(const Reading& point, std::size_t colour, std::size_t side) const {
    const FieldSource& source = *fields_[std::min(colour, fields_.size() - 1)];
    const Region region = region_around(source.grid().plane, point.x, point.y, side);
    Field field({part(source.grid().plane, region), source.grid().wavelength});
    source.read(region, 0, field.samples.view());
    return field;
}

double HologramViewable::focus(const PictureQuery& query, const PickPoint& point, const Progress& progress) {
    if (query.eyes > 0)
        return std::apply([&](const PictureQuery& single,
                              const PickPoint& single_point) { return focus(single, single_point, progress); },
                          single_picture(query, point));
    constexpr std::size_t side = 256,
                          planes = 96;  // samples of the region; depths over the range of the entire hologram
    const Field field = samples_around(ray_at(camera(query), point), 0, side);
    const FocusSearch search = hogel::find_focus(field, search_options(planes), progress);
    for (const FocusPlane& plane : search.planes)
        if (plane.depth > -0.9 * query.camera.eye.z) return plane.depth;
    throw Error(ErrorCode::usage,
                "no depth is in focus at this point; see the sharpness plot for depths of the entire hologram");
}

FocusSearch HologramViewable::find_focus(const Progress& progress) {
    constexpr std::size_t planes = 192;  // coarser than the depth of focus; the search refines around peaks
    return hogel::find_focus(fields_, search_options(planes), progress);
}

LevelCounts HologramViewable::count_levels(const std::string& encoding, const Progress& progress) {
    constexpr std::size_t side = 1024;
    const Grid& plane = fields_.front()->grid().plane;
    const EncodingInfo& row = encodings().find(encoding);
    PatternOptions options;
    options.encoding = row.encoding;
    options.modulator = {"", std::min(side, plane.width), std::min(side, plane.height), plane.pitch_x, 256};
    const Pattern pattern = encode_pattern(*fields_.front(), options, progress);
    LevelCounts levels{row.name, {}, options.modulator.width, options.modulator.height, pattern.efficiency};
    for (const std::uint16_t level : pattern.levels.elements()) ++levels.counts[level];
    return levels;
}

// Depths up to N pitch²/λ, where sample pitch and aperture limit the resolution equally, in at most `planes` planes.
FocusOptions HologramViewable::search_options(std::size_t planes) const {
    const FieldGrid& grid = fields_.front()->grid();
    const std::size_t side = std::max(grid.plane.width, grid.plane.height);
    const double pitch = std::max(grid.plane.pitch_x, grid.plane.pitch_y);
    const double max_depth = static_cast<double>(side) * pitch * pitch / grid.wavelength;
    return {.from = -max_depth, .to = max_depth, .planes = std::clamp<std::size_t>(side, 8, planes)};
}

Photograph HologramViewable::inside(const PictureQuery& query, const PickPoint& point, const InsideQuery& inside,
                                    const Progress&) {
    if (query.eyes > 0) {
        const auto [single, single_point] = single_picture(query, point);
        return this->inside(single, single_point, inside, {});
    }
    if (std::ranges::count(std::to_array<std::string_view>({"intensity", "phase", "real", "spectrum"}), inside.what) ==
        0)
        throw Error(ErrorCode::usage, fmt::format("what: '{}' is not intensity, phase, real or spectrum", inside.what));
    Field field = samples_around(ray_at(camera(query), point), inside.colour, inside.side);
    return {inside.what == "spectrum" ? spectrum_of(std::move(field)) : samples_of(field, inside.what), 1, 0, {}};
}

}  // namespace hogel::view
