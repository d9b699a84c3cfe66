// SPDX-License-Identifier: Apache-2.0
// Replaces the folder hdf5 in a build without HDF5.
#include <fmt/format.h>

#include "hogel/core/part.h"
#include "hogel/files.h"
#include "hogel/io/hdf5/files.h"
#include "hogel/io/mat73_arrays.h"
#include "hogel/io/part_sinks.h"

namespace hogel {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path) {
    core::refuse_without("HDF5", fmt::format("'{}', an HDF5 file", path.string()));
}

}  // namespace

namespace io::hdf5 {

FileKind kind_of(const std::filesystem::path& path) { refuse(path); }
void summarize(const std::filesystem::path& path, FileSummary&) { refuse(path); }
void write_slmsuite_file(const std::filesystem::path& path, View<const std::uint16_t, 2>, std::size_t) { refuse(path); }
// Called for any file that is not compressed: report other errors first.
LightField open_light_field(const std::filesystem::path& path) {
    is_hdf5(path);
    refuse(path);
}

}  // namespace io::hdf5

std::vector<std::unique_ptr<LightFieldSink>> create_light_field(const std::filesystem::path& path,
                                                                std::span<const LightFieldGrid>,
                                                                const LightFieldFileOptions&) {
    refuse(path);
}

Fields open_hologram(const std::filesystem::path& path) {
    io::hdf5::is_hdf5(path);
    refuse(path);
}

std::vector<std::unique_ptr<FieldSink>> create_hologram(const std::filesystem::path& path, std::span<const FieldGrid>,
                                                        const HologramFileOptions&) {
    refuse(path);
}

std::vector<std::unique_ptr<LightFieldSink>> io::create_light_field_part(const std::filesystem::path& path,
                                                                         std::span<const LightFieldGrid>,
                                                                         const LightFieldFileOptions&,
                                                                         const PartNumber&, const Rows&) {
    refuse(path);
}

std::vector<std::unique_ptr<FieldSink>> io::create_hologram_part(const std::filesystem::path& path,
                                                                 std::span<const FieldGrid>, const HologramFileOptions&,
                                                                 const PartNumber&, std::span<const Rows>) {
    refuse(path);
}

std::vector<io::Mat73Array> io::read_mat73_arrays(const std::filesystem::path& path,
                                                  const std::function<bool(const Mat73Array&)>&) {
    refuse(path);
}

void io::join_parts(const std::filesystem::path& path, std::span<const std::filesystem::path>, const Progress&) {
    refuse(path);
}

}  // namespace hogel
