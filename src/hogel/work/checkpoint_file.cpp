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
constexpr std::uint64_t max_header = std::uint64_t{16} << 20;  // kilobytes, unless options are long
constexpr std::uint64_t max_key = 4096;                        // numbers

std::uint32_t checksum_of(const void* data, std::size_t size) {
    return core::checksum(std::span(static_cast<const std::uint8_t*>(data), size));
}

// What precedes the key and the bytes of a record.
struct RecordHead {
    std::uint64_t checksum = 0, numbers = 0, bytes = 0;

    // Of the lengths and of what follows the head.
    std::uint64_t checksum_with(const std::vector<std::uint64_t>& key, std::string_view data) const {
        const std::uint64_t all[] = {numbers, bytes, checksum_of(key.data(), key.size() * sizeof(key[0])),
                                     checksum_of(data.data(), data.size())};
        return checksum_of(all, sizeof all);
    }
};
static_assert(sizeof(RecordHead) == checkpoint_record_head_bytes(0));

std::string line_of(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text;
}

// The lines of the work in a file, and where they end; nothing if it is no file of records.
std::optional<std::vector<std::string>> read_work(const core::RawFile& file, std::uint64_t& end) {
    const std::uint64_t most = std::min(max_header, file.size());
    std::string text;
    do {
        const std::size_t had = text.size();
        text.resize(std::min<std::uint64_t>(most, 2 * had + 4096));
        file.read(had, text.data() + had, text.size() - had);
        if (!text.starts_with(first_line)) return std::nullopt;
    } while (text.size() < most && text.find(fmt::format("\n{}", last_line)) == std::string::npos);
    std::vector<std::string> work;
    for (end = first_line.size(); text.compare(end, work_word.size(), work_word) == 0;) {
        const std::size_t line = end + work_word.size(), newline = text.find('\n', line);
        if (newline == std::string::npos) return std::nullopt;
        work.push_back(text.substr(line, newline - line));
        end = newline + 1;
    }
    if (text.compare(end, last_line.size(), last_line) != 0) return std::nullopt;
    end += last_line.size();
    return work;
}

// The record at a place, which is moved to its end; nothing if it is damaged or incomplete.
std::optional<CheckpointRecord> read_record(const core::RawFile& file, std::uint64_t& place, std::uint64_t max_bytes) {
    RecordHead head;
    std::uint64_t left = file.size() - place;
    if (left < sizeof head) return std::nullopt;
    file.read(place, &head, sizeof head);
    left -= sizeof head;
    if (head.numbers > max_key || head.numbers * sizeof(std::uint64_t) > left || head.bytes > max_bytes ||
        head.bytes > left - head.numbers * sizeof(std::uint64_t))
        return std::nullopt;
    CheckpointRecord record{std::vector<std::uint64_t>(head.numbers), std::string(head.bytes, '\0')};
    const std::uint64_t of_bytes = place + checkpoint_record_head_bytes(head.numbers);
    file.read(place + sizeof head, record.key.data(), head.numbers * sizeof(std::uint64_t));
    file.read(of_bytes, record.bytes.data(), head.bytes);
    if (head.checksum != head.checksum_with(record.key, record.bytes)) return std::nullopt;
    place = of_bytes + head.bytes;
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
        throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': another process is", path.string()));
    at_end_ = file_->size() == 0;
    const std::string header = checkpoint_header(work);
    at_end_ ? file_->write(0, header.data(), header.size()) : check_work(work);
    first_ = next_ = header.size();
}

// Compares the lines of the file with those of this work.
void CheckpointFile::check_work(const std::vector<std::string>& work) {
    std::uint64_t end = 0;
    const auto begun = read_work(*file_, end);
    if (!begun)
        throw Error(ErrorCode::bad_input, fmt::format("cannot resume '{}': it is no checkpoint of hogel; remove it to "
                                                      "begin again",
                                                      file_->name().string()));
    for (std::size_t i = 0; i < std::max(begun->size(), work.size()); ++i) {
        const std::string was = i < begun->size() ? (*begun)[i] : "", is = i < work.size() ? line_of(work[i]) : "";
        if (was != is)
            throw Error(ErrorCode::usage, fmt::format("cannot resume '{}': it was begun with '{}', not '{}'; remove it "
                                                      "to begin again",
                                                      file_->name().string(), was, is));
    }
}

void CheckpointFile::end_at(std::uint64_t place) {
    file_->resize(place);
    next_ = place;
    at_end_ = true;
}

std::optional<CheckpointRecord> CheckpointFile::read(const std::vector<std::uint64_t>* key) {
    if (at_end_) return std::nullopt;
    const std::uint64_t place = next_;
    std::optional<CheckpointRecord> record = read_record(*file_, next_, file_->size());
    if (record && (key == nullptr || record->key == *key)) return record;
    end_at(place);
    return std::nullopt;
}

void CheckpointFile::append(std::string_view records) {
    if (!file_) return;
    if (!at_end_) end_at(next_);
    file_->write(next_, records.data(), records.size());
    next_ += records.size();
}

void CheckpointFile::clear() {
    if (file_) end_at(first_);
}

void CheckpointFile::remove() {
    if (!file_) return;
    std::error_code ignored;
    std::filesystem::remove(file_->name(), ignored);
    file_.reset();
}

}  // namespace hogel::work
