// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/io/finite.h"
#include "hogel/io/hdf5/grids.h"
#include "hogel/io/hdf5/rehearsal.h"
#include "hogel/io/part_sinks.h"

namespace hogel::io::hdf5 {
namespace {

constexpr std::size_t max_fields = 64;
constexpr float max_half = 65504;

std::string samples_name(std::size_t field) { return fmt::format("field{}/samples", field); }

// Storage of real and imaginary parts: members of a compound, or an additional axis.
enum class Parts { members, axis };

Box box_of(const Region& region, Parts parts) {
    Box box{{region.y0, region.x0}, {region.height, region.width}};
    if (parts == Parts::axis) {
        box.start.push_back(0);
        box.extent.push_back(2);
    }
    return box;
}

std::vector<std::size_t> shape_of(const FieldGrid& grid, Parts parts) {
    return box_of({0, 0, grid.plane.width, grid.plane.height}, parts).extent;
}

class FieldReader final : public FieldSource {
  public:
    FieldReader(const std::filesystem::path& path, std::size_t index, const FieldGrid& grid,
                const Provenance& provenance, DatasetReader samples)
        : path_(path),
          index_(index),
          grid_(grid),
          provenance_(provenance),
          parts_(samples.axes() == 3 ? Parts::axis : Parts::members),
          samples_(std::move(samples)) {}
    const FieldGrid& grid() const override { return grid_; }
    const Provenance& provenance() const override { return provenance_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        validate(region, grid_, out.shape());
        if (look >= looks())
            throw Error(ErrorCode::usage, fmt::format("look {} was asked of a hologram file, which has one", look));
        const Box box = box_of(region, parts_);
        const bool finite = parts_ == Parts::axis ? samples_.read(box, reinterpret_cast<float*>(out.data()))
                                                  : samples_.read(box, out.data());
        if (!finite) require_finite(out, region, index_, path_);  // throws with the position
    }

  private:
    std::filesystem::path path_;
    std::size_t index_;
    FieldGrid grid_;
    Provenance provenance_;
    Parts parts_;
    DatasetReader samples_;
};

// File of several sinks; the last one to finish renames it.
struct SharedHologramFile {
    DatasetFile file;
    std::atomic<std::size_t> unfinished;
};

class FieldWriter final : public FieldSink, public work::SharedSink {
  public:
    FieldWriter(const FieldGrid& grid, Parts parts, std::size_t index, std::shared_ptr<SharedHologramFile> shared)
        : grid_(grid), parts_(parts), index_(index), shared_(std::move(shared)) {}

    void write(const Region& region, View<const std::complex<float>, 2> values) override {
        validate(region, grid_, values.shape());
        if (parts_ == Parts::axis) {
            const std::span<const float> numbers(reinterpret_cast<const float*>(values.data()), 2 * values.size());
            require_halves(numbers);
            shared_->file.write(index_, box_of(region, parts_), numbers.data());
        } else {
            shared_->file.write(index_, box_of(region, parts_), values.data());
        }
        shared_->file.note(part(region));
        written_ += region.samples();
    }

    bool has_already(const Region& region) override {
        if (!shared_->file.was_done(part(region))) return false;
        written_ += region.samples();
        return true;
    }

    std::unique_ptr<work::TileQueue> share_tiles(std::size_t tiles) override {
        return shared_->file.share_tiles(index_, tiles);
    }

    void finish() override {
        const std::uint64_t written = shared_->file.total(written_);
        if (written != grid_.plane.samples())
            throw Error(ErrorCode::internal,
                        fmt::format("cannot finish field {} of '{}': {} of {} samples were written", index_,
                                    shared_->file.path().string(), written, grid_.plane.samples()));
        if (--shared_->unfinished == 0) shared_->file.finish();
    }

  private:
    work::Journal::Part part(const Region& r) const { return {index_, r.x0, r.y0, r.width, r.height}; }

    // Throws for samples that exceed half floats, because one infinite sample would spoil a whole photograph.
    void require_halves(std::span<const float> numbers) const {
        // Sixteen independent maxima allow vectorisation; a single one would be a dependency chain.
        constexpr std::size_t lanes = 16;
        std::array<float, lanes> maxima{};
        const auto take = [&](std::size_t i, float number) {
            const float size = std::abs(number);
            maxima[i] = maxima[i] < size ? size : maxima[i];
        };
        std::size_t first = 0;
        for (; first + lanes <= numbers.size(); first += lanes)
            for (std::size_t i = 0; i < lanes; ++i) take(i, numbers[first + i]);
        for (; first < numbers.size(); ++first) take(0, numbers[first]);
        const float largest = std::ranges::max(maxima);
        if (largest > max_half)
            throw Error(ErrorCode::usage, fmt::format("cannot write '{}': a sample of {} was found, and 16-bit floats "
                                                      "end at {}; 32-bit floats would do",
                                                      shared_->file.path().string(), largest, max_half));
    }

    FieldGrid grid_;
    Parts parts_;
    std::size_t index_;
    std::shared_ptr<SharedHologramFile> shared_;
    std::atomic<std::size_t> written_{0};
};

hdf5::Attributes field_attributes(const FieldGrid& grid, Parts parts) {
    return {{"axis_order", parts == Parts::axis ? "y,x,part" : "y,x"},
            {"wavelength_m", grid.wavelength},
            {"pitch_x_m", grid.plane.pitch_x},
            {"pitch_y_m", grid.plane.pitch_y},
            {"center_x_m", grid.plane.center_x},
            {"center_y_m", grid.plane.center_y},
            {"z_m", 0.0}};
}

FieldGrid read_field_grid(hid_t file, std::size_t field, const std::filesystem::path& path) {
    const std::string name = samples_name(field);
    const std::vector<std::size_t> shape = dataset_shape(file, name.c_str(), path);
    if (shape.size() != 2 && (shape.size() != 3 || shape[2] != 2))
        hdf5::fail(path, fmt::format("the axes of its dataset '{}' are [{}] instead of [y][x] or [y][x][2]", name,
                                     fmt::join(shape, "][")));
    const hdf5::Handle samples(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    const auto number = [&](const char* attribute) { return hdf5::read_number(samples.id(), attribute, path); };
    FieldGrid grid;
    grid.plane = {
        shape[1], shape[0], number("pitch_x_m"), number("pitch_y_m"), number("center_x_m"), number("center_y_m")};
    grid.wavelength = number("wavelength_m");
    validate(grid, ErrorCode::bad_input, fmt::format("cannot read '{}', field {}", path.string(), field));
    if (number("z_m") != 0) hdf5::fail(path, fmt::format("its field {} is not on the plane z = 0", field));
    return grid;
}

}  // namespace

std::vector<FieldGrid> read_hologram_grids(hid_t file, const std::filesystem::path& path) {
    hdf5::check_format(file, hdf5::hologram_format, "field0/samples", path);
    std::vector<FieldGrid> grids;
    do {
        grids.push_back(read_field_grid(file, grids.size(), path));
    } while (grids.size() < max_fields && hdf5::has_member(file, fmt::format("field{}", grids.size()).c_str(), path));
    return grids;
}

DatasetReader samples_of_field(hid_t file, std::size_t field, const FieldGrid& grid,
                               const std::shared_ptr<const core::RawFile>& raw) {
    const std::string name = samples_name(field);
    const Parts parts = dataset_shape(file, name.c_str(), raw->name()).size() == 3 ? Parts::axis : Parts::members;
    return {file, name.c_str(), shape_of(grid, parts), parts == Parts::members, raw};
}

}  // namespace hogel::io::hdf5

namespace hogel {

using namespace io;
using namespace io::hdf5;

Fields open_hologram(const std::filesystem::path& path) {
    return with_rehearsal(path, "hologram", [&] {
        const auto raw = std::make_shared<core::RawFile>(path, core::RawFile::Mode::read, path);
        const hdf5::Handle file = hdf5::open_file(path);
        const Provenance provenance = to_provenance(hdf5::read_metadata(file.id(), path));
        Fields fields;
        for (const FieldGrid& grid : read_hologram_grids(file.id(), path)) {
            const std::size_t index = fields.size();
            fields.push_back(std::make_shared<FieldReader>(path, index, grid, provenance,
                                                           samples_of_field(file.id(), index, grid, raw)));
        }
        return fields;
    });
}

namespace {

// Creates the sinks of a file or, if `part` is given, of the rows of a part file; `rows` has one entry per field.
std::vector<std::unique_ptr<FieldSink>> create(const std::filesystem::path& path, std::span<const FieldGrid> grids,
                                               const HologramFileOptions& options, const PartNumber* part,
                                               std::span<const Rows> rows) {
    if (grids.empty() || grids.size() > max_fields)
        throw Error(ErrorCode::usage, fmt::format("hologram '{}': {} fields, but 1 to {} can be written", path.string(),
                                                  grids.size(), max_fields));
    const bool halves = options.type == SampleType::half;
    const Parts parts = halves ? Parts::axis : Parts::members;
    Contents contents{hdf5::root_attributes(hdf5::hologram_format, options.metadata), {}};
    std::vector<Band> bands;
    for (const FieldGrid& grid : grids) {
        validate(grid, ErrorCode::usage, "hologram");
        const Rows& field_rows = rows[bands.size()];
        bands.push_back({0, field_rows.first, field_rows.count});
        contents.datasets.push_back({samples_name(contents.datasets.size()),
                                     halves ? hdf5::Element::half : hdf5::Element::complex_single,
                                     shape_of(grid, parts), field_attributes(grid, parts)});
    }
    if (part != nullptr) contents.part = PartOf{part->number, part->count, std::move(bands), part->input};
    std::shared_ptr<SharedHologramFile> shared(
        new SharedHologramFile{{path, std::move(contents), options.resume}, grids.size()});
    std::vector<std::unique_ptr<FieldSink>> sinks;
    for (FieldGrid grid : grids) {
        grid.plane.height = rows[sinks.size()].count;
        sinks.push_back(std::make_unique<FieldWriter>(grid, parts, sinks.size(), shared));
    }
    return sinks;
}

}  // namespace

std::vector<std::unique_ptr<FieldSink>> create_hologram(const std::filesystem::path& path,
                                                        std::span<const FieldGrid> grids,
                                                        const HologramFileOptions& options) {
    require_name(path, "hdf5");
    std::vector<Rows> all;
    for (const FieldGrid& grid : grids) all.push_back({0, grid.plane.height});
    return create(path, grids, options, nullptr, all);
}

std::vector<std::unique_ptr<FieldSink>> io::create_hologram_part(const std::filesystem::path& path,
                                                                 std::span<const FieldGrid> grids,
                                                                 const HologramFileOptions& options,
                                                                 const PartNumber& part, std::span<const Rows> rows) {
    return create(path, grids, options, &part, rows);
}

}  // namespace hogel
