// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/io/hdf5/part_file.h"
#include "hogel/io/part_sinks.h"

namespace hogel::io {
namespace {

using hdf5::PartHeader;

struct Part {
    std::filesystem::path path;
    PartHeader header;
    std::vector<std::string> work;
};

Part open_part(const std::filesystem::path& path) {
    const hdf5::PartReader reader(path);
    return {path, reader.header(), reader.work()};
}

[[noreturn]] void fail(const std::string& why) {
    throw Error(ErrorCode::bad_input, fmt::format("cannot join parts: {}", why));
}

// Throws unless two parts were made with the same work.
void require_same_file(const Part& a, const Part& b) {
    if (a.header.count != b.header.count)
        fail(fmt::format("'{}' is one of {} parts, '{}' one of {}", a.path.string(), a.header.count, b.path.string(),
                         b.header.count));
    const std::size_t lines = std::max(a.work.size(), b.work.size());
    for (std::size_t i = 0; i < lines; ++i) {
        const auto line = [i](const Part& part) {
            return i < part.work.size() ? part.work[i] : std::string("nothing more");
        };
        if (line(a) != line(b))
            fail(fmt::format("they belong to different files: '{}' was made with '{}', '{}' with '{}'", a.path.string(),
                             line(a), b.path.string(), line(b)));
    }
    if (a.header.image != b.header.image || a.header.whole_bytes != b.header.whole_bytes)
        fail(fmt::format("'{}' and '{}' belong to different files", a.path.string(), b.path.string()));
}

// Returns the parts in order, after all checks.
std::vector<Part> open_parts(std::span<const std::filesystem::path> paths) {
    if (paths.empty()) fail("none was named");
    std::vector<std::optional<Part>> slots;
    for (const std::filesystem::path& path : paths) {
        Part part = open_part(path);
        if (slots.empty()) {
            if (part.header.count > 1'000'000) fail(fmt::format("'{}' is one of too many", path.string()));
            slots.resize(part.header.count);
        }
        for (const std::optional<Part>& first : slots)
            if (first) {
                require_same_file(*first, part);
                break;
            }
        std::optional<Part>& slot = slots[part.header.number - 1];
        if (slot)
            fail(fmt::format("'{}' and '{}' are both part {} of {}", slot->path.string(), path.string(),
                             part.header.number, part.header.count));
        slot = std::move(part);
    }
    std::vector<Part> parts;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (!slots[i]) fail(fmt::format("part {} of {} is missing", i + 1, slots.size()));
        parts.push_back(std::move(*slots[i]));
    }
    return parts;
}

// Throws unless the bands of the parts are consecutive and complete.
void require_all_rows(const std::vector<Part>& parts) {
    for (std::size_t d = 0; d < parts.front().header.datasets.size(); ++d) {
        const PartHeader::Samples& first = parts.front().header.datasets[d];
        std::size_t row = 0;
        for (const Part& part : parts) {
            if (part.header.datasets.size() != parts.front().header.datasets.size())
                fail(fmt::format("'{}' has other datasets", part.path.string()));
            const PartHeader::Samples& s = part.header.datasets[d];
            if (s.shape != first.shape || s.offset != first.offset || s.band.axis != first.band.axis ||
                s.band.first != row)
                fail(fmt::format("'{}' begins at row {} instead of {}", part.path.string(), s.band.first, row));
            row += s.band.count;
        }
        if (row != first.shape[first.band.axis])
            fail(fmt::format("they have {} of {} rows", row, first.shape[first.band.axis]));
    }
}

class Joiner {
  public:
    Joiner(core::RawFile& out, const std::vector<Part>& parts, const Progress& progress)
        : out_(out), progress_(progress) {
        for (const Part& part : parts)
            for (const PartHeader::Samples& s : part.header.datasets) all_ += s.bytes();
    }

    // Copies the bands of a part: one run per index of the axes before the band's.
    void copy(const Part& part) {
        hdf5::PartReader in(part.path);
        for (std::size_t d = 0; d < in.header().datasets.size(); ++d) {
            const PartHeader::Samples& dataset = in.header().datasets[d];
            for (std::uint64_t offset = 0; offset < dataset.bytes();) {
                core::throw_if_stopped();
                const std::string samples = in.read(d, offset);
                write(dataset, offset, samples);
                offset += samples.size();
                done_ += samples.size();
                progress_.report(static_cast<double>(done_) / static_cast<double>(all_));
            }
        }
    }

  private:
    // Writes bytes of a band, starting at byte `offset` of the band.
    void write(const PartHeader::Samples& s, std::uint64_t offset, std::string_view bytes) {
        std::uint64_t row = s.element_bytes;
        for (std::size_t axis = s.band.axis + 1; axis < s.shape.size(); ++axis) row *= s.shape[axis];
        const std::uint64_t run = row * s.band.count;
        for (std::uint64_t chunk = 0; !bytes.empty(); bytes.remove_prefix(chunk), offset += chunk) {
            chunk = std::min<std::uint64_t>(bytes.size(), run - offset % run);
            const std::uint64_t rows = offset / run * s.shape[s.band.axis] + s.band.first;
            out_.write(s.offset + rows * row + offset % run, bytes.data(), chunk);
        }
    }

    core::RawFile& out_;
    const Progress& progress_;
    std::uint64_t all_ = 0, done_ = 0;
};

}  // namespace

void join_parts(const std::filesystem::path& path, std::span<const std::filesystem::path> paths,
                const Progress& progress) {
    const core::StopScope scope(progress);
    require_name(path, "hdf5");
    const std::vector<Part> parts = open_parts(paths);
    require_all_rows(parts);
    core::OutputFile output(path);
    core::RawFile out(output.temporary(), core::RawFile::Mode::write, path);
    const PartHeader& header = parts.front().header;
    out.reserve(header.whole_bytes);
    out.resize(header.whole_bytes);
    std::uint64_t image_offset = 0;
    for (const auto& [first, end] : header.image_runs()) {
        out.write(first, header.image.data() + image_offset, end - first);
        image_offset += end - first;
    }
    Joiner joiner(out, parts, progress);
    for (const Part& part : parts) joiner.copy(part);
    out.close();
    output.commit();
}

}  // namespace hogel::io
