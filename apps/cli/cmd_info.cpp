// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "commands.h"
#include "hogel/files.h"
#include "hogel/image.h"
#include "hogel/printable.h"
#include "hogel/requests.h"
#include "hogel/scene.h"
#include "like.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

FileSummary summarize_picture(const std::string& path) {
    const Image image = read_image(path);
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float value : image.pixels.elements()) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    FileSummary summary;
    summary.kind = FileKind::picture;
    summary.text = {{"kind", "picture"}};
    for (const auto& entry : read_metadata(path)) summary.text.push_back(entry);
    summary.numbers = {{"width", static_cast<double>(image.width())},
                       {"height", static_cast<double>(image.height())},
                       {"channels", static_cast<double>(image.channels())},
                       {"lowest_linear_value", low},
                       {"highest_linear_value", high}};
    return summary;
}

FileSummary summarize_mesh(const std::string& path, const Progress& progress) {
    const Scene scene = import_scene(path, progress);
    const Bounds box = bounds(scene);
    FileSummary summary;
    summary.kind = FileKind::mesh;
    summary.text = {{"kind", "mesh"}};
    for (const auto& entry : scene.provenance) summary.text.push_back(entry);
    if (!scene.notes.empty()) summary.text.emplace_back("notes", fmt::format("{}", fmt::join(scene.notes, "; ")));
    summary.numbers = {{"meshes", static_cast<double>(scene.meshes.size())},
                       {"triangles", static_cast<double>(triangle_count(scene))},
                       {"lights", static_cast<double>(scene.lights.size())},
                       {"low_x", box.low.x},
                       {"low_y", box.low.y},
                       {"low_z", box.low.z},
                       {"high_x", box.high.x},
                       {"high_y", box.high.y},
                       {"high_z", box.high.z}};
    return summary;
}

// Returns the facts of another program's field, completed by the options.
FileSummary summarize_field(const std::string& path, const FieldParameters& field, const Command& command) {
    const ExternalFacts facts = external_facts(path, field.external_field());
    FileSummary summary;
    summary.kind = FileKind::hologram;
    summary.text = {{"kind", "field of another program"}, {"file_format", facts.format}, {"numbers", facts.numbers}};
    if (!facts.complaint.empty()) summary.text.emplace_back("not_taken", facts.complaint);
    const auto add = [&](const std::string& name, double value) { summary.numbers.emplace_back(name, value); };
    add("bytes", static_cast<double>(std::filesystem::file_size(path)));
    add("fields", static_cast<double>(facts.colours));
    const std::vector<double>& wavelengths = command.given("--wavelength") ? field.wavelengths : facts.wavelengths;
    const double pitch_x = command.given("--pitch") ? field.pitch : facts.pitch_x,
                 pitch_y = command.given("--pitch") ? field.pitch : facts.pitch_y;
    for (std::size_t i = 0; i < facts.colours; ++i) {
        const std::string prefix = fmt::format("field{}_", i);
        if (i < wavelengths.size()) add(prefix + "wavelength_m", wavelengths[i]);
        add(prefix + "samples_x", static_cast<double>(facts.width));
        add(prefix + "samples_y", static_cast<double>(facts.height));
        if (pitch_x > 0 && pitch_y > 0) {
            add(prefix + "pitch_x_m", pitch_x);
            add(prefix + "pitch_y_m", pitch_y);
            add(prefix + "width_m", static_cast<double>(facts.width) * pitch_x);
            add(prefix + "height_m", static_cast<double>(facts.height) * pitch_y);
        }
    }
    return summary;
}

// Returns the facts of a set of views, as read by `hogel import` without options.
FileSummary summarize_views(const std::string& path, const Progress& progress) {
    const ImportedViews views = import_views(path, {}, progress);
    const LightFieldGrid& grid = views.light_field.grid();
    FileSummary summary;
    summary.kind = FileKind::light_field;
    summary.text = {{"kind", "set of views"},
                    {"layout", views.layout},
                    {"transfer", transfer_names()[static_cast<std::size_t>(views.transfer)]},
                    {"understood", views.summary}};
    if (!views.notes.empty()) summary.text.emplace_back("notes", fmt::format("{}", fmt::join(views.notes, "; ")));
    if (!views.assumed.empty()) summary.text.emplace_back("assumed", fmt::format("{}", fmt::join(views.assumed, ", ")));
    if (std::filesystem::is_regular_file(path) && file_kind(path) == FileKind::picture)  // a quilt
        for (const auto& entry : read_metadata(path)) summary.text.push_back(entry);
    summary.numbers = {{"views_across", static_cast<double>(views.columns)},
                       {"views_down", static_cast<double>(views.rows)},
                       {"width", static_cast<double>(grid.hogels_s)},
                       {"height", static_cast<double>(grid.hogels_t)},
                       {"channels", static_cast<double>(grid.channels)},
                       {"bits", static_cast<double>(views.bits)},
                       {"parallax", views.parallax}};
    return summary;
}

FileSummary summarize_any(const std::string& path, const Progress& progress) {
    if (const auto run = run_of_make(path)) {
        FileSummary summary;
        const auto command = std::ranges::find(*run, "command", &Metadata::value_type::first);
        summary.text = {{"kind", "run of " + (command == run->end() ? std::string("hogel make") : command->second)}};
        summary.text.insert(summary.text.end(), run->begin(), run->end());
        return summary;
    }
    if (is_view_set(path)) return summarize_views(path, progress);
    switch (file_kind(path)) {
        case FileKind::light_field:
        case FileKind::hologram:
            return summarize(path);
        case FileKind::picture:
            return summarize_picture(path);
        case FileKind::mesh:
            return summarize_mesh(path, progress);
        case FileKind::unknown:
            break;
    }
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: is neither a light field, a hologram, a picture nor a mesh", path));
}

int info(const std::string& path, const FieldParameters& field, const Session& session) {
    FileSummary summary = field.is_external(path) && !field.is_pattern(path)
                              ? summarize_field(path, field, *session.command)
                              : summarize_any(path, Progress(session.stop.get_token()));
    if (std::string line = command_line_of(summary.text); !line.empty())
        summary.text.emplace_back("command_line", std::move(line));
    std::string words;
    for (const auto& [name, value] : summary.text)
        words += fmt::format("{:<24} {}\n", printable(name), printable(value));
    for (const auto& [name, value] : summary.numbers) words += fmt::format("{:<24} {:.9g}\n", printable(name), value);
    session.result(result_of(summary), words);
    return 0;
}

}  // namespace

void add_info(Command& command, Session& session) {
    auto path = std::make_shared<std::string>();
    auto field = std::make_shared<FieldParameters>();
    command.examples("  hogel info pumpkin.h5\n  hogel info hologram.h5 --json");
    command.positional("file", *path, "FILE",
                       "Light field, hologram, set of views, another program's field, picture or mesh");
    field->declare(command, true, true);
    command.work([path, field, &session] { return info(*path, *field, session); });
}

}  // namespace hogel::cli
