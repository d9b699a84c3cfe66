// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hogel/image.h"

namespace hogel::io::hdf5 {

/// Lock on HDF5, which is not thread-safe: one session at a time per process. Disables HDF5's error output. Every
/// Handle is created, used and closed during a session.
class Session {
  public:
    Session();
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

  private:
    H5E_auto2_t print_ = nullptr;
    void* print_data_ = nullptr;
};

/// Owner of an HDF5 identifier; closes it when destroyed.
class Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Handle() { close(); }

    hid_t id() const { return id_; }
    bool valid() const { return id_ >= 0; }
    /// Closes the identifier, which may write data for a file. Returns false if HDF5 reports a failure.
    bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

  private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

/// Returns the innermost reason of HDF5's last failure, one line.
std::string reason();

/// Throws Error(bad_input) with the file's name.
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why);

/// Opens a file for reading without checks; HDF5 may crash on a damaged one. Throws Error(bad_input).
Handle open_unchecked_file(const std::filesystem::path& path);
/// Opens a file for reading after check_superblock().
Handle open_file(const std::filesystem::path& path);

/// Element types in a file, little-endian.
enum class Element { half, single, complex_single };
std::size_t bytes_of(Element element);
Handle type_of(Element element);

/// Functions that read attributes throw Error(bad_input), naming the file, if missing or of another type.
using Value = std::variant<double, std::uint64_t, std::string>;
using Attributes = std::vector<std::pair<std::string, Value>>;
double read_number(hid_t object, const char* name, const std::filesystem::path& path);
std::uint64_t read_count(hid_t object, const char* name, const std::filesystem::path& path);
std::string read_text(hid_t object, const char* name, const std::filesystem::path& path);
bool has_attribute(hid_t object, const char* name, const std::filesystem::path& path);
/// Returns whether the group has a hard link of that name.
bool has_member(hid_t group, const char* name, const std::filesystem::path& path);

/// Version of the layout; an attribute at the root of each file, as are "format" and the metadata.
inline constexpr std::uint64_t format_version = 1;
inline constexpr const char* light_field_format = "hogel light field";
inline constexpr const char* hologram_format = "hogel hologram";
/// Throws Error(bad_input), naming the expected `dataset`, for another format or version.
void check_format(hid_t file, const char* format, const char* dataset, const std::filesystem::path& path);
Attributes root_attributes(const char* format, const Metadata& metadata);
Metadata read_metadata(hid_t file, const std::filesystem::path& path);

/// A dataset to create: path in the file ("radiance" or "field0/samples"), element type, shape and attributes.
struct NewDataset {
    std::string name;
    Element element;
    std::vector<std::size_t> shape;
    Attributes attributes;
};

/// Creates a file with contiguous space for each dataset, and returns the offsets of the samples, which are written
/// without HDF5. Throws Error(cannot_write), naming `target`, also for a full disk if the file system reports it.
std::vector<std::uint64_t> lay_out_file(const std::filesystem::path& path, const std::filesystem::path& target,
                                        const Attributes& attributes, const std::vector<NewDataset>& datasets);

}  // namespace hogel::io::hdf5
