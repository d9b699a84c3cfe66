// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "hogel/error.h"
#include "hogel/io/finite.h"
#include "hogel/io/hdf5/dataset.h"
#include "hogel/io/hdf5/files.h"
#include "hogel/io/hdf5/grids.h"
#include "hogel/io/hdf5/rehearsal.h"
#include "hogel/io/part_sinks.h"
#include "hogel/lightfield/channel_source.h"

namespace hogel::io::hdf5 {
namespace {

Box radiance_box(const LightFieldGrid& grid, const HogelRange& r) {
    return {{0, r.t0, r.s0, 0, 0}, {grid.channels, r.nt, r.ns, grid.directions_v, grid.directions_u}};
}

Box depth_box(const LightFieldGrid& grid, const HogelRange& r) {
    return {{r.t0, r.s0, 0, 0}, {r.nt, r.ns, grid.directions_v, grid.directions_u}};
}

// The front is at the file's root, each side in a group of its name.
std::string dataset_name(Face face, const char* dataset) {
    return face == Face::front ? dataset : fmt::format("{}/{}", face_name(face), dataset);
}

class LightFieldReader final : public LightFieldSource, public lightfield::ChannelSource {
  public:
    LightFieldReader(hid_t file, const LightFieldGrid& grid, const std::filesystem::path& path,
                     const std::shared_ptr<const core::RawFile>& raw)
        : grid_(grid), path_(path) {
        const HogelRange all{0, 0, grid.hogels_s, grid.hogels_t};
        radiance_.emplace(file, dataset_name(grid.face(), "radiance").c_str(), radiance_box(grid, all).extent, false,
                          raw);
        const std::string depth = dataset_name(grid.face(), "depth");
        if (hdf5::has_member(file, depth.c_str(), path))
            depth_.emplace(file, depth.c_str(), depth_box(grid, all).extent, false, raw);
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return depth_.has_value(); }
    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        if (!radiance_->read(radiance_box(grid_, tile.range), tile.radiance.data())) throw_not_finite(tile, path_);
        if (depth_ && tile.depth.size() > 0) depth_->read(depth_box(grid_, tile.range), tile.depth.data());
    }
    void read_channel(std::size_t channel, const HogelRange& hogels, View<float, 4> out) const override {
        Box box = radiance_box(grid_, hogels);
        box.start[0] = channel;
        box.extent[0] = 1;
        if (radiance_->read(box, out.data())) return;
        LightFieldTile tile(grid_, hogels, false);  // throws with the position
        read(tile);
    }

  private:
    LightFieldGrid grid_;
    std::filesystem::path path_;
    std::optional<DatasetReader> radiance_, depth_;
};

// File of several sinks; the last one to finish renames it.
struct SharedLightFieldFile {
    DatasetFile file;
    std::atomic<std::size_t> unfinished;
};

class LightFieldWriter final : public LightFieldSink, public work::SharedSink {
  public:
    LightFieldWriter(const LightFieldGrid& grid, std::size_t first_dataset, bool with_depth,
                     std::shared_ptr<SharedLightFieldFile> shared)
        : grid_(grid), first_dataset_(first_dataset), with_depth_(with_depth), shared_(std::move(shared)) {}

    void write(const LightFieldTile& tile) override {
        validate(tile, grid_);
        DatasetFile& file = shared_->file;
        if (with_depth_ && tile.depth.size() == 0)
            throw Error(ErrorCode::usage,
                        fmt::format("cannot write '{}': it stores depth, but a tile has none", file.path().string()));
        file.write(first_dataset_, radiance_box(grid_, tile.range), tile.radiance.data());
        if (with_depth_) file.write(first_dataset_ + 1, depth_box(grid_, tile.range), tile.depth.data());
        file.note(part(tile.range));
        hogels_ += tile.range.hogels();
    }

    bool wants_depth() const override { return with_depth_; }

    bool has_already(const HogelRange& range) override {
        if (!shared_->file.was_done(part(range))) return false;
        hogels_ += range.hogels();
        return true;
    }

    std::unique_ptr<work::TileQueue> share_tiles(std::size_t tiles) override {
        return shared_->file.share_tiles(first_dataset_, tiles);
    }

    void finish() override {
        const std::uint64_t written = shared_->file.total(hogels_);
        if (written != grid_.hogels())
            throw Error(ErrorCode::internal,
                        fmt::format("cannot finish the {} face of '{}': {} of {} hogels were "
                                    "written",
                                    face_name(grid_.face()), shared_->file.path().string(), written, grid_.hogels()));
        if (--shared_->unfinished == 0) shared_->file.finish();
    }

  private:
    work::Journal::Part part(const HogelRange& r) const { return {first_dataset_, r.s0, r.t0, r.ns, r.nt}; }

    LightFieldGrid grid_;
    std::size_t first_dataset_;  // index of the radiance dataset; depth follows
    bool with_depth_;
    std::shared_ptr<SharedLightFieldFile> shared_;
    std::atomic<std::size_t> hogels_{0};
};

// The attribute names of a face's half width state the quantity in which directions are uniform: tangents, sines, or
// points of a focal plane. Thus programs that know only some of these cannot confuse them.
struct Uniform {
    std::string_view in;
    std::string half(char axis) const { return fmt::format("{}_half_{}", in, axis); }
};
constexpr Uniform tangents{"tan"}, sines{"sine"}, points{"focal"};
constexpr const char* focal_plane_name = "focal_plane_m";

Uniform uniform(const LightFieldGrid& grid) {
    return grid.has_frequencies() ? sines : grid.focal_plane() ? points : tangents;
}

hdf5::Attributes light_field_attributes(const LightFieldGrid& grid) {
    hdf5::Attributes attributes{{"axis_order", "c,t,s,v,u"},
                                {"face", std::string(face_name(grid.face()))},
                                {"channels", std::uint64_t{grid.channels}},
                                {"hogels_s", std::uint64_t{grid.hogels_s}},
                                {"hogels_t", std::uint64_t{grid.hogels_t}},
                                {"hogel_pitch_m", grid.pitch},
                                {"directions_u", std::uint64_t{grid.directions_u}},
                                {"directions_v", std::uint64_t{grid.directions_v}},
                                {uniform(grid).half('u'), grid.half_u()},
                                {uniform(grid).half('v'), grid.half_v()},
                                {"center_u", grid.center_u()},
                                {"center_v", grid.center_v()}};
    if (const FocalPlane* plane = grid.focal_plane()) attributes.emplace_back(focal_plane_name, plane->depth);
    return attributes;
}

LightFieldGrid read_face_grid(hid_t file, Face face, const std::filesystem::path& path) {
    const std::string dataset = dataset_name(face, "radiance");
    dataset_shape(file, dataset.c_str(), path);  // throws if it does not exist
    const hdf5::Handle radiance(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    const auto count = [&](const char* attribute) { return hdf5::read_count(radiance.id(), attribute, path); };
    const auto number = [&](const char* attribute) { return hdf5::read_number(radiance.id(), attribute, path); };
    const auto middle = [&](const char* attribute) {
        return hdf5::has_attribute(radiance.id(), attribute, path) ? number(attribute) : 0;
    };
    const std::string order = hdf5::read_text(radiance.id(), "axis_order", path);
    if (order != "c,t,s,v,u") hdf5::fail(path, fmt::format("its axis_order is '{}' instead of 'c,t,s,v,u'", order));
    const std::string found =
        hdf5::has_attribute(radiance.id(), "face", path) ? hdf5::read_text(radiance.id(), "face", path) : "front";
    if (found != face_name(face))
        hdf5::fail(path, fmt::format("its dataset '{}' says that it is the face '{}'", dataset, found));
    LightFieldGrid grid;
    grid.channels = count("channels");
    grid.hogels_s = count("hogels_s");
    grid.hogels_t = count("hogels_t");
    grid.pitch = number("hogel_pitch_m");
    grid.directions_u = count("directions_u");
    grid.directions_v = count("directions_v");
    const auto is_in = [&](const Uniform& kind) {
        return hdf5::has_attribute(radiance.id(), kind.half('u').c_str(), path);
    };
    const Uniform kind = is_in(sines) ? sines : is_in(points) ? points : tangents;
    const DirectionRange range{number(kind.half('u').c_str()), number(kind.half('v').c_str()), middle("center_u"),
                               middle("center_v")};
    if (kind.in != tangents.in && face != Face::front)
        hdf5::fail(path, fmt::format("the directions of its {} face are uniform in {}; only those of the front can be",
                                     face_name(face), kind.in == sines.in ? "sines" : "points of a focal plane"));
    if (kind.in == sines.in)
        grid.view = Frequencies{range};
    else if (kind.in == points.in)
        grid.view = FocalPlane{range, number(focal_plane_name)};
    else
        grid.view = Perspective{range, face};
    validate(grid, ErrorCode::bad_input, fmt::format("cannot read '{}'", path.string()));
    return grid;
}

}  // namespace

std::vector<LightFieldGrid> read_light_field_grids(hid_t file, const std::filesystem::path& path) {
    hdf5::check_format(file, hdf5::light_field_format, "radiance", path);
    std::vector<LightFieldGrid> grids;
    for (const Face face : all_faces) {
        if (face != Face::front && !hdf5::has_member(file, std::string(face_name(face)).c_str(), path)) continue;
        grids.push_back(read_face_grid(file, face, path));
        if (!same_hogels(grids.front(), grids.back()))
            hdf5::fail(path, fmt::format("its {} face has other hogels or channels than its front", face_name(face)));
    }
    return grids;
}

DatasetReader radiance_of_front(hid_t file, const LightFieldGrid& grid,
                                const std::shared_ptr<const core::RawFile>& raw) {
    return {file, "radiance", radiance_box(grid, {0, 0, grid.hogels_s, grid.hogels_t}).extent, false, raw};
}

LightField open_light_field(const std::filesystem::path& path) {
    return with_rehearsal(path, "light field", [&] {
        std::vector<LightField::Source> faces;
        const auto raw = std::make_shared<core::RawFile>(path, core::RawFile::Mode::read, path);
        const hdf5::Handle file = hdf5::open_file(path);
        for (const LightFieldGrid& grid : read_light_field_grids(file.id(), path))
            faces.push_back(std::make_shared<LightFieldReader>(file.id(), grid, path, raw));
        return LightField(std::move(faces), to_provenance(read_metadata(file.id(), path)));
    });
}

namespace {

// Creates the sinks of a file or, if `part` is given, of the rows of a part file.
std::vector<std::unique_ptr<LightFieldSink>> create(const std::filesystem::path& path,
                                                    std::span<const LightFieldGrid> grids,
                                                    const LightFieldFileOptions& options, const PartNumber* part,
                                                    const Rows& rows) {
    for (const LightFieldGrid& grid : grids) validate(grid, ErrorCode::usage, "light field");
    require_faces(grids);
    Contents contents{hdf5::root_attributes(hdf5::light_field_format, options.metadata), {}};
    std::vector<Band> bands;
    for (const LightFieldGrid& grid : grids) {
        const HogelRange all{0, 0, grid.hogels_s, grid.hogels_t};
        contents.datasets.push_back({dataset_name(grid.face(), "radiance"),
                                     options.type == SampleType::half ? Element::half : Element::single,
                                     radiance_box(grid, all).extent, light_field_attributes(grid)});
        bands.push_back({1, rows.first, rows.count});
        if (!options.with_depth) continue;
        contents.datasets.push_back({dataset_name(grid.face(), "depth"),
                                     Element::single,
                                     depth_box(grid, all).extent,
                                     {{"axis_order", "t,s,v,u"}, {"unit", "m"}}});
        bands.push_back({0, rows.first, rows.count});
    }
    if (part != nullptr) contents.part = PartOf{part->number, part->count, std::move(bands), part->input};
    std::shared_ptr<SharedLightFieldFile> shared(
        new SharedLightFieldFile{{path, std::move(contents), options.resume}, grids.size()});
    std::vector<std::unique_ptr<LightFieldSink>> sinks;
    const std::size_t datasets_per_face = options.with_depth ? 2 : 1;
    for (LightFieldGrid grid : grids) {
        grid.hogels_t = rows.count;
        sinks.push_back(
            std::make_unique<LightFieldWriter>(grid, datasets_per_face * sinks.size(), options.with_depth, shared));
    }
    return sinks;
}

}  // namespace
}  // namespace hogel::io::hdf5

namespace hogel {

using namespace io;
using namespace io::hdf5;

std::vector<std::unique_ptr<LightFieldSink>> create_light_field(const std::filesystem::path& path,
                                                                std::span<const LightFieldGrid> grids,
                                                                const LightFieldFileOptions& options) {
    require_name(path, "hdf5");
    return hdf5::create(path, grids, options, nullptr, {0, grids.empty() ? 0 : grids.front().hogels_t});
}

std::vector<std::unique_ptr<LightFieldSink>> io::create_light_field_part(const std::filesystem::path& path,
                                                                         std::span<const LightFieldGrid> grids,
                                                                         const LightFieldFileOptions& options,
                                                                         const PartNumber& part, const Rows& rows) {
    return hdf5::create(path, grids, options, &part, rows);
}

}  // namespace hogel
