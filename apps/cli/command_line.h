// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arguments.h"
#include "hogel/error.h"
#include "hogel/geometry.h"
#include "hogel/image.h"

// The parser is CLI11, whose header takes long to compile: command_line.cpp and help.cpp alone include it.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hogel::cli {

struct Session;
class Command;

/// A handle of a declared option, to set its properties. Copies refer to the same option.
class Option {
  public:
    Option(Command& command, CLI::Option* option) : command_(&command), option_(option) {}

    Option required() const;
    /// The option must not be given together with another, which was declared before.
    Option excludes(const Option& other) const;
    Option excludes(const std::string& name) const;
    /// The option may only be given together with another.
    Option needs(const Option& other) const;
    /// The text that the help shows as the default instead of the variable's value; an empty text shows none.
    Option default_text(const std::string& text) const;
    Option no_default() const { return default_text(""); }
    /// Numbers outside of this range are refused.
    Option range(double low, double high) const;
    Option positive() const;
    /// A variable that becomes true if the option is given.
    Option sets(bool& given) const;
    /// The option also sets a parameter of another name, see Error::parameter(): --to-focus sets "focus".
    Option sets_parameter(const std::string& parameter) const;

  private:
    Command* command_;
    CLI::Option* option_;
};

/// One command of the program: its options and its work. A variable that an option fills must outlive the command; its
/// value when the option is declared is the default, which the help shows. Names are written "--fov" or "-o,--output".
/// An invalid value throws Error(usage), which names the option.
class Command {
  public:
    explicit Command(CLI::App& app);
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    std::string name() const;
    /// Command lines, indented by two blanks, that end the help.
    void examples(const std::string& lines);
    /// The work, which returns the exit status.
    void work(std::function<int()> work) { work_ = std::move(work); }
    int run() const { return work_(); }

    /// The heading under which the help shows the options that are declared from now on.
    void group(const std::string& heading) { group_ = heading; }
    static constexpr const char* default_group = "Options";
    static constexpr const char* last_group = "General";  ///< of the options that all commands share

    /// A required argument without a name.
    Option positional(const std::string& name, std::string& value, const std::string& type, const std::string& help);
    /// One or more of them.
    Option positionals(const std::string& name, std::vector<std::string>& values, const std::string& type,
                       const std::string& help);
    Option text(const std::string& name, std::string& value, const std::string& type, const std::string& help);
    /// An option that may be given several times.
    Option texts(const std::string& name, std::vector<std::string>& values, const std::string& type,
                 const std::string& help);
    /// An option without a default, whose text is read by a function that throws Error(usage).
    Option parsed(const std::string& name, const std::string& type, const std::string& help,
                  std::function<void(const std::string& text)> read);
    Option number(const std::string& name, double& value, const std::string& type, const std::string& help);
    Option number(const std::string& name, std::optional<double>& value, const std::string& type,
                  const std::string& help);
    Option flag(const std::string& name, bool& value, const std::string& help);
    /// A flag without effect, which names the default.
    Option flag(const std::string& name, const std::string& help);
    /// One of several words, such as the names() of a table.
    Option choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
                  const std::string& type, const std::string& help);

    /// A length or an angle has a unit: "16mm", "40deg".
    Option length(const std::string& name, double& metres, const std::string& help);
    Option positive_length(const std::string& name, double& metres, const std::string& help);
    Option angle(const std::string& name, double& radians, const std::string& help);
    /// "40deg" for both across and down, or "40,30deg".
    Option angles(const std::string& name, Angles& angles, const std::string& help);
    /// A whole number from 1, and from 0 to a maximum.
    Option count(const std::string& name, std::size_t& count, const std::string& help);
    Option whole(const std::string& name, std::uint64_t& number, std::uint64_t max, const std::string& help);
    /// "256x256", or "256" for a square.
    Option counts(const std::string& name, Counts& counts, const std::string& help);
    /// "640x480", or "400": pixels across, with rows 0 for as many as the picture takes.
    Option resolution(const std::string& name, Counts& counts, const std::string& help);
    /// "0,0,300mm": a component without a unit takes that of the last.
    Option point(const std::string& name, Vec3& point, const std::string& help);
    /// --wavelength, the colours that a hologram is made for: "633nm", or "rgb" for the three of Defaults.
    Option wavelengths(std::vector<double>& wavelengths);

    /// Whether an option ("--pitch") is on the command line.
    bool given(const std::string& name) const;

    /// The message of an error, after the options that set its parameters: "--eye, --pitch: the eye sees ...". Of the
    /// options that set one parameter it names the given ones, or the first one if none is given.
    std::string describe(const Error& error) const;

    /// Every option, without dashes, and its value as text, as typed or the default; "yes" or "no" for a flag.
    Metadata values() const;

  private:
    friend class Option;
    /// Reads the text of an option; `name` is its name in messages.
    using Read = std::function<void(const std::string& text, const std::string& name)>;
    Option read_option(const std::string& name, const std::string& type, const std::string& shown,
                       const std::string& help, Read read);
    Option add(CLI::Option* option);
    Option option(const std::string& name);
    /// The options that set a parameter.
    std::vector<std::string> setters(const std::string& parameter) const;

    CLI::App& app_;
    std::multimap<std::string, std::string> setters_;  // parameters and the options of other names that set them
    std::string group_ = default_group;
    std::function<int()> work_;
};

/// A row of the table of commands.
struct CommandInfo {
    std::string name;
    std::string text;  ///< one line
    void (*add)(Command& command, Session& session);
};

/// The whole command line: what the program is and all its commands.
class CommandLine {
  public:
    CommandLine(std::span<const CommandInfo> commands, Session& session);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Reads the arguments of main() into the variables of the options. Returns the chosen command, or null after
    /// printing help or the version on the standard output. Throws Error(usage).
    const Command* parse(int argc, const char* const* argv);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::cli
