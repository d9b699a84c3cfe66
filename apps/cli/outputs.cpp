// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "hogel/compress.h"
#include "hogel/error.h"
#include "hogel/units.h"
#include "hogel/version.h"
#include "inputs.h"

namespace hogel::cli {
namespace fs = std::filesystem;
namespace {

// Returns whether `hogel make` or `hogel print` writes files of this name.
bool is_output_of_a_run(const std::string& name) {
    for (const char* file : {"report.json", "report.html", "lightfield.h5", "hologram.h5"})
        if (name == file) return true;
    if (name.starts_with("part_")) return true;
    for (const char* beginning : {"photo_", "hogel_", "row_"})
        if (name.starts_with(beginning) && (name.ends_with(".png") || name.ends_with(".exr"))) return true;
    return false;
}

void refuse_outputs_of_another_run(const fs::path& folder) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (is_output_of_a_run(name))
            throw Error(
                ErrorCode::cannot_write,
                fmt::format("{}: contains {} of another run; choose another folder, or overwrite it with --force",
                            folder.string(), name));
    }
}

// Converts a fact stored as text; "yes" and "no" become booleans.
ResultValue value_of(const std::string& text) {
    if (text == "yes" || text == "no") return text == "yes";
    return text;
}

ResultValue value_of(double number) {
    constexpr double exact = 9007199254740992;  // 2⁵³: doubles represent all integers up to this
    if (std::abs(number) <= exact && number == std::trunc(number)) return static_cast<std::int64_t>(number);
    return number;
}

}  // namespace

void check_plan(const Session& session, const Plan& plan, const std::string& what, const fs::path& file, bool always) {
    require_resources(plan, what, file);
    const std::string time = plan.seconds > 0 ? fmt::format("about {} and ", format_duration(plan.seconds)) : "";
    const std::string needs = fmt::format("{} takes {}{} of memory", what, time, format_bytes(plan.memory));
    if (constexpr double long_work = 3600; plan.seconds > long_work)
        session.say(needs + "; Ctrl-C ends it");
    else if (always)
        session.say(needs);
    else
        session.detail(needs);
}

void add_force_flag(Command& command, bool& force) {
    command.flag("--force", force, "Overwrite the outputs of another run in the folder").never_acts();
}

void add_resume_flag(Command& command, bool& resume) {
    command
        .flag("--resume", resume, "Save a checkpoint when interrupted, FILE.part, and continue from it the next time")
        .never_acts();
}

std::vector<std::string> work_of(const Session& session, const std::string& input) {
    constexpr std::array<std::string_view, 7> idle{"output", "threads", "quiet", "verbose", "json", "resume", "force"};
    std::vector<std::string> work{"hogel " HOGEL_VERSION, "hogel " + session.command->name(), input};
    for (const auto& [name, value] : session.command->values())
        if (!value.empty() && !std::ranges::count(idle, name)) work.push_back(fmt::format("option {} {}", name, value));
    return work;
}

ResumableOutput::ResumableOutput(const Session& session, bool resume, const std::string& output,
                                 const std::string& input) {
    if (resume) scope_.emplace(output + ".part", work_of(session, input));
}

std::string PartOption::file_for(const std::string& output) const {
    if (!part) return output;
    return fs::path(output).replace_extension(fmt::format(".part-{}-of-{}", part->number, part->count)).string();
}

FilePart PartOption::of(const std::string& input) const { return {part->number, part->count, input}; }

void add_part_option(Command& command, PartOption& part) {
    command
        .parsed("--part", "K/N", "Write part K of N (K from 1) as FILE.part-K-of-N; hogel join joins the parts",
                [&part](const std::string& text) {
                    FilePart read;
                    const std::size_t slash = text.find('/');
                    const auto number = [&](const std::string& digits, std::size_t& value) {
                        const char* end = digits.data() + digits.size();
                        const auto [stop, error] = std::from_chars(digits.data(), end, value);
                        return error == std::errc() && stop == end;
                    };
                    if (slash == std::string::npos || !number(text.substr(0, slash), read.number) ||
                        !number(text.substr(slash + 1), read.count) || read.number == 0 || read.number > read.count)
                        throw Error(ErrorCode::usage, "part",
                                    fmt::format("'{}' is not a part K/N with K from 1 to N, such as 2/5", text));
                    part.part = read;
                })
        .never_acts();
}

void report_part(const Session& session, const std::string& file, const FilePart& part) {
    session.say(fmt::format("{}: part {} of {}, {}", file, part.number, part.count,
                            format_bytes(static_cast<double>(fs::file_size(file)))));
    report_file(session, file, {{"part", part.number}, {"parts", part.count}});
}

void LightFieldOutput::require(const std::string& input) const {
    if (compressed() && single)
        throw Error(ErrorCode::usage, "float", fmt::format("applies to HDF5 files; {} is a compressed one", file));
    if (sqnr && !compressed())
        throw Error(ErrorCode::usage, "sqnr", fmt::format("applies to compressed files (.hgl), not to {}", file));
    require_writable(file, {&input, 1});
    if (!compressed()) require_hdf5(file);
}

void add_light_field_output(Command& command, LightFieldOutput& output, const std::string& depth_help,
                            const std::string& float_help) {
    command.text("-o,--output", output.file, "FILE", "Light field to write: HDF5, or compressed if it ends in .hgl")
        .required()
        .never_acts();
    command.flag("--depth", output.with_depth, depth_help);
    command.flag("--float", output.single, float_help).acts_if([&output] { return !output.compressed(); });
    command.number(
        "--sqnr", output.sqnr, "DB",
        fmt::format("Signal-to-noise ratio of a compressed light field, exceeded by at most 0.1 dB (default: {})",
                    defaults.sqnr));
}

void write_compressed(LightFieldOutput& output, const LightField& source, const Session& session,
                      const std::optional<std::string>& resume_input) {
    // The coder reads each tile several times.
    const LightField light_field = prepare_for_reading(session, source, 2, output.with_depth);
    CompressionOptions compression;
    if (!output.sqnr) output.sqnr = defaults.sqnr;
    compression.target = Sqnr{*output.sqnr};
    compression.with_depth = output.with_depth;
    compression.metadata = run_metadata(session);
    ResumableOutput resumable(session, resume_input.has_value(), output.file, resume_input.value_or(""));
    Stage stage(session, "compressing");
    const CompressionResult result =
        resumable.unless_refused([&] { return compress(light_field, output.file, compression, stage.progress()); });
    resumable.complete();
    report_compressed(session, output.file, result);
}

void report_compressed(const Session& session, const std::string& file, const CompressionResult& result) {
    session.say(fmt::format("{}: {}, {:.2f} dB, {:.4g} pixels per bit, coded {} {}", file,
                            format_bytes(static_cast<double>(result.bytes)), result.sqnr, result.pixels_per_bit,
                            result.passes, result.passes == 1 ? "time" : "times"));
    if (result.depth_bytes > 0)
        session.say(fmt::format(
            "of which depth: {}, {}", format_bytes(static_cast<double>(result.depth_bytes)),
            result.depth_error > 0 ? fmt::format("to within {:.3g} m", result.depth_error) : std::string("exact")));
    report_samples(session, file, {{"sqnr", result.sqnr}, {"step", result.step}, {"passes", result.passes}});
}

Result result_of(const FileSummary& summary) {
    Result result;
    for (const auto& [name, value] : summary.text) result.emplace_back(name, value_of(value));
    for (const auto& [name, value] : summary.numbers) result.emplace_back(name, value_of(value));
    return result;
}

void report_samples(const Session& session, const std::string& file, const Result& more) {
    if (!session.json) return;
    FileSummary summary = summarize(file);
    const Provenance provenance = summary.kind == FileKind::light_field ? open_light_field(file).provenance()
                                                                        : open_hologram(file).front()->provenance();
    for (const auto& entry : to_metadata(provenance)) std::erase(summary.text, entry);
    Result result{{"file", file}};
    for (const Result& part : {result_of(summary), more}) result.insert(result.end(), part.begin(), part.end());
    result.emplace_back("seconds", session.seconds());
    session.result(result);
}

void report_file(const Session& session, const std::string& file, const Result& more) {
    if (!session.json) return;
    Result result{{"file", file}, {"bytes", fs::file_size(file)}};
    result.insert(result.end(), more.begin(), more.end());
    result.emplace_back("seconds", session.seconds());
    session.result(result);
}

ResultList wavelengths_of(std::span<const FieldGrid> grids) {
    ResultList list;
    for (const FieldGrid& grid : grids) list.emplace_back(grid.wavelength);
    return list;
}

OutputFolder::OutputFolder(fs::path path, bool force) : path_(std::move(path)) {
    require_folder_name(path_);
    std::error_code error;
    created_ = fs::create_directories(path_, error);
    if (error || !fs::is_directory(path_))
        throw Error(ErrorCode::cannot_write, fmt::format("{}: cannot create this folder: {}", path_.string(),
                                                         error ? error.message() : "a file has its name"));
    if (!force) refuse_outputs_of_another_run(path_);
    require_writable(path_ / "report.html");
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    if (created_) fs::remove(path_, ignored);  // succeeds only for an empty folder
}

}  // namespace hogel::cli
