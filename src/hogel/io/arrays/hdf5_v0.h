// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hogel/core/raw_file.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {

/// A dataset of an HDF5 file with superblock version 0 or 1.
struct Hdf5V0Dataset {
    struct Member {
        std::string name;  ///< empty if an element is a single number
        Number number = Number::real;
        std::size_t offset = 0;  ///< offset of the number in the element, bytes
    };
    struct Filter {
        std::uint64_t id = 0;
        std::string name;
    };
    enum class Layout { none, compact, contiguous, chunked };

    std::string name;
    std::vector<std::uint64_t> shape;  ///< last axis fastest
    std::vector<Member> members;       ///< of an element; empty for a type that is not supported
    std::size_t element_bytes = 0;
    std::map<std::string, std::string> texts;  ///< the text attributes

    Layout layout = Layout::none;
    std::vector<unsigned char> compact;  ///< all samples, if stored in the header
    std::optional<std::uint64_t>
        address;                       ///< address of the samples or of the tree of chunks; none if nothing was written
    std::uint64_t bytes = 0;           ///< size of contiguous samples
    std::vector<std::uint64_t> chunk;  ///< shape of the chunks
    std::vector<Filter> filters;       ///< filters of the chunks, in the order in which they were applied

    std::uint64_t samples() const;
};

/// An HDF5 file with superblock version 0 or 1, which the HDF5 library writes by default, and MATLAB behind a block of
/// its own. These structures have no checksums, and the HDF5 library crashes if they are damaged. Therefore the part
/// that files of arrays need is read here (HDF5 file format specification 3.0): the datasets of the root group,
/// contiguous or in chunks, plain or with the filters deflate, shuffle and fletcher32. All members throw
/// Error(bad_input).
class Hdf5V0 {
  public:
    explicit Hdf5V0(const std::filesystem::path& path);

    /// The datasets of the root group, by name.
    std::vector<Hdf5V0Dataset> datasets() const;
    /// All elements, in the byte order and element layout of the file.
    std::vector<unsigned char> read(const Hdf5V0Dataset& dataset) const;

    const std::filesystem::path& path() const { return path_; }
    /// `bytes` bytes of the file from an address on.
    std::vector<unsigned char> at(std::uint64_t address, std::uint64_t bytes) const;
    [[noreturn]] void fail(const std::string& why) const;

  private:
    std::filesystem::path path_;
    core::RawFile file_;
    std::uint64_t base_ = 0, root_ = 0;
};

/// Calls use() with the messages of an object's header, continuation blocks included.
void for_each_hdf5_v0_message(
    const Hdf5V0& file, std::uint64_t address,
    const std::function<void(std::uint64_t type, std::uint64_t flags, const std::vector<unsigned char>& message)>& use);

/// Reads the dataset whose header is at an address; element_bytes is 0 if it is a group.
Hdf5V0Dataset hdf5_v0_dataset(const Hdf5V0& file, const std::string& name, std::uint64_t header);

/// Reads numbers and texts one after the other. Throws Error(bad_input) at the end of the bytes.
class ByteCursor {
  public:
    ByteCursor(const Hdf5V0& file, std::span<const unsigned char> bytes)
        : file_(file), rest_(bytes), all_(bytes.size()) {}

    std::uint64_t number(std::size_t bytes);
    std::span<const unsigned char> take(std::size_t bytes);
    void skip(std::size_t bytes) { take(bytes); }

    /// A text terminated by a zero.
    std::string text();
    std::size_t taken() const { return all_ - rest_.size(); }
    std::size_t left() const { return rest_.size(); }

  private:
    const Hdf5V0& file_;
    std::span<const unsigned char> rest_;
    std::size_t all_;
};

}  // namespace hogel::io::arrays
