// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hogel::io::arrays {

struct ZipEntry {
    std::string name;
    std::uint32_t crc = 0;
    std::uint16_t method = 0;               ///< 0: stored, 8: deflated
    std::uint64_t size = 0;                 ///< bytes of the file
    std::span<const unsigned char> packed;  ///< as stored in the archive
};

/// Returns the files in the central directory (APPNOTE.TXT 6.3). Throws Error(bad_input) for damaged archives.
std::vector<ZipEntry> read_zip(const std::filesystem::path& path, std::span<const unsigned char> archive);

/// Returns the bytes of a file. Throws Error(bad_input) if it is damaged, encrypted or compressed by another method,
/// and Error(not_built_in) for deflated files in a build without zlib.
std::vector<unsigned char> unpack(const std::filesystem::path& path, const ZipEntry& entry);

/// CRC-32 as in ZIP, PNG and others.
std::uint32_t crc32_of(std::span<const unsigned char> bytes);

/// Writer of an archive of stored files, dated 1980-01-01. Throws Error(usage) beyond 4 GiB.
class ZipWriter {
  public:
    explicit ZipWriter(const std::filesystem::path& path) : path_(path) {}
    void add(const std::string& name, std::span<const unsigned char> bytes);
    /// Returns the archive; nothing can be added afterwards.
    std::vector<unsigned char> finish();

  private:
    std::filesystem::path path_;
    std::vector<unsigned char> bytes_, directory_;
    std::uint16_t entries_ = 0;
};

}  // namespace hogel::io::arrays
