// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/hdf5/part_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::io::hdf5 {
namespace {

constexpr std::string_view former_words = "hogel part 1 ";
constexpr std::uint64_t max_image = std::uint64_t{64} << 20;  // typically kilobytes, more with long options
constexpr std::size_t max_datasets = 256, max_axes = 8;

// Records of a band: sample bytes after a head, whose key is the dataset and the first byte.
constexpr std::uint64_t record_bytes = std::uint64_t{1} << 20, head_bytes = work::checkpoint_record_head_bytes(2);

// Returns the offset in a part file of byte `offset` of a band.
std::uint64_t file_offset(std::uint64_t records, std::uint64_t offset) {
    return records + offset + (offset / record_bytes + 1) * head_bytes;
}

// Returns the offsets of the datasets' records, and of the end.
std::vector<std::uint64_t> record_offsets(const PartHeader& header, std::uint64_t first) {
    std::vector<std::uint64_t> offsets{first};
    for (const PartHeader::Samples& dataset : header.datasets)
        offsets.push_back(file_offset(offsets.back(), dataset.bytes() - 1) + 1);
    return offsets;
}

work::CheckpointRecord record_of(const PartHeader& header) {
    std::vector<std::uint64_t> key{header.number, header.count, header.whole_bytes};
    for (const PartHeader::Samples& s : header.datasets) {
        key.insert(key.end(), {s.offset, s.element_bytes, s.band.axis, s.band.first, s.band.count, s.shape.size()});
        key.insert(key.end(), s.shape.begin(), s.shape.end());
    }
    return {std::move(key), header.image};
}

// Returns whether bands are inside their datasets, and datasets consecutive inside the file.
bool is_sound(const PartHeader& header) {
    constexpr std::uint64_t max_bytes = std::numeric_limits<std::int64_t>::max();
    if (header.number == 0 || header.number > header.count || header.datasets.empty() ||
        header.datasets.size() > max_datasets || header.whole_bytes > max_bytes)
        return false;
    std::uint64_t end = 0, samples = 0;
    for (const PartHeader::Samples& s : header.datasets) {
        if (s.shape.empty() || s.shape.size() > max_axes || s.band.axis >= s.shape.size() || s.element_bytes == 0)
            return false;
        std::uint64_t budget = max_bytes / s.element_bytes;
        for (const std::size_t extent : s.shape) {
            if (extent == 0) return false;
            budget /= extent;
        }
        const std::size_t rows = s.shape[s.band.axis];
        if (budget == 0 || s.band.count == 0 || s.band.first >= rows || s.band.count > rows - s.band.first ||
            s.offset < end || s.offset > header.whole_bytes || s.whole_bytes() > header.whole_bytes - s.offset)
            return false;
        end = s.offset + s.whole_bytes();
        samples += s.whole_bytes();
    }
    return header.whole_bytes - samples == header.image.size();
}

// Returns nothing if the record is not a header.
std::optional<PartHeader> header_of(work::CheckpointRecord record) {
    constexpr std::size_t of_file = 3, of_dataset = 6;
    if (record.key.size() < of_file) return std::nullopt;
    PartHeader header{record.key[0], record.key[1], record.key[2], {}, std::move(record.bytes)};
    for (std::span numbers = std::span(record.key).subspan(of_file); !numbers.empty();) {
        if (numbers.size() < of_dataset || numbers[5] > numbers.size() - of_dataset) return std::nullopt;
        const std::span shape = numbers.subspan(of_dataset, numbers[5]);
        header.datasets.push_back(
            {numbers[0], numbers[1], {shape.begin(), shape.end()}, {numbers[2], numbers[3], numbers[4]}});
        numbers = numbers.subspan(of_dataset + shape.size());
    }
    if (!is_sound(header)) return std::nullopt;
    return header;
}

// Throws for the former format of part files.
const std::filesystem::path& require_current(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    std::string start(std::min<std::uint64_t>(file.size(), former_words.size()), ' ');
    file.read(0, start.data(), start.size());
    if (start != former_words) return path;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("cannot read '{}': an earlier version of hogel wrote this part; write it again", path.string()));
}

}  // namespace

std::uint64_t PartHeader::Samples::whole_bytes() const {
    std::uint64_t bytes = element_bytes;
    for (const std::size_t extent : shape) bytes *= extent;
    return bytes;
}

std::uint64_t PartHeader::Samples::bytes() const { return whole_bytes() / shape[band.axis] * band.count; }

std::vector<std::pair<std::uint64_t, std::uint64_t>> PartHeader::image_runs() const {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> samples, runs;
    for (const Samples& dataset : datasets)
        samples.emplace_back(dataset.offset, dataset.offset + dataset.whole_bytes());
    std::ranges::sort(samples);
    std::uint64_t position = 0;
    for (const auto& [first, end] : samples) {
        if (first > position) runs.emplace_back(position, first);
        position = std::max(position, end);
    }
    if (position < whole_bytes) runs.emplace_back(position, whole_bytes);
    return runs;
}

std::vector<std::uint64_t> lay_out_part(const std::filesystem::path& path, const std::filesystem::path& target,
                                        const std::vector<std::string>& work, const Attributes& attributes,
                                        const std::vector<NewDataset>& datasets, const PartOf& part) {
    PartHeader header;
    header.number = part.number;
    header.count = part.count;
    {
        // The complete file without samples: sparse except for HDF5's own data.
        const core::OutputFile complete(target);
        const std::vector<std::uint64_t> offsets = lay_out_file(complete.temporary(), target, attributes, datasets);
        for (std::size_t i = 0; i < datasets.size(); ++i)
            header.datasets.push_back({offsets[i], bytes_of(datasets[i].element), datasets[i].shape, part.bands[i]});
        const core::RawFile raw(complete.temporary(), core::RawFile::Mode::read, target);
        header.whole_bytes = raw.size();
        for (const auto& [first, end] : header.image_runs()) {
            const std::size_t image_offset = header.image.size();
            header.image.resize(image_offset + (end - first));
            raw.read(first, header.image.data() + image_offset, end - first);
        }
    }
    std::vector<std::string> lines{part.input};
    lines.insert(lines.end(), work.begin(), work.end());
    const std::string start = work::checkpoint_header(lines) + record_of(header).encoded();
    std::vector<std::uint64_t> offsets = record_offsets(header, start.size());
    core::RawFile file(path, core::RawFile::Mode::create, target);
    file.reserve(offsets.back());
    file.resize(offsets.back());
    file.write(0, start.data(), start.size());
    file.close();
    offsets.pop_back();
    return offsets;
}

void write_to_records(core::RawFile& file, std::uint64_t records, std::uint64_t offset, const void* from,
                      std::uint64_t bytes) {
    const auto* source = static_cast<const char*>(from);
    for (std::uint64_t chunk = 0; bytes > 0; bytes -= chunk, offset += chunk, source += chunk) {
        chunk = std::min(bytes, record_bytes - offset % record_bytes);
        file.write(file_offset(records, offset), source, chunk);
    }
}

void complete_part(const std::filesystem::path& path, const std::filesystem::path& target) {
    const PartReader part(path);
    core::RawFile file(path, core::RawFile::Mode::write, target);
    for (std::size_t d = 0; d < part.records().size(); ++d) {
        const std::uint64_t bytes = part.header().datasets[d].bytes();
        work::parallel_for((bytes + record_bytes - 1) / record_bytes, [&](std::size_t i) {
            const std::uint64_t offset = i * record_bytes, record = file_offset(part.records()[d], offset);
            std::string samples(std::min(record_bytes, bytes - offset), '\0');
            file.read(record, samples.data(), samples.size());
            const std::string head = work::checkpoint_record_head({d, offset}, samples);
            file.write(record - head.size(), head.data(), head.size());
        });
    }
    file.close();
}

PartReader::PartReader(const std::filesystem::path& path) : file_(require_current(path), "part of a file of hogel's") {
    std::optional<work::CheckpointRecord> record = file_.read(max_image);
    std::optional<PartHeader> header = record ? header_of(std::move(*record)) : std::nullopt;
    if (!header) fail(path, "it is no part of a file of hogel's");
    header_ = std::move(*header);
    records_ = record_offsets(header_, file_.place());
    if (records_.back() != file_.size())
        fail(path, fmt::format("it has {} bytes, but its header tells of {}", file_.size(), records_.back()));
    records_.pop_back();
}

std::string PartReader::read(std::size_t dataset, std::uint64_t offset) {
    std::optional<work::CheckpointRecord> record = file_.read(record_bytes);
    const std::uint64_t remaining = header_.datasets[dataset].bytes() - offset;
    if (!record || record->key != std::vector<std::uint64_t>{dataset, offset} ||
        record->bytes.size() != std::min(record_bytes, remaining))
        fail(file_.name(), fmt::format("its samples are damaged, at byte {} of dataset {}", offset, dataset));
    return std::move(record->bytes);
}

}  // namespace hogel::io::hdf5
