// SPDX-License-Identifier: Apache-2.0
// Patterns as slmsuite's SLM.save_phase() writes them.
#include <fmt/format.h>

#include <numbers>

#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/io/hdf5/files.h"
#include "hogel/io/hdf5/hdf5.h"
#include "hogel/phase_code.h"

namespace hogel::io::hdf5 {
namespace {

constexpr const char* slmsuite_version = "0.4.1";  // whose save_phase() and load_phase() were compared
constexpr std::uint64_t slmsuite_header_bytes = 1 << 16;

class SlmsuiteWriter {
  public:
    SlmsuiteWriter(hid_t file, const std::filesystem::path& target) : file_(file), target_(target) {}

    void check(bool good) const {
        if (!good)
            throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': {}", target_.string(), reason()));
    }
    void write(const char* name, hid_t stored, hid_t given, const std::vector<hsize_t>& shape,
               const void* values) const {
        const Handle space(shape.empty() ? H5Screate(H5S_SCALAR)
                                         : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                           H5Sclose);
        const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        check(H5Pset_obj_track_times(creation.id(), false) >= 0);  // equal input gives equal bytes
        const Handle data(H5Dcreate2(file_, name, stored, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                          H5Dclose);
        check(data.valid());
        check(H5Dwrite(data.id(), given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    }

  private:
    hid_t file_;
    std::filesystem::path target_;
};

}  // namespace

void write_slmsuite_file(const std::filesystem::path& path, View<const std::uint16_t, 2> levels, std::size_t largest) {
    const PhaseCode code = parse_phase_code("slmsuite");
    Array<float, 2> phases(levels.shape());
    for (std::size_t i = 0; i < levels.size(); ++i)
        phases.data()[i] = static_cast<float>(code.phase(levels.data()[i], static_cast<double>(largest)));
    core::OutputFile output(path);
    {
        // HDF5 does not recover from a failure to close a file. Detect a full disk first.
        core::RawFile reserved(output.temporary(), core::RawFile::Mode::create, path);
        reserved.reserve(slmsuite_header_bytes + 6 * levels.size());
        reserved.resize(0);
    }
    const Session session;
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.id(), false);
    Handle file(H5Fcreate(output.temporary().c_str(), H5F_ACC_TRUNC, creation.id(), H5P_DEFAULT), H5Fclose);
    const SlmsuiteWriter writer(file.id(), path);
    writer.check(file.valid());
    const std::vector<hsize_t> shape{levels.extent(0), levels.extent(1)};
    const Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
    writer.check(H5Tset_size(text.id(), std::string_view(slmsuite_version).size()) >= 0);
    writer.write("__version__", text.id(), text.id(), {}, slmsuite_version);
    writer.write("display", largest > 255 ? H5T_STD_U16LE : H5T_STD_U8LE, H5T_NATIVE_UINT16, shape, levels.data());
    writer.write("phase", H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, shape, phases.data());
    writer.check(file.close());
    output.commit();
}

}  // namespace hogel::io::hdf5
