#include <fmt/format.h>

#include "hogel/codec/stream.h"
#include "hogel/core/error.h"
#include "hogel/io/dataset_internal.h"
#include "hogel/io/files.h"
#include "hogel/io/grids_internal.h"

namespace hogel {
namespace {

using hdf5::Element;

Box radiance_box(const LightFieldGrid& grid, const HogelRange& r) {
    return {{0, r.t0, r.s0, 0, 0}, {grid.channels, r.nt, r.ns, grid.directions_v, grid.directions_u}};
}

Box depth_box(const LightFieldGrid& grid, const HogelRange& r) {
    return {{r.t0, r.s0, 0, 0}, {r.nt, r.ns, grid.directions_v, grid.directions_u}};
}

class LightFieldReader final : public LightFieldSource {
  public:
    explicit LightFieldReader(const std::filesystem::path& path)
        : LightFieldReader(path, hdf5::Session(), std::make_shared<RawFile>(path, RawFile::Mode::read, path)) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return depth_.has_value(); }
    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        radiance_->read(radiance_box(grid_, tile.range), tile.radiance.data());
        if (depth_ && tile.depth.size() > 0) depth_->read(depth_box(grid_, tile.range), tile.depth.data());
    }

  private:
    LightFieldReader(const std::filesystem::path& path, const hdf5::Session&, std::shared_ptr<const RawFile> raw) {
        const hdf5::Handle file = hdf5::open_file(path);
        grid_ = read_light_field_grid(file.id(), path);
        const Box all = radiance_box(grid_, {0, 0, grid_.hogels_s, grid_.hogels_t});
        radiance_.emplace(file.id(), "radiance", all.extent, false, raw);
        if (hdf5::has_member(file.id(), "depth", path))
            depth_.emplace(file.id(), "depth", depth_box(grid_, {0, 0, grid_.hogels_s, grid_.hogels_t}).extent, false,
                           raw);
    }

    LightFieldGrid grid_;
    std::optional<DatasetReader> radiance_, depth_;
};

class LightFieldWriter final : public LightFieldSink {
  public:
    LightFieldWriter(const std::filesystem::path& path, const LightFieldGrid& grid,
                     const LightFieldFileOptions& options)
        : grid_(grid),
          with_depth_(options.with_depth),
          file_(path, hdf5::root_attributes(hdf5::light_field_format, options.metadata), datasets(grid, options)) {}

    void write(const LightFieldTile& tile) override {
        validate(tile, grid_);
        if (with_depth_ && tile.depth.size() == 0)
            throw Error(ErrorCode::usage, fmt::format("cannot write '{}': it is to hold depth, but a tile has none",
                                                      file_.path().string()));
        file_.write(0, radiance_box(grid_, tile.range), tile.radiance.data());
        if (with_depth_) file_.write(1, depth_box(grid_, tile.range), tile.depth.data());
        hogels_ += tile.range.hogels();
    }

    void finish() override {
        if (hogels_ != grid_.hogels())
            throw Error(ErrorCode::internal, fmt::format("cannot finish '{}': {} of {} hogels were written",
                                                         file_.path().string(), hogels_.load(), grid_.hogels()));
        file_.finish();
    }

  private:
    static std::vector<hdf5::NewDataset> datasets(const LightFieldGrid& grid, const LightFieldFileOptions& options) {
        const HogelRange all{0, 0, grid.hogels_s, grid.hogels_t};
        std::vector<hdf5::NewDataset> made;
        made.push_back({"radiance", options.type == SampleType::half ? Element::half : Element::single,
                        radiance_box(grid, all).extent, light_field_attributes(grid)});
        if (options.with_depth)
            made.push_back(
                {"depth", Element::single, depth_box(grid, all).extent, {{"axis_order", "t,s,v,u"}, {"unit", "m"}}});
        return made;
    }

    LightFieldGrid grid_;
    bool with_depth_;
    DatasetFile file_;
    std::atomic<std::size_t> hogels_{0};
};

}  // namespace

hdf5::Attributes light_field_attributes(const LightFieldGrid& grid) {
    return {{"axis_order", "c,t,s,v,u"},
            {"channels", std::uint64_t{grid.channels}},
            {"hogels_s", std::uint64_t{grid.hogels_s}},
            {"hogels_t", std::uint64_t{grid.hogels_t}},
            {"hogel_pitch_m", grid.pitch},
            {"directions_u", std::uint64_t{grid.directions_u}},
            {"directions_v", std::uint64_t{grid.directions_v}},
            {"tan_half_u", grid.tan_half_u},
            {"tan_half_v", grid.tan_half_v}};
}

LightFieldGrid read_light_field_grid(hid_t file, const std::filesystem::path& path) {
    hdf5::check_format(file, hdf5::light_field_format, "radiance", path);
    dataset_shape(file, "radiance", path);  // that it is there, and a dataset
    const hdf5::Handle radiance(H5Dopen2(file, "radiance", H5P_DEFAULT), H5Dclose);
    const auto count = [&](const char* name) { return hdf5::read_count(radiance.id(), name, path); };
    const auto number = [&](const char* name) { return hdf5::read_number(radiance.id(), name, path); };
    const std::string order = hdf5::read_text(radiance.id(), "axis_order", path);
    if (order != "c,t,s,v,u") hdf5::fail(path, fmt::format("its axis_order is '{}' instead of 'c,t,s,v,u'", order));
    LightFieldGrid grid;
    grid.channels = count("channels");
    grid.hogels_s = count("hogels_s");
    grid.hogels_t = count("hogels_t");
    grid.pitch = number("hogel_pitch_m");
    grid.directions_u = count("directions_u");
    grid.directions_v = count("directions_v");
    grid.tan_half_u = number("tan_half_u");
    grid.tan_half_v = number("tan_half_v");
    validate(grid, ErrorCode::bad_input, fmt::format("cannot read '{}'", path.string()));
    return grid;
}

std::unique_ptr<LightFieldSource> open_light_field(const std::filesystem::path& path) {
    if (is_stream(path)) return open_stream(path);
    return std::make_unique<LightFieldReader>(path);
}

std::unique_ptr<LightFieldSink> create_light_field(const std::filesystem::path& path, const LightFieldGrid& grid,
                                                   const LightFieldFileOptions& options) {
    validate(grid, ErrorCode::usage, "light field");
    return std::make_unique<LightFieldWriter>(path, grid, options);
}

}  // namespace hogel
