// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/checkpoint_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "hogel/core/checksum.h"
#include "hogel/error.h"

namespace hogel::work {
namespace {

constexpr std::string_view first_line = "hogel checkpoint 1\n", last_line = "records\n", work_word = "work ";
constexpr std::uint64_t max_header = std::uint64_t{16} << 20;  // a header has kilobytes, unless options are long
constexpr std::uint64_t max_key = 4096;                        // number of values

std::uint32_t checksum_of(const void* data, std::size_t size) {
    return core::checksum(std::span(static_cast<const std::uint8_t*>(data), size));
}

// The first part of a record, before the key and the result bytes.
struct RecordHead {
    std::uint64_t checksum = 0, numbers = 0, bytes = 0;

    // Returns the checksum of the lengths, the key and the result bytes.
    std::uint64_t checksum_with(const std::vector<std::uint64_t>& key, std::string_view data) const {
        const std::uint64_t fields[] = {numbers, bytes, checksum_of(key.data(), key.size() * sizeof(key[0])),
                                        checksum_of(data.data(), data.size())};
        return checksum_of(fields, sizeof fields);
    }
};
static_assert(sizeof(RecordHead) == checkpoint_record_head_bytes(0));

std::string line_of(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text;
}

// Returns the work lines of a file, and in `end` the offset after the header; nothing if it is not a checkpoint file.
std::optional<std::vector<std::string>> read_work(const core::RawFile& file, std::uint64_t& end) {
    const std::uint64_t limit = std::min(max_header, file.size());
    std::string text;
    do {
        const std::size_t old_size = text.size();
        text.resize(std::min<std::uint64_t>(limit, 2 * old_size + 4096));
        file.read(old_size, text.data() + old_size, text.size() - old_size);
        if (!text.starts_with(first_line)) return std::nullopt;
    } while (text.size() < limit && text.find(fmt::format("\n{}", last_line)) == std::string::npos);
    std::vector<std::string> work;
    for (end = first_line.size(); text.compare(end, work_word.size(), work_word) == 0;) {
        const std::size_t begin = end + work_word.size(), newline = text.find('\n', begin);
        if (newline == std::string::npos) return std::nullopt;
        work.push_back(text.substr(begin, newline - begin));
        end = newline + 1;
    }
    if (text.compare(end, last_line.size(), last_line) != 0) return std::nullopt;
    end += last_line.size();
    return work;
}

// Reads the record at `offset` and advances `offset` to its end. Returns nothing if it is damaged or incomplete.
std::optional<CheckpointRecord> read_record(const core::RawFile& file, std::uint64_t& offset, std::uint64_t max_bytes) {
    RecordHead head;
    std::uint64_t remaining = file.size() - offset;
    if (remaining < sizeof head) return std::nullopt;
    file.read(offset, &head, sizeof head);
    remaining -= sizeof head;
    if (head.numbers > max_key || head.numbers * sizeof(std::uint64_t) > remaining || head.bytes > max_bytes ||
        head.bytes > remaining - head.numbers * sizeof(std::uint64_t))
        return std::nullopt;
    CheckpointRecord record{std::vector<std::uint64_t>(head.numbers), std::string(head.bytes, '\0')};
    const std::uint64_t result_offset = offset + checkpoint_record_head_bytes(head.numbers);
    file.read(offset + sizeof head, record.key.data(), head.numbers * sizeof(std::uint64_t));
    file.read(result_offset, record.bytes.data(), head.bytes);
    if (head.checksum != head.checksum_with(record.key, record.bytes)) return std::nullopt;
    offset = result_offset + head.bytes;
    return record;
}

}  // namespace

std::string checkpoint_record_head(const std::vector<std::uint64_t>& key, std::string_view bytes) {
    RecordHead head{0, key.size(), bytes.size()};
    head.checksum = head.checksum_with(key, bytes);
    std::string text(checkpoint_record_head_bytes(key.size()), '\0');
    std::memcpy(text.data(), &head, sizeof head);
    if (!key.empty()) std::memcpy(text.data() + sizeof head, key.data(), text.size() - sizeof head);
    return text;
}

std::string CheckpointRecord::encoded() const { return checkpoint_record_head(key, bytes) + bytes; }

std::string checkpoint_header(const std::vector<std::string>& work) {
    std::string header(first_line);
    for (const std::string& line : work) header += fmt::format("{}{}\n", work_word, line_of(line));
    return header.append(last_line);
}

CheckpointReader::CheckpointReader(const std::filesystem::path& path, std::string_view kind)
    : file_(path, core::RawFile::Mode::read, path) {
    std::optional<std::vector<std::string>> work = read_work(file_, next_);
    if (!work) throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': it is no {}", path.string(), kind));
    work_ = std::move(*work);
}

std::optional<CheckpointRecord> CheckpointReader::read(std::uint64_t max_bytes) {
    if (next_ == file_.size()) return std::nullopt;
    std::optional<CheckpointRecord> record = read_record(file_, next_, max_bytes);
    if (record) return record;
    throw Error(ErrorCode::bad_input,
                fmt::format("cannot read '{}': it is damaged from byte {} on", file_.name().string(), next_));
}

CheckpointFile::CheckpointFile(const std::filesystem::path& path, const std::vector<std::string>& work) {
    if (path.empty()) return;
    file_.emplace(path, core::RawFile::Mode::kept, path);
    if (!file_->lock())
        throw Error(ErrorCode::cannot_write,
                    fmt::format("cannot write '{}': another process is writing to it", path.string()));
    at_end_ = file_->size() == 0;
    const std::string header = checkpoint_header(work);
    at_end_ ? file_->write(0, header.data(), header.size()) : check_work(work);
    first_ = next_ = header.size();
}

// Compares the lines of the file with those of this work.
void CheckpointFile::check_work(const std::vector<std::string>& work) {
    std::uint64_t end = 0;
    const auto stored = read_work(*file_, end);
    if (!stored)
        throw Error(ErrorCode::bad_input,
                    fmt::format("cannot resume '{}': it is not a checkpoint of hogel; remove it to begin again",
                                file_->name().string()));
    for (std::size_t i = 0; i < std::max(stored->size(), work.size()); ++i) {
        const std::string was = i < stored->size() ? (*stored)[i] : "", is = i < work.size() ? line_of(work[i]) : "";
        if (was != is)
            throw Error(ErrorCode::usage,
                        fmt::format("cannot resume '{}': it was begun with '{}', not '{}'; remove it to begin again",
                                    file_->name().string(), was, is));
    }
}

void CheckpointFile::truncate(std::uint64_t offset) {
    file_->resize(offset);
    next_ = offset;
    at_end_ = true;
}

std::optional<CheckpointRecord> CheckpointFile::read(const std::vector<std::uint64_t>* key) {
    if (at_end_) return std::nullopt;
    const std::uint64_t offset = next_;
    std::optional<CheckpointRecord> record = read_record(*file_, next_, file_->size());
    if (record && (key == nullptr || record->key == *key)) return record;
    truncate(offset);
    return std::nullopt;
}

void CheckpointFile::append(std::string_view records) {
    if (!file_) return;
    if (!at_end_) truncate(next_);
    file_->write(next_, records.data(), records.size());
    next_ += records.size();
}

void CheckpointFile::clear() {
    if (file_) truncate(first_);
}

void CheckpointFile::remove() {
    if (!file_) return;
    std::error_code ignored;
    std::filesystem::remove(file_->name(), ignored);
    file_.reset();
}

}  // namespace hogel::work
