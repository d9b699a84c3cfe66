// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/summary.h"

#include "hogel/io/hdf5/files.h"
#include "hogel/io/hdf5/grids.h"
#include "hogel/io/hdf5/rehearsal.h"

namespace hogel::io::hdf5 {
namespace {

const char* name_of(Element element) { return element == Element::half ? "half" : "single"; }

void summarize_light_field(hid_t file, const std::filesystem::path& path, FileSummary& summary) {
    const std::vector<LightFieldGrid> grids = read_light_field_grids(file, path);
    describe(grids.front(), summary);
    describe_faces(grids, summary);
    const auto raw = std::make_shared<core::RawFile>(path, core::RawFile::Mode::read, path);
    summary.text.emplace_back("samples", name_of(radiance_of_front(file, grids.front(), raw).element()));
    summary.text.emplace_back("depth", has_member(file, "depth", path) ? "yes" : "no");
}

void summarize_hologram(hid_t file, const std::filesystem::path& path, FileSummary& summary) {
    const std::vector<FieldGrid> grids = read_hologram_grids(file, path);
    summary.numbers.emplace_back("fields", static_cast<double>(grids.size()));
    for (std::size_t i = 0; i < grids.size(); ++i) describe(grids[i], i, summary);
    const auto raw = std::make_shared<core::RawFile>(path, core::RawFile::Mode::read, path);
    summary.text.emplace_back("samples", name_of(samples_of_field(file, 0, grids[0], raw).element()));
}

}  // namespace

FileKind kind_of(const std::filesystem::path& path) {
    return with_rehearsal(path, "kind", [&] {
        const Handle file = open_file(path);
        if (!has_attribute(file.id(), "format", path)) return FileKind::unknown;
        const std::string format = read_text(file.id(), "format", path);
        if (format == light_field_format) return FileKind::light_field;
        return format == hologram_format ? FileKind::hologram : FileKind::unknown;
    });
}

void summarize(const std::filesystem::path& path, FileSummary& summary) {
    summary = with_rehearsal(path, "summary", [&, facts = summary] {
        FileSummary all = facts;
        const Handle file = open_file(path);
        all.text.emplace_back("format", read_text(file.id(), "format", path));
        all.numbers.emplace_back("format_version", static_cast<double>(read_count(file.id(), "format_version", path)));
        if (all.kind == FileKind::light_field)
            summarize_light_field(file.id(), path, all);
        else
            summarize_hologram(file.id(), path, all);
        for (auto& word : read_metadata(file.id(), path)) all.text.push_back(std::move(word));
        return all;
    });
}

}  // namespace hogel::io::hdf5
