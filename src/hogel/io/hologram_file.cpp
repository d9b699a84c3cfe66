#include <fmt/format.h>

#include "hogel/core/error.h"
#include "hogel/io/dataset_internal.h"
#include "hogel/io/files.h"
#include "hogel/io/grids_internal.h"

namespace hogel {
namespace {

constexpr std::size_t most_fields = 64;

std::string samples_name(std::size_t field) { return fmt::format("field{}/samples", field); }

class FieldReader final : public FieldSource {
  public:
    FieldReader(const FieldGrid& grid, DatasetReader samples) : grid_(grid), samples_(std::move(samples)) {}
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        validate(region, grid_, out.shape());
        if (look >= looks())
            throw Error(ErrorCode::usage, fmt::format("look {} was asked of a hologram file, which has one", look));
        samples_.read({{region.y0, region.x0}, {region.height, region.width}}, out.data());
    }

  private:
    FieldGrid grid_;
    DatasetReader samples_;
};

// What the sinks of one file share: the last to finish gives it its name.
struct SharedFile {
    DatasetFile file;
    std::atomic<std::size_t> unfinished;
};

class FieldWriter final : public FieldSink {
  public:
    FieldWriter(const FieldGrid& grid, std::size_t index, std::shared_ptr<SharedFile> shared)
        : grid_(grid), index_(index), shared_(std::move(shared)) {}

    void write(const Region& region, View<const std::complex<float>, 2> values) override {
        validate(region, grid_, values.shape());
        shared_->file.write(index_, {{region.y0, region.x0}, {region.height, region.width}}, values.data());
        shared_->file.note(part(region));
        written_ += region.samples();
    }

    bool has_already(const Region& region) override {
        if (!shared_->file.was_done(part(region))) return false;
        written_ += region.samples();
        return true;
    }

    void finish() override {
        if (written_ != grid_.plane.samples())
            throw Error(ErrorCode::internal,
                        fmt::format("cannot finish field {} of '{}': {} of {} samples were written", index_,
                                    shared_->file.path().string(), written_.load(), grid_.plane.samples()));
        if (--shared_->unfinished == 0) shared_->file.finish();
    }

  private:
    Journal::Part part(const Region& r) const { return {index_, r.x0, r.y0, r.width, r.height}; }

    FieldGrid grid_;
    std::size_t index_;
    std::shared_ptr<SharedFile> shared_;
    std::atomic<std::size_t> written_{0};
};

hdf5::Attributes field_attributes(const FieldGrid& grid) {
    return {{"axis_order", "y,x"},
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
    if (shape.size() != 2)
        hdf5::fail(path, fmt::format("its dataset '{}' has {} axes instead of [y][x]", name, shape.size()));
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
    } while (grids.size() < most_fields && hdf5::has_member(file, fmt::format("field{}", grids.size()).c_str(), path));
    return grids;
}

HologramFile open_hologram(const std::filesystem::path& path) {
    const hdf5::Session session;
    const auto raw = std::make_shared<RawFile>(path, RawFile::Mode::read, path);
    const hdf5::Handle file = hdf5::open_file(path);
    HologramFile hologram;
    for (const FieldGrid& grid : read_hologram_grids(file.id(), path)) {
        const std::string name = samples_name(hologram.fields.size());
        hologram.fields.push_back(std::make_unique<FieldReader>(
            grid, DatasetReader(file.id(), name.c_str(), {grid.plane.height, grid.plane.width}, true, raw)));
    }
    hologram.metadata = hdf5::read_metadata(file.id(), path);
    return hologram;
}

std::vector<std::unique_ptr<FieldSink>> create_hologram(const std::filesystem::path& path,
                                                        std::span<const FieldGrid> grids, const Metadata& metadata,
                                                        const std::optional<std::string>& resume) {
    if (grids.empty() || grids.size() > most_fields)
        throw Error(ErrorCode::usage, fmt::format("hologram '{}': {} fields, but 1 to {} can be written", path.string(),
                                                  grids.size(), most_fields));
    std::vector<hdf5::NewDataset> datasets;
    for (const FieldGrid& grid : grids) {
        validate(grid, ErrorCode::usage, "hologram");
        datasets.push_back({samples_name(datasets.size()),
                            hdf5::Element::complex_single,
                            {grid.plane.height, grid.plane.width},
                            field_attributes(grid)});
    }
    std::shared_ptr<SharedFile> shared(new SharedFile{
        {path, hdf5::root_attributes(hdf5::hologram_format, metadata), std::move(datasets), resume}, grids.size()});
    std::vector<std::unique_ptr<FieldSink>> sinks;
    for (const FieldGrid& grid : grids) sinks.push_back(std::make_unique<FieldWriter>(grid, sinks.size(), shared));
    return sinks;
}

}  // namespace hogel
