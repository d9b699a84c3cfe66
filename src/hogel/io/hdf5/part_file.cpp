// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/hdf5/part_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

#include "hogel/core/checksum.h"
#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"

namespace hogel::io::hdf5 {
namespace {

constexpr std::string_view first_words = "hogel part 1 ";
constexpr std::uint64_t chunk_alignment = 4096;
// The text of the header and the image of a file are kilobytes, unless options are long.
constexpr std::uint64_t max_text = std::uint64_t{16} << 20, max_image = std::uint64_t{64} << 20;
constexpr std::size_t max_datasets = 256, max_axes = 8, first_line_bytes = 64;

std::string line_of(const std::string& text) {
    std::string line = text;
    std::ranges::replace(line, '\n', ' ');
    return line;
}

std::string text_of(const PartHeader& header) {
    std::string text = fmt::format("part {} of {}\nwhole {}\n", header.number, header.count, header.whole_bytes);
    for (const std::string& line : header.work) text += fmt::format("work {}\n", line_of(line));
    for (const PartHeader::Samples& s : header.datasets)
        text += fmt::format("dataset {} {} {} {} {} {}\n", s.offset, s.element_bytes, s.band.axis, s.band.first,
                            s.band.count, fmt::join(s.shape, " "));
    return text + fmt::format("image {}\n", header.image.size());
}

std::uint64_t aligned(std::uint64_t offset) {
    return (offset + chunk_alignment - 1) / chunk_alignment * chunk_alignment;
}

// Where the bands lie, after first line, text and image.
void place_bands(PartHeader& header, std::uint64_t text_bytes) {
    header.offsets.clear();
    std::uint64_t at = first_line_bytes + text_bytes + header.image.size();
    for (const PartHeader::Samples& dataset : header.datasets) {
        header.offsets.push_back(aligned(at));
        at = header.offsets.back() + dataset.bytes();
    }
}

std::span<const std::uint8_t> bytes_of_text(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

[[noreturn]] void fail_damaged(const std::filesystem::path& path) {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': its header is damaged", path.string()));
}

// Reads the lines of a header. Returns false if one is not as it should be.
bool read_lines(const std::string& text, PartHeader& header, std::uint64_t& image_bytes) {
    std::istringstream lines(text);
    bool numbered = false, sized = false, imaged = false;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word, of;
        words >> word;
        if (word == "part") {
            numbered = static_cast<bool>(words >> header.number >> of >> header.count);
        } else if (word == "whole") {
            sized = static_cast<bool>(words >> header.whole_bytes);
        } else if (word == "work") {
            header.work.push_back(line.size() > 5 ? line.substr(5) : "");
        } else if (word == "image") {
            imaged = static_cast<bool>(words >> image_bytes);
        } else if (word == "dataset") {
            PartHeader::Samples s;
            if (!(words >> s.offset >> s.element_bytes >> s.band.axis >> s.band.first >> s.band.count)) return false;
            for (std::size_t extent = 0; words >> extent;) s.shape.push_back(extent);
            header.datasets.push_back(std::move(s));
        } else {
            return false;
        }
    }
    return numbered && sized && imaged;
}

// Whether the numbers fit together: bands inside of datasets, and these one after the other inside of the file.
bool is_sound(const PartHeader& header, std::uint64_t image_bytes) {
    constexpr std::uint64_t max_bytes = std::numeric_limits<std::int64_t>::max();
    if (header.number == 0 || header.number > header.count || header.datasets.empty() ||
        header.datasets.size() > max_datasets || header.whole_bytes > max_bytes || image_bytes > max_image)
        return false;
    std::uint64_t at = 0, samples = 0;
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
            s.offset < at || s.offset > header.whole_bytes || s.whole_bytes() > header.whole_bytes - s.offset)
            return false;
        at = s.offset + s.whole_bytes();
        samples += s.whole_bytes();
    }
    return header.whole_bytes - samples == image_bytes;
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
    std::uint64_t at = 0;
    for (const auto& [first, end] : samples) {
        if (first > at) runs.emplace_back(at, first);
        at = std::max(at, end);
    }
    if (at < whole_bytes) runs.emplace_back(at, whole_bytes);
    return runs;
}

std::uint64_t PartHeader::bytes() const { return offsets.back() + datasets.back().bytes(); }

std::vector<std::uint64_t> lay_out_part(const std::filesystem::path& path, const std::filesystem::path& target,
                                        const std::vector<std::string>& work, const Attributes& attributes,
                                        const std::vector<NewDataset>& datasets, const PartOf& part) {
    PartHeader header;
    header.number = part.number;
    header.count = part.count;
    header.work = work;
    header.work.insert(header.work.begin(), part.input);
    {
        // The whole file without samples, all holes but for what HDF5 writes.
        const core::OutputFile whole(target);
        const std::vector<std::uint64_t> offsets = lay_out_file(whole.temporary(), target, attributes, datasets);
        for (std::size_t i = 0; i < datasets.size(); ++i)
            header.datasets.push_back({offsets[i], bytes_of(datasets[i].element), datasets[i].shape, part.bands[i]});
        const core::RawFile raw(whole.temporary(), core::RawFile::Mode::read, target);
        header.whole_bytes = raw.size();
        for (const auto& [first, end] : header.image_runs()) {
            const std::size_t at = header.image.size();
            header.image.resize(at + (end - first));
            raw.read(first, header.image.data() + at, end - first);
        }
    }
    const std::string text = text_of(header);
    place_bands(header, text.size());
    std::vector<std::uint8_t> checked(bytes_of_text(text).begin(), bytes_of_text(text).end());
    checked.insert(checked.end(), header.image.begin(), header.image.end());
    const std::string first_line = fmt::format("{}{} {:08x}", first_words, text.size(), core::checksum(checked));
    const std::string padded = fmt::format("{:<{}}\n", first_line, first_line_bytes - 1);
    core::RawFile file(path, core::RawFile::Mode::create, target);
    file.reserve(header.bytes());
    file.resize(header.bytes());
    file.write(0, padded.data(), padded.size());
    file.write(padded.size(), checked.data(), checked.size());
    file.close();
    return header.offsets;
}

PartHeader read_part_header(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    std::string first_line(first_line_bytes, ' ');
    if (file.size() < first_line.size())
        throw Error(ErrorCode::bad_input,
                    fmt::format("cannot read '{}': it is no part of a file of hogel's", path.string()));
    file.read(0, first_line.data(), first_line.size());
    if (!first_line.starts_with(first_words))
        throw Error(ErrorCode::bad_input,
                    fmt::format("cannot read '{}': it is no part of a file of hogel's", path.string()));
    std::istringstream words(first_line.substr(first_words.size()));
    std::uint64_t text_bytes = 0, image_bytes = 0;
    std::uint32_t sum = 0;
    if (!(words >> text_bytes >> std::hex >> sum) || text_bytes > max_text ||
        text_bytes > file.size() - first_line.size())
        fail_damaged(path);
    std::string text(text_bytes, ' ');
    file.read(first_line.size(), text.data(), text.size());
    PartHeader header;
    if (!read_lines(text, header, image_bytes) || !is_sound(header, image_bytes) ||
        image_bytes > file.size() - first_line.size() - text.size())
        fail_damaged(path);
    header.image.resize(image_bytes);
    file.read(first_line.size() + text.size(), header.image.data(), image_bytes);
    std::vector<std::uint8_t> checked(bytes_of_text(text).begin(), bytes_of_text(text).end());
    checked.insert(checked.end(), header.image.begin(), header.image.end());
    if (core::checksum(checked) != sum) fail_damaged(path);
    place_bands(header, text.size());
    if (file.size() != header.bytes())
        throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': it has {} bytes, but its header tells of {}",
                                                      path.string(), file.size(), header.bytes()));
    return header;
}

}  // namespace hogel::io::hdf5
