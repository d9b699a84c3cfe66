// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/zip.h"
#include "hogel/core/stop_scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "hogel/error.h"
#include "hogel/io/arrays/inflate.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {
namespace {

constexpr std::uint32_t local_mark = 0x04034b50, directory_mark = 0x02014b50, end_mark = 0x06054b50,
                        end64_mark = 0x06064b50, locator_mark = 0x07064b50;
constexpr std::size_t local_bytes = 30, directory_bytes = 46, end_bytes = 22, locator_bytes = 20, end64_bytes = 56;
constexpr std::uint32_t in_extra = 0xffffffff;  // marker: the number is in the 64-bit extra field

// Bounds-checked access to the numbers of an archive.
class Archive {
  public:
    Archive(const std::filesystem::path& path, std::span<const unsigned char> bytes) : path_(path), bytes_(bytes) {}

    std::uint64_t number(std::uint64_t offset, std::size_t bytes) const {
        std::uint64_t value = 0;
        std::memcpy(&value, part(offset, bytes).data(), bytes);
        return value;
    }
    std::span<const unsigned char> part(std::uint64_t offset, std::uint64_t bytes) const {
        if (offset > bytes_.size() || bytes > bytes_.size() - offset) fail();
        return bytes_.subspan(offset, bytes);
    }
    [[noreturn]] void fail() const { fail_external(path_, "its ZIP archive is damaged or ends too early"); }

    std::uint64_t size() const { return bytes_.size(); }

  private:
    const std::filesystem::path& path_;
    std::span<const unsigned char> bytes_;
};

struct Directory {
    std::uint64_t entries = 0, begin = 0;
};

// Finds the record at the end, which a comment may follow.
Directory directory_of(const Archive& archive) {
    if (archive.size() < end_bytes) archive.fail();
    const std::uint64_t last = archive.size() - end_bytes;
    std::uint64_t end_record = last;
    while (archive.number(end_record, 4) != end_mark) {
        if (end_record == 0 || last - end_record > 0xffff) archive.fail();
        --end_record;
    }
    Directory directory{archive.number(end_record + 10, 2), archive.number(end_record + 16, 4)};
    if (end_record < locator_bytes || archive.number(end_record - locator_bytes, 4) != locator_mark) return directory;
    const std::uint64_t end64 = archive.number(end_record - locator_bytes + 8, 8);
    if (archive.part(end64, end64_bytes).empty() || archive.number(end64, 4) != end64_mark) archive.fail();
    return {archive.number(end64 + 32, 8), archive.number(end64 + 48, 8)};
}

// Replaces numbers that do not fit 32 bits by those of the extra field.
void read_extra(const Archive& archive, std::uint64_t position, std::uint64_t length,
                std::array<std::uint64_t*, 3> numbers) {
    for (const std::uint64_t end = position + length; position + 4 <= end;) {
        const std::uint64_t kind = archive.number(position, 2), size = archive.number(position + 2, 2);
        position += 4;
        if (kind == 1)
            for (std::uint64_t field = position; std::uint64_t * number : numbers)
                if (*number == in_extra) {
                    if (field + 8 > position + size) archive.fail();
                    *number = archive.number(field, 8);
                    field += 8;
                }
        position += size;
    }
}

}  // namespace

std::uint32_t crc32_of(std::span<const unsigned char> bytes) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> made{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xedb88320u : 0);
            made[i] = value;
        }
        return made;
    }();
    std::uint32_t crc = 0xffffffff;
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes_between_checks, bytes.size()))) {
        core::throw_if_stopped();
        for (const unsigned char byte : bytes.first(std::min(bytes_between_checks, bytes.size())))
            crc = table[(crc ^ byte) & 0xff] ^ (crc >> 8);
    }
    return ~crc;
}

std::vector<ZipEntry> read_zip(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    const Archive archive(path, bytes);
    const Directory directory = directory_of(archive);
    if (directory.entries > archive.size() / directory_bytes) archive.fail();
    std::vector<ZipEntry> entries;
    std::uint64_t entry_offset = directory.begin, packed_bytes = 0;
    for (std::uint64_t i = 0; i < directory.entries; ++i) {
        if (archive.number(entry_offset, 4) != directory_mark) archive.fail();
        const std::uint64_t flags = archive.number(entry_offset + 8, 2),
                            name_length = archive.number(entry_offset + 28, 2),
                            extra_length = archive.number(entry_offset + 30, 2),
                            comment_length = archive.number(entry_offset + 32, 2);
        ZipEntry entry;
        entry.method = static_cast<std::uint16_t>(archive.number(entry_offset + 10, 2));
        entry.crc = static_cast<std::uint32_t>(archive.number(entry_offset + 16, 4));
        std::uint64_t packed = archive.number(entry_offset + 20, 4), local = archive.number(entry_offset + 42, 4);
        entry.size = archive.number(entry_offset + 24, 4);
        read_extra(archive, entry_offset + directory_bytes + name_length, extra_length, {&entry.size, &packed, &local});
        const auto name = archive.part(entry_offset + directory_bytes, name_length);
        entry.name.assign(name.begin(), name.end());
        if ((flags & 1) != 0) fail_external(path, fmt::format("its file '{}' is encrypted", entry.name));
        if (archive.number(local, 4) != local_mark) archive.fail();
        // The local header has its own extra fields.
        const std::uint64_t data = local + local_bytes + archive.number(local + 26, 2) + archive.number(local + 28, 2);
        entry.packed = archive.part(data, packed);
        packed_bytes += packed;
        if (packed_bytes > archive.size()) fail_external(path, "files of its ZIP archive overlap");
        if (entry.size / max_expansion > packed || (entry.method == 0 && entry.size != packed)) archive.fail();
        entries.push_back(std::move(entry));
        entry_offset += directory_bytes + name_length + extra_length + comment_length;
    }
    return entries;
}

std::vector<unsigned char> unpack(const std::filesystem::path& path, const ZipEntry& entry) {
    std::vector<unsigned char> bytes(entry.size);
    if (entry.method == 0)
        std::ranges::copy(entry.packed, bytes.begin());
    else if (entry.method != 8)
        fail_external(path, fmt::format("its file '{}' is compressed by method {}; stored and deflated ones are read",
                                        entry.name, entry.method));
    else if (!inflate_bare(path, entry.packed, bytes))
        fail_external(path, fmt::format("its file '{}' is damaged", entry.name));
    if (crc32_of(bytes) != entry.crc) fail_external(path, fmt::format("its file '{}' is damaged", entry.name));
    return bytes;
}

namespace {

void put(std::vector<unsigned char>& to, std::uint64_t value, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i, value >>= 8) to.push_back(static_cast<unsigned char>(value));
}

// Writes the common part of both headers of a file: version 2.0, no flags, stored, 1980-01-01, checksum, sizes.
void put_facts(std::vector<unsigned char>& to, const std::string& name, std::span<const unsigned char> bytes) {
    constexpr std::uint64_t version = 20, date = 0x21;
    put(to, version, 2);
    put(to, 0, 6);
    put(to, date, 2);
    put(to, crc32_of(bytes), 4);
    put(to, bytes.size(), 4);
    put(to, bytes.size(), 4);
    put(to, name.size(), 2);
    put(to, 0, 2);
}

}  // namespace

void ZipWriter::add(const std::string& name, std::span<const unsigned char> bytes) {
    if (bytes_.size() + bytes.size() + (std::size_t{1} << 20) > in_extra)
        throw Error(
            ErrorCode::usage,
            fmt::format("'{}': an archive of more than 4 GiB was asked for, which is not written", path_.string()));
    put(directory_, directory_mark, 4);
    put(directory_, 20, 2);
    put_facts(directory_, name, bytes);
    put(directory_, 0, 10);
    put(directory_, bytes_.size(), 4);
    directory_.insert(directory_.end(), name.begin(), name.end());
    put(bytes_, local_mark, 4);
    put_facts(bytes_, name, bytes);
    bytes_.insert(bytes_.end(), name.begin(), name.end());
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    ++entries_;
}

std::vector<unsigned char> ZipWriter::finish() {
    const std::size_t begin = bytes_.size();
    bytes_.insert(bytes_.end(), directory_.begin(), directory_.end());
    put(bytes_, end_mark, 4);
    put(bytes_, 0, 4);
    put(bytes_, entries_, 2);
    put(bytes_, entries_, 2);
    put(bytes_, directory_.size(), 4);
    put(bytes_, begin, 4);
    put(bytes_, 0, 2);
    return std::move(bytes_);
}

}  // namespace hogel::io::arrays
