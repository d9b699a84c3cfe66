// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hogel::io::arrays {

/// A file in a ZIP archive.
struct ZipEntry {
    std::string name;
    std::uint32_t crc = 0;
    std::uint16_t method = 0;               ///< 0: stored, 8: deflated
    std::uint64_t size = 0;                 ///< bytes of the file
    std::span<const unsigned char> packed;  ///< as stored in the archive
};

/// The files in an archive, from its central directory (APPNOTE.TXT 6.3). Throws Error(bad_input) for a damaged
/// archive, and for sizes that its bytes cannot hold.
std::vector<ZipEntry> read_zip(const std::filesystem::path& path, std::span<const unsigned char> archive);

/// The bytes of a file. Throws Error(bad_input) where they are damaged, encrypted or compressed in another way, and
/// Error(not_built_in) for deflated ones in a build without zlib.
std::vector<unsigned char> unpack(const std::filesystem::path& path, const ZipEntry& entry);

/// CRC-32 as in ZIP, PNG and others.
std::uint32_t crc32_of(std::span<const unsigned char> bytes);

/// An archive of stored files, dated 1980-01-01. Throws Error(usage) for more than 4 GiB.
class ZipWriter {
  public:
    explicit ZipWriter(const std::filesystem::path& path) : path_(path) {}
    void add(const std::string& name, std::span<const unsigned char> bytes);
    /// The whole archive; nothing can be added then.
    std::vector<unsigned char> finish();

  private:
    std::filesystem::path path_;
    std::vector<unsigned char> bytes_, directory_;
    std::uint16_t entries_ = 0;
};

}  // namespace hogel::io::arrays
