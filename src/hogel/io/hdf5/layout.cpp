// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/io/hdf5/hdf5.h"

namespace hogel::io::hdf5 {
namespace {

// Page size of disk and memory.
constexpr hsize_t alignment = 4096;
constexpr std::uint64_t header_bytes = std::uint64_t{1} << 20;

class Writer {
  public:
    explicit Writer(const std::filesystem::path& target) : target_(target) {}

    void check(bool good) const {
        if (!good)
            throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': {}", target_.string(), reason()));
    }
    void check(const Handle& handle) const { check(handle.valid()); }
    void check(herr_t status) const { check(status >= 0); }

    void write(hid_t object, const Attributes& attributes) const {
        for (const auto& [name, value] : attributes)
            std::visit([&, &key = name](const auto& v) { write(object, key, v); }, value);
    }

  private:
    void write(hid_t object, const std::string& name, hid_t type, const void* value) const {
        const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
        const Handle attribute(H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        check(attribute);
        check(H5Awrite(attribute.id(), type, value));
    }
    void write(hid_t object, const std::string& name, double value) const {
        write(object, name, H5T_IEEE_F64LE, &value);
    }
    void write(hid_t object, const std::string& name, std::uint64_t value) const {
        write(object, name, H5T_STD_U64LE, &value);
    }
    // Fixed-length strings are in the checksummed object header, others in a heap without checksums.
    void write(hid_t object, const std::string& name, const std::string& value) const {
        const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
        check(H5Tset_size(type.id(), value.size() + 1));
        check(H5Tset_cset(type.id(), H5T_CSET_UTF8));
        write(object, name, type.id(), value.c_str());
    }

    std::filesystem::path target_;
};

std::uint64_t total_bytes(const std::vector<NewDataset>& datasets) {
    std::uint64_t total = header_bytes;
    for (const NewDataset& dataset : datasets) {
        std::uint64_t bytes = bytes_of(dataset.element);
        for (std::size_t extent : dataset.shape) bytes *= extent;  // validated grids: below 2^63
        total = bytes > ~std::uint64_t{0} - total ? ~std::uint64_t{0} : total + bytes;
    }
    return total;
}

}  // namespace

std::vector<std::uint64_t> lay_out_file(const std::filesystem::path& path, const std::filesystem::path& target,
                                        const Attributes& attributes, const std::vector<NewDataset>& datasets) {
    {
        // HDF5 does not recover from a failure to close a file. Detect a full disk and file size limits first.
        core::RawFile reserved(path, core::RawFile::Mode::create, target);
        reserved.reserve(header_bytes);
        reserved.resize(total_bytes(datasets));
        reserved.resize(0);
    }
    const Session session;
    const Writer writer(target);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    // HDF5 1.8 structures; older ones have no checksums.
    writer.check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18));
    writer.check(H5Pset_alignment(access.id(), alignment, alignment));
    writer.check(H5Pset_file_locking(access.id(), false, true));
    writer.check(H5Pset_attr_phase_change(creation.id(), 65535, 0));  // all attributes in the checksummed header
    writer.check(H5Pset_obj_track_times(creation.id(), false));       // no times: equal input gives equal bytes
    Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
    writer.check(file);
    writer.write(file.id(), attributes);

    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), groups(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    writer.check(H5Pset_obj_track_times(groups.id(), false));
    writer.check(H5Pset_obj_track_times(layout.id(), false));
    writer.check(H5Pset_layout(layout.id(), H5D_CONTIGUOUS));
    writer.check(H5Pset_alloc_time(layout.id(), H5D_ALLOC_TIME_EARLY));
    writer.check(H5Pset_fill_time(layout.id(), H5D_FILL_TIME_NEVER));
    writer.check(H5Pset_attr_phase_change(layout.id(), 65535, 0));
    std::vector<std::uint64_t> offsets;
    for (const NewDataset& dataset : datasets) {
        const std::vector<hsize_t> shape(dataset.shape.begin(), dataset.shape.end());
        const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
        const Handle type = type_of(dataset.element);
        const std::size_t slash = dataset.name.find('/');
        const std::string in = dataset.name.substr(0, slash);
        if (slash != std::string::npos && !has_member(file.id(), in.c_str(), target)) {
            const Handle group(H5Gcreate2(file.id(), in.c_str(), H5P_DEFAULT, groups.id(), H5P_DEFAULT), H5Gclose);
            writer.check(group);
        }
        const Handle id(
            H5Dcreate2(file.id(), dataset.name.c_str(), type.id(), space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
            H5Dclose);
        writer.check(id);
        writer.write(id.id(), dataset.attributes);
        const haddr_t offset = H5Dget_offset(id.id());
        writer.check(offset != HADDR_UNDEF);
        offsets.push_back(offset);
    }
    writer.check(file.close());
    return offsets;
}

}  // namespace hogel::io::hdf5
