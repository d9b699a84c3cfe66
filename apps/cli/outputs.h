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

/// Throws, with the numbers, if `what` needs more memory or disk space than there is; says so in a line if it takes
/// more than an hour, and with --verbose or `always` in any case.
void state_plan(const Session& session, const Plan& plan, const std::string& what,
                const std::filesystem::path& file = {}, bool always = false);

/// --force, for folders that may hold the outputs of another run.
void add_force_flag(Command& command, bool& force);

/// --resume, for outputs that take long.
void add_resume_flag(Command& command, bool& resume);

/// What identifies the work of a command: version, command, input and the options that act.
/// @param input  what describe_input() says of it
std::vector<std::string> work_of(const Session& session, const std::string& input);

/// Keeps what the work has merged in "FILE.part", from which the same command goes on after it was interrupted; nothing
/// without --resume. Of outputs that are no HDF5 files, which have a journal.
class Kept {
  public:
    /// @param input  as of work_of()
    Kept(const Session& session, bool resume, const std::string& output, const std::string& input);
    /// Does a piece of work whose results are in files of their own, unless it was done before.
    void once(const std::function<void()>& work) {
        if (scope_)
            scope_->once(work);
        else
            work();
    }
    /// Calls the work and returns its result. Keeps nothing of work that is refused, which would be refused again.
    template <class Work>
    auto unless_refused(const Work& work) {
        try {
            return work();
        } catch (const Error& error) {
            if (error.code() == ErrorCode::usage) complete();
            throw;
        }
    }
    /// The output is there.
    void complete() {
        if (scope_) scope_->complete();
    }

  private:
    std::optional<ResumeScope> scope_;
};

/// A part of an output, or the whole if none is given.
struct PartOption {
    std::optional<FilePart> part;

    /// The file that is written for an output: "X.part-2-of-5" for X.h5.
    std::string file_for(const std::string& output) const;
    /// The part, with what all parts must have in common.
    FilePart of(const std::string& input) const;
};
/// --part
void add_part_option(Command& command, PartOption& part);
/// Prints that a part was written; with --json the result.
void report_part(const Session& session, const std::string& file, const FilePart& part);

/// A light field that a command writes: an HDF5 file, or a compressed one if its name ends in .hgl.
struct LightFieldOutput {
    std::string file;
    bool single = false;  ///< 32-bit floats; of HDF5 files
    bool with_depth = false;
    std::optional<double> sqnr = {};  ///< dB; of compressed files

    bool compressed() const { return std::filesystem::path(file).extension() == ".hgl"; }
    /// Throws, before any work is done, where the file cannot be written or an option belongs to the other kind.
    void require(const std::string& input) const;
};
/// -o, --depth, --float and --sqnr.
void add_light_field_output(Command& command, LightFieldOutput& output, const std::string& depth_help,
                            const std::string& float_help);

/// Compresses a light field while it is made, without an intermediate file, and reports it.
/// @param kept_of  with --resume: what describe_input() says of the input
void write_compressed(LightFieldOutput& output, const LightField& light_field, const Session& session,
                      const std::optional<std::string>& kept_of = {});

/// Prints a line about a compressed light field and one about its depth; with --json the result.
void report_compressed(const Session& session, const std::string& file, const CompressionResult& result);

/// The facts of `hogel info` about a file as values: "yes" and "no" as booleans, whole numbers as such.
Result result_of(const FileSummary& summary);
/// The result of a command that wrote a light field or a hologram: its name, the facts of `hogel info` without the
/// options that made it, `more`, and the time of the command.
void report_samples(const Session& session, const std::string& file, const Result& more = {});
/// The result of a command that wrote another file: its name and size, `more`, and the time.
void report_file(const Session& session, const std::string& file, const Result& more);
ResultList wavelengths_of(std::span<const FieldGrid> grids);

/// A folder for the outputs of `hogel make` or `hogel print`. Creates it with its parents, and removes it if the work
/// fails before anything is written to it.
class OutputFolder {
  public:
    /// Throws Error(cannot_write) if the folder cannot be created or, without `force`, if it holds outputs of another
    /// run.
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
