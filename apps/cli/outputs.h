// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line.h"
#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/resume.h"
#include "run_record.h"
#include "session.h"

namespace hogel::cli {

/// Throws, with the numbers, if the work `what` needs more memory or disk space than is available. Prints the plan if
/// it takes more than an hour, and always with --verbose or `always`.
void check_plan(const Session& session, const Plan& plan, const std::string& what,
                const std::filesystem::path& file = {}, bool always = false);

/// Adds --force, for folders that may contain the outputs of another run.
void add_force_flag(Command& command, bool& force);

/// Adds --resume, for outputs that take long.
void add_resume_flag(Command& command, bool& resume);

/// Returns the texts that identify the work of a command: version, command, input and options.
/// @param input  from describe_input()
std::vector<std::string> work_of(const Session& session, const std::string& input);

/// Checkpoint of an output in "FILE.part": the same command continues from it after an interruption. Does nothing
/// without --resume. For outputs other than HDF5 files, which have a journal.
class ResumableOutput {
  public:
    /// @param input  as for work_of()
    ResumableOutput(const Session& session, bool resume, const std::string& output, const std::string& input);
    /// Calls `work`, which writes files of its own, unless a previous run completed it.
    void once(const std::function<void()>& work) {
        if (scope_)
            scope_->once(work);
        else
            work();
    }
    /// Calls `work` and returns its result. Removes the checkpoint after a usage error, which would occur again.
    template <class Work>
    auto unless_refused(const Work& work) {
        try {
            return work();
        } catch (const Error& error) {
            if (error.code() == ErrorCode::usage) complete();
            throw;
        }
    }
    /// Removes the checkpoint of a complete output.
    void complete() {
        if (scope_) scope_->complete();
    }

  private:
    std::optional<ResumeScope> scope_;
};

/// Part of an output; none: the entire output.
struct PartOption {
    std::optional<FilePart> part;

    /// Returns the name of the file to write: "X.part-2-of-5" for X.h5.
    std::string file_for(const std::string& output) const;
    /// Returns the part with the input that all parts must share.
    FilePart of(const std::string& input) const;
};
/// Adds --part.
void add_part_option(Command& command, PartOption& part);
/// Reports a written part; with --json prints the result.
void report_part(const Session& session, const std::string& file, const FilePart& part);

/// Light field written by a command: an HDF5 file, or a compressed one if its name ends in .hgl.
struct LightFieldOutput {
    std::string file;
    bool single = false;  ///< 32-bit floats, for HDF5 files
    bool with_depth = false;
    std::optional<double> sqnr = {};  ///< dB, for compressed files

    bool compressed() const { return std::filesystem::path(file).extension() == ".hgl"; }
    /// Throws if the file cannot be written or an option belongs to the other kind. To be called before the work.
    void require(const std::string& input) const;
};
/// Adds -o, --depth, --float and --sqnr.
void add_light_field_output(Command& command, LightFieldOutput& output, const std::string& depth_help,
                            const std::string& float_help);

/// Compresses a light field while it is computed, without an intermediate file, and reports it.
/// @param resume_input  with --resume: describe_input() of the input
void write_compressed(LightFieldOutput& output, const LightField& light_field, const Session& session,
                      const std::optional<std::string>& resume_input = {});

/// Prints a line about a compressed light field and one about its depth; with --json prints the result.
void report_compressed(const Session& session, const std::string& file, const CompressionResult& result);

/// Converts the facts of `hogel info` to values: "yes" and "no" to booleans, whole numbers to integers.
Result result_of(const FileSummary& summary);
/// Prints the --json result of a command that wrote a light field or a hologram: its name, the facts of `hogel info`
/// without stored options, `more`, and the time of the command.
void report_samples(const Session& session, const std::string& file, const Result& more = {});
/// Prints the --json result of a command that wrote another file: its name and size, `more`, and the time.
void report_file(const Session& session, const std::string& file, const Result& more);
ResultList wavelengths_of(std::span<const FieldGrid> grids);

/// Folder for the outputs of a command. Creates it with its parents, and removes it if it is still empty at the end.
class OutputFolder {
  public:
    /// Throws Error(cannot_write) if the folder cannot be created or, without `force`, contains outputs of another run.
    OutputFolder(std::filesystem::path path, bool force);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    bool created_;
};

}  // namespace hogel::cli
