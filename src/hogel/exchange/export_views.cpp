// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/core/output_file.h"
#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/exchange/scaled_view.h"
#include "hogel/exchange/transfer.h"
#include "hogel/exchange/view_set.h"
#include "hogel/image.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace exchange {
namespace {

// Returns a property of the imported pictures; empty for other light fields.
std::string stored(const LightField& light_field, const std::string& key) {
    for (const auto& [name, text] : light_field.provenance().entries)
        if (name == key) return text;
    return {};
}

unsigned bits_for(const LightField& light_field, const ViewExportOptions& options, const std::string& format) {
    if (format == "pfm" || format == "exr") {
        if (options.bits != 0)
            throw Error(
                ErrorCode::usage, "bits, pictures",
                fmt::format("the format {} holds floating-point numbers, which have no choice of bits", format));
        return 32;
    }
    if (options.bits != 0) return options.bits;
    const std::string text = stored(light_field, "views bits");
    const int bits = text.empty() ? 8 : std::atoi(text.c_str());
    return bits >= 8 && bits <= 16                              ? static_cast<unsigned>(bits)
           : bits == 32 && (format == "npy" || format == "mat") ? 32
                                                                : 8;
}

// Returns the picture format: as requested, otherwise one that holds the bits of the imported set.
std::string format_for(const LightField& light_field, const ViewExportOptions& options) {
    static const std::vector<std::string> known{"png", "ppm", "pfm", "exr"};
    if (!options.format.empty()) {
        if (std::ranges::count(known, options.format) == 0)
            throw_unknown("picture format", options.format, known, "pictures");
        return options.format;
    }
    const std::string bits = options.bits != 0 ? fmt::format("{}", options.bits) : stored(light_field, "views bits");
    if (bits == "32") return "pfm";
    return bits.empty() || bits == "8" || bits == "16" ? "png" : "ppm";
}

Transfer transfer_for(const LightField& light_field, const ViewExportOptions& options, unsigned bits) {
    if (options.transfer) return *options.transfer;
    const std::string text = stored(light_field, "views transfer");
    const bool known = std::ranges::count(transfer_names(), text) > 0;
    const bool was_float = stored(light_field, "views bits") == "32";
    if (!known || was_float != (bits == 32)) return bits == 32 ? Transfer::linear : Transfer::srgb;
    return *transfer_named(text);
}

ViewGeometry geometry_of(const LightFieldGrid& grid) {
    ViewGeometry geometry;
    const FocalPlane* plane = grid.focal_plane();
    geometry.orthographic = plane == nullptr;
    geometry.spacing_ratio = grid.step_u() > 0 && grid.directions_v > 1 ? grid.step_v() / grid.step_u() : 1;
    if (plane == nullptr) {
        geometry.spacing = grid.step_u();
        return geometry;
    }
    geometry.distance = -plane->depth;
    geometry.spacing = grid.step_u() * geometry.distance;
    geometry.pixel_tangent = grid.pitch / geometry.distance;
    geometry.center_u = grid.center_u();
    geometry.center_v = grid.center_v();
    return geometry;
}

void require_views(const LightField& light_field, const ViewLayout& layout) {
    const LightFieldGrid& grid = light_field.grid();
    if (layout.create == nullptr)
        throw Error(ErrorCode::usage, "layout", fmt::format("the layout '{}' is read, but not written", layout.name));
    if (light_field.has_sides())
        throw Error(ErrorCode::usage, "layout",
                    "a hemicube cannot be exported as one set of views; export its front alone");
    if (grid.focal_plane() == nullptr && layout.cameras_only)
        throw Error(
            ErrorCode::usage, "layout",
            fmt::format("the layout '{}' is for cameras, but the directions of this light field are the same at all "
                        "hogels, which makes orthographic views; rows-columns and numbered hold these",
                        layout.name));
}

class Group {
  public:
    Group(const LightFieldGrid& grid, std::size_t first, std::size_t count)
        : grid_(grid), first_(first), views_(Shape<4>{count, grid.hogels_t, grid.hogels_s, grid.channels}) {}

    void add(const LightFieldTile& tile) {
        const std::size_t n = grid_.directions_u, m = grid_.directions_v;
        for (std::size_t i = 0; i < views_.extent(0); ++i) {
            const std::size_t view = first_ + i, l = m - 1 - view / n, k = n - 1 - view % n;
            for (std::size_t c = 0; c < grid_.channels; ++c)
                for (std::size_t j = 0; j < tile.range.nt; ++j)
                    for (std::size_t s = 0; s < tile.range.ns; ++s)
                        views_(i, tile.range.t0 + j, tile.range.s0 + s, c) = tile.radiance(c, j, s, l, k);
        }
    }
    View<const float, 3> view(std::size_t i) const { return views_.view()[i]; }

  private:
    const LightFieldGrid& grid_;
    std::size_t first_;
    Array<float, 4> views_;
};

template <class T>
Array<T, 3> codes(View<const float, 3> linear, Transfer transfer, double exposure, unsigned bits) {
    const auto full = static_cast<double>(std::numeric_limits<T>::max()), max = static_cast<double>((1u << bits) - 1);
    Array<T, 3> out(linear.shape());
    std::ranges::transform(linear.elements(), out.data(), [&](float value) {
        const float display = encode(transfer, static_cast<float>(value * exposure));
        const double code = std::round(max * std::clamp(static_cast<double>(display), 0.0, 1.0));
        return static_cast<T>(max == full ? code : std::floor((code * full + std::floor(max / 2)) / max));
    });
    return out;
}

StoredView stored_view(View<const float, 3> linear, const ViewTarget& target, double exposure) {
    if (target.bits <= 8) return codes<std::uint8_t>(linear, target.transfer, exposure, target.bits);
    if (target.bits <= 16) return codes<std::uint16_t>(linear, target.transfer, exposure, target.bits);
    Array<float, 3> out(linear.shape());
    std::ranges::transform(linear.elements(), out.data(),
                           [&](float value) { return encode(target.transfer, static_cast<float>(value * exposure)); });
    return out;
}

void read_group(const LightFieldSource& source, Group& group, const Progress& progress) {
    const LightFieldGrid& grid = source.grid();
    const HogelRange size = source.preferred_tile();
    const std::size_t across = (grid.hogels_s + size.ns - 1) / size.ns, down = (grid.hogels_t + size.nt - 1) / size.nt;
    // In order, because a source may be read in bands.
    const std::size_t batch = std::max<std::size_t>(thread_count(), 1) * 4;
    for (std::size_t first = 0; first < across * down; first += batch) {
        work::parallel_for(std::min(batch, across * down - first), [&](std::size_t i) {
            const std::size_t s0 = (first + i) % across * size.ns, t0 = (first + i) / across * size.nt;
            LightFieldTile tile(
                grid, {s0, t0, std::min(size.ns, grid.hogels_s - s0), std::min(size.nt, grid.hogels_t - t0)}, false);
            source.read(tile);
            group.add(tile);
        });
        progress.report(static_cast<double>(first) / static_cast<double>(across * down));
    }
}

double exposure_of(View<const float, 3> view, const Provenance& provenance) {
    Image picture(view.extent(1), view.extent(0), view.extent(2));
    std::ranges::copy(view.elements(), picture.pixels.data());
    picture.provenance = provenance;
    return automatic_exposure(picture);
}

// Returns the exposure of the middle view; 0 if it is in memory with all other views, which are `group_size`.
double requested_exposure(const LightField& light_field, const ViewTarget& target, const ViewExportOptions& options,
                          std::size_t group_size, std::size_t middle) {
    if (options.exposure > 0) return options.exposure;
    if (target.bits == 32 || !stored(light_field, "views bits").empty()) return 1;
    if (group_size == target.columns * target.rows) return 0;
    Group group(light_field.grid(), middle, 1);
    read_group(light_field.front(), group, {});
    return exposure_of(group.view(0), light_field.provenance());
}

ExportedViews write_views(const LightField& light_field, const ViewTarget& target, const ViewExportOptions& options,
                          const Progress& progress) {
    const auto writer = view_layouts().find(options.layout).create(target);
    ExportedViews exported{target.columns, target.rows, {}, {}};
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t views = target.columns * target.rows,
                      skipped_rows = target.rows < grid.directions_v ? grid.directions_v / 2 : 0,
                      skipped = skipped_rows * target.columns,
                      middle = target.rows / 2 * target.columns + target.columns / 2;
    exported.files.resize(views);
    const double view_bytes = static_cast<double>(grid.hogels() * grid.channels) * sizeof(float);
    const auto group_size =
        static_cast<std::size_t>(std::clamp(options.memory / view_bytes, 1.0, static_cast<double>(views)));
    exported.exposure = requested_exposure(light_field, target, options, group_size, skipped + middle);
    for (std::size_t first = 0; first < views; first += group_size) {
        const std::size_t count = std::min(group_size, views - first);
        const Progress part = progress.part(static_cast<double>(first) / static_cast<double>(views),
                                            static_cast<double>(first + count) / static_cast<double>(views));
        Group group(grid, skipped + first, count);
        read_group(light_field.front(), group, part.part(0, 0.5));
        if (exported.exposure == 0) exported.exposure = exposure_of(group.view(middle), light_field.provenance());
        work::parallel_for(count, [&](std::size_t i) {
            const std::size_t row = (first + i) / target.columns, column = (first + i) % target.columns;
            exported.files[first + i] = writer->write(
                row, column,
                stored_view(scaled_view(group.view(i), target.height, target.width), target, exported.exposure));
        });
        part.report(1);
    }
    const std::vector<std::filesystem::path> more = writer->finish();
    std::erase_if(exported.files, [](const auto& file) { return file.empty(); });
    exported.files.insert(exported.files.end(), more.begin(), more.end());
    exported.notes = writer->notes();
    if (target.display)
        for (std::string& note : notes_about(*target.display)) exported.notes.push_back(std::move(note));
    if (target.rows < grid.directions_v)
        exported.notes.push_back(
            fmt::format("one row of cameras: row {} of the {} rows of views", skipped_rows + 1, grid.directions_v));
    return exported;
}

// Makes views tiles of a display's quilt.
void set_display(const QuiltDisplay& display, ViewTarget& target) {
    if (display.columns == 0 || display.rows == 0 || display.tile_width() == 0 || display.tile_height() == 0)
        throw Error(ErrorCode::usage, "device",
                    fmt::format("the display '{}' has no pixels or no tiles for views", display.name));
    const double aspect = static_cast<double>(target.width) / static_cast<double>(target.height);
    target.width = display.tile_width();
    target.height = display.tile_height();
    target.geometry.pixel_height *= static_cast<double>(target.width) / static_cast<double>(target.height) / aspect;
    target.display = display;
}

}  // namespace

ViewTarget target_of(const LightFieldGrid& grid, const std::filesystem::path& path) {
    const FocalPlane* plane = grid.focal_plane();
    if (plane == nullptr) require_perspective(grid, ErrorCode::usage, "a set of views");
    if (plane != nullptr && plane->depth > 0)
        throw Error(ErrorCode::usage, "layout",
                    "the fixed focal plane lies behind the hologram; cameras stand in front of it");
    ViewTarget target;
    target.path = path;
    target.columns = grid.directions_u;
    target.rows = grid.directions_v;
    target.width = grid.hogels_s;
    target.height = grid.hogels_t;
    target.channels = grid.channels;
    target.geometry = geometry_of(grid);
    return target;
}

}  // namespace exchange

ExportedViews export_views(const LightField& light_field, const std::filesystem::path& path,
                           const ViewExportOptions& options, const Progress& progress) {
    using namespace exchange;
    const core::StopScope scope(progress);
    const ViewLayout layout = view_layouts().find(options.layout);
    require_views(light_field, layout);
    if (!(std::isfinite(options.exposure) && options.exposure >= 0))
        throw Error(
            ErrorCode::usage, "exposure",
            fmt::format("the exposure is {}; expected a positive number, or 0 for automatic", options.exposure));
    if (options.bits != 0 && (options.bits < 8 || options.bits > 16))
        throw Error(ErrorCode::usage, "bits",
                    fmt::format("{} bits per sample were requested; expected 8 to 16", options.bits));
    ViewTarget target = target_of(light_field.grid(), path);
    if (layout.is_row) target.rows = 1;
    if (layout.is_row && options.display) set_display(*options.display, target);
    target.texts = with_history(options.metadata, to_metadata(light_field.provenance()));
    target.format = layout.has_pictures ? format_for(light_field, options) : layout.name;
    target.bits = bits_for(light_field, options, target.format);
    if (target.format == "png" && target.bits != 8 && target.bits != 16)
        throw Error(
            ErrorCode::usage, "bits, pictures",
            fmt::format("PNG files hold 8 or 16 bits a sample, not {}; ppm holds any from 8 to 16", target.bits));
    target.transfer = transfer_for(light_field, options, target.bits);
    if (!layout.is_folder) return write_views(light_field, target, options, progress);
    ExportedViews exported;
    core::write_set(path, [&](const std::filesystem::path& temporary) {
        target.path = temporary;
        exported = write_views(light_field, target, options, progress);
    });
    for (std::filesystem::path& file : exported.files) file = path / file.filename();
    return exported;
}

Plan plan_export(const LightField& light_field, const ViewExportOptions& options) {
    const double samples = light_field.grid().samples();
    Plan plan;
    plan.memory = std::min(samples * sizeof(float), options.memory) * 1.5;
    if (view_layouts().find(options.layout).written_at_once) plan.memory += samples * 4;
    plan.disk = samples * (options.bits <= 8 ? 1 : 2);
    plan.seconds = core::rates::on_all_threads(samples * core::rates::exported_sample);
    return plan;
}

}  // namespace hogel
