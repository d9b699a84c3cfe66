// SPDX-License-Identifier: Apache-2.0
// Parts of light fields and holograms, written by independent programs.
#include <fmt/format.h>

#include <algorithm>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/io/part_sinks.h"
#include "hogel/pipeline.h"

namespace hogel {
namespace {

// Returns the rows of a part; `units` rows or groups of rows are divided as evenly as possible.
io::Rows rows_of(const FilePart& part, std::size_t units, const char* what) {
    if (part.number == 0 || part.number > part.count)
        throw Error(ErrorCode::usage, "part",
                    fmt::format("part {} of {} was asked for; expected one from 1", part.number, part.count));
    if (part.count > units)
        throw Error(ErrorCode::usage, "part",
                    fmt::format("{} parts of {} rows of {} were asked for; expected at most {}", part.count, units,
                                what, units));
    const auto begin = [&](std::size_t number) {
        return units / part.count * number + units % part.count * number / part.count;
    };
    return {begin(part.number - 1), begin(part.number) - begin(part.number - 1)};
}

io::PartNumber number_of(const FilePart& part) { return {part.number, part.count, part.input}; }

// Range of rows of hogels of a light-field face.
class HogelRows final : public LightFieldSource {
  public:
    HogelRows(LightField::Source source, const io::Rows& rows)
        : source_(std::move(source)), first_(rows.first), grid_(source_->grid()) {
        grid_.hogels_t = rows.count;
    }
    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override {
        HogelRange tile = source_->preferred_tile();
        tile.nt = std::min(tile.nt, grid_.hogels_t);
        return tile;
    }
    void read(LightFieldTile& tile) const override {
        tile.range.t0 += first_;
        source_->read(tile);
        tile.range.t0 -= first_;
    }

  private:
    LightField::Source source_;
    std::size_t first_;
    LightFieldGrid grid_;
};

// Range of rows of samples of a field.
class SampleRows final : public FieldSource {
  public:
    SampleRows(std::shared_ptr<const FieldSource> source, const io::Rows& rows)
        : source_(std::move(source)), first_(rows.first), grid_(source_->grid()) {
        grid_.plane.height = rows.count;
    }
    const FieldGrid& grid() const override { return grid_; }
    std::size_t alignment() const override { return source_->alignment(); }
    std::size_t overlap() const override { return source_->overlap(); }
    std::size_t looks() const override { return source_->looks(); }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        Region source_region = region;
        source_region.y0 += first_;
        source_->read(source_region, look, out);
    }

  private:
    std::shared_ptr<const FieldSource> source_;
    std::size_t first_;
    FieldGrid grid_;
};

}  // namespace

void write_light_field_part(const std::filesystem::path& path, const LightField& light_field,
                            const LightFieldFileOptions& options, const FilePart& part, const Progress& progress) {
    const core::StopScope scope(progress);
    const io::Rows rows = rows_of(part, light_field.grid().hogels_t, "hogels");
    LightFieldFileOptions file = options;
    file.metadata = with_history(file.metadata, to_metadata(light_field.provenance()));
    const auto sinks = io::create_light_field_part(path, light_field.grids(), file, number_of(part), rows);
    for (std::size_t i = 0; i < sinks.size(); ++i)
        copy(HogelRows(light_field.faces()[i], rows), *sinks[i], progress.part(i, sinks.size()));
}

void write_holograms_part(const std::filesystem::path& path, const Fields& holograms,
                          const HologramFileOptions& options, const FilePart& part, const Progress& progress) {
    const core::StopScope scope(progress);
    std::vector<FieldGrid> grids;
    std::vector<io::Rows> rows;
    for (const auto& hologram : holograms) {
        grids.push_back(hologram->grid());
        const std::size_t height = hologram->grid().plane.height,
                          step = std::max<std::size_t>(hologram->alignment(), 1);
        const io::Rows units = rows_of(part, (height + step - 1) / step, "hogels");
        const std::size_t first = units.first * step, end = std::min((units.first + units.count) * step, height);
        rows.push_back({first, end - first});
    }
    HologramFileOptions file = options;
    file.metadata = with_history(file.metadata, to_metadata(holograms.front()->provenance()));
    const auto sinks = io::create_hologram_part(path, grids, file, number_of(part), rows);
    for (std::size_t i = 0; i < sinks.size(); ++i)
        copy(SampleRows(holograms[i], rows[i]), *sinks[i], 0, progress.part(i, sinks.size()));
}

void join_parts(const std::filesystem::path& path, std::span<const std::filesystem::path> parts,
                const Progress& progress) {
    io::join_parts(path, parts, progress);
}

}  // namespace hogel
