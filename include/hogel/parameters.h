// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hogel/error.h"
#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/provenance.h"

namespace hogel {

/// Columns and rows: "256x256", or "256" for a square.
struct Counts {
    std::size_t columns = 0, rows = 0;
    friend bool operator==(const Counts&, const Counts&) = default;
};

/// Across and down, in radians: "40deg" for both, or "40,30deg".
struct Angles {
    double across = 0, down = 0;
    friend bool operator==(const Angles&, const Angles&) = default;
};

/// The form of a parameter's text.
enum class ParameterKind {
    flag,             ///< "yes" or "no"
    text,             ///< any
    texts,            ///< several texts
    choice,           ///< one of Parameter::choices
    number,           ///< "0.5"
    count,            ///< a whole number from 1
    whole,            ///< a whole number from 0
    counts,           ///< "256x256"
    resolution,       ///< "640x480", or "400": columns, with rows by the aspect ratio of the picture
    length,           ///< "16mm"
    positive_length,  ///< the same, above zero
    wavelengths,      ///< "633nm,532nm,460nm", up to three, or "rgb" for the three of Defaults
    angle,            ///< "40deg"
    angles,           ///< "40deg" or "40,30deg"
    point,            ///< "0,0,300mm"
    rotation          ///< "-90,0,0deg": angles about x, then y, then z
};

/// Reference to the variable of a parameter: one with a default, or an optional one.
template <class T>
class ParameterValue {
  public:
    ParameterValue(T& value) : value_(&value) {}                    // NOLINT(google-explicit-constructor)
    ParameterValue(std::optional<T>& value) : optional_(&value) {}  // NOLINT(google-explicit-constructor)

    void set(T value) const {
        if (value_ != nullptr)
            *value_ = std::move(value);
        else
            *optional_ = std::move(value);
    }
    std::optional<T> get() const { return value_ != nullptr ? std::optional<T>(*value_) : *optional_; }

  private:
    T* value_ = nullptr;
    std::optional<T>* optional_ = nullptr;
};

/// One parameter of a command: its names, its texts and the variable that they set.
class HOGEL_API Parameter {
  public:
    std::string name;            ///< "focal-plane"
    std::string alias;           ///< another name, or empty
    std::string letter;          ///< "o" of "-o", or empty
    bool is_positional = false;  ///< whether it has no name on the command line
    bool is_required = false;
    ParameterKind kind = ParameterKind::text;
    std::string type;                   ///< placeholder of the text in a help: "LENGTH"; empty for flags
    std::string help;                   ///< description; lines after the first explain choices
    std::string group;                  ///< heading in a help
    std::string shown_default;          ///< default in a help; empty: none
    std::vector<std::string> choices;   ///< allowed words of ParameterKind::choice; suggested words of other kinds
    std::optional<double> low, high;    ///< range of ParameterKind::number
    std::vector<std::string> excluded;  ///< names of parameters that must not be given with it
    std::vector<std::string> needed;    ///< names of parameters that it requires
    /// Other names of it in errors, see Error::parameter(): "focus" of to-focus.
    std::vector<std::string> other_names;

    /// Returns its name in messages: "--focal-plane", or without dashes if it is positional.
    std::string option() const { return (is_positional ? "" : "--") + name; }
    /// Returns its name in Error::parameter() and Python: "focal_plane".
    std::string keyword() const;
    /// Returns the shell text for a value(), with a leading blank: " --fov 40deg", or " 'a b.h5'" if it is positional.
    /// Returns nothing for the value "no" of a flag.
    std::string option_text(const std::string& value) const;

    // Modifiers of a declaration.
    Parameter& required();
    Parameter& excludes(const Parameter& other) { return excludes(other.name); }
    Parameter& excludes(const std::string& other);
    Parameter& needs(const Parameter& other);
    Parameter& default_text(const std::string& text);
    Parameter& no_default() { return default_text(""); }
    Parameter& range(double least, double greatest);
    Parameter& positive();
    /// Adds suggested words for completion.
    Parameter& knows(std::vector<std::string> words);
    /// Sets a variable to true if the parameter is given.
    Parameter& sets(bool& given);
    Parameter& sets_parameter(const std::string& other);
    /// Sets a function, called after the work, that returns whether the parameter affected the output. Default: always.
    Parameter& acts_if(std::function<bool()> acts);
    /// Marks a parameter that never changes results: a destination, or how the work is done.
    Parameter& never_acts();

    /// Sets the variable from a text, or from several for ParameterKind::texts. Throws Error(usage); the message begins
    /// with `what`, the parameter's name in the source of the text: "--fov".
    void read(const std::vector<std::string>& texts, const std::string& what);
    /// Sets the variable from a text of value(), with blanks between several texts.
    void read_value(const std::string& text, const std::string& what);
    /// Returns whether read() has set it.
    bool is_given() const { return given_; }
    /// Returns the text that set the variable ("yes" or "no" for a flag), or that of its default. If the variable has
    /// changed since, returns written().
    std::string value() const;
    /// Returns the shortest text that sets the variable to exactly its value; empty without a value.
    std::string written() const { return write_ ? write_() : value(); }
    bool acts() const;

  private:
    friend class Parameters;
    std::function<void(const std::string& text, const std::string& what)> read_;
    std::function<std::string()> write_;
    std::function<void(const std::vector<std::string>& texts)> read_all_;  // of ParameterKind::texts
    std::function<bool()> acts_, group_acts_;
    bool* is_set_ = nullptr;
    bool is_positive_ = false;
    bool given_ = false;
    std::string typed_;  // text that set the variable, or text of the default
    std::string then_;   // written() at that time
};

/// The parameters of a command, in the order of its help. Names are written "--fov" or "-o,--output". The variable of a
/// parameter must outlive it. Its value at declaration is the displayed default.
class HOGEL_API Parameters {
  public:
    Parameters() = default;
    Parameters(const Parameters&) = delete;
    Parameters& operator=(const Parameters&) = delete;

    /// Begins a group of parameters: its heading in a help, and a function that returns whether it has an effect.
    void group(const std::string& heading, std::function<bool()> acts = {});
    static constexpr const char* default_group = "Options";
    static constexpr const char* last_group = "General";  ///< of the parameters common to all commands

    /// Declares a required text without a name on the command line, or one or more such texts.
    Parameter& positional(const std::string& name, ParameterValue<std::string> value, const std::string& type,
                          const std::string& help);
    Parameter& positionals(const std::string& name, ParameterValue<std::vector<std::string>> values,
                           const std::string& type, const std::string& help);
    Parameter& text(const std::string& name, ParameterValue<std::string> value, const std::string& type,
                    const std::string& help);
    /// Declares a parameter that can be given several times.
    Parameter& texts(const std::string& name, ParameterValue<std::vector<std::string>> values, const std::string& type,
                     const std::string& help);
    /// Declares a parameter without a default. The function reads its text and throws Error(usage).
    Parameter& parsed(const std::string& name, const std::string& type, const std::string& help,
                      std::function<void(const std::string& text)> read);
    Parameter& number(const std::string& name, ParameterValue<double> value, const std::string& type,
                      const std::string& help);
    Parameter& flag(const std::string& name, ParameterValue<bool> value, const std::string& help);
    /// Declares a flag that names the default and has no effect.
    Parameter& flag(const std::string& name, const std::string& help);
    /// Declares a choice of words, such as the names() of a table.
    Parameter& choice(const std::string& name, ParameterValue<std::string> value, const std::vector<std::string>& words,
                      const std::string& type, const std::string& help);
    Parameter& length(const std::string& name, ParameterValue<double> metres, const std::string& help);
    Parameter& positive_length(const std::string& name, ParameterValue<double> metres, const std::string& help);
    Parameter& angle(const std::string& name, ParameterValue<double> radians, const std::string& help);
    Parameter& angles(const std::string& name, ParameterValue<Angles> angles, const std::string& help);
    Parameter& count(const std::string& name, ParameterValue<std::size_t> count, const std::string& help);
    Parameter& whole(const std::string& name, ParameterValue<std::uint64_t> number, std::uint64_t max,
                     const std::string& help);
    Parameter& counts(const std::string& name, ParameterValue<Counts> counts, const std::string& help);
    Parameter& resolution(const std::string& name, ParameterValue<Counts> counts, const std::string& help);
    Parameter& point(const std::string& name, ParameterValue<Vec3> point, const std::string& help);
    Parameter& rotation(const std::string& name, ParameterValue<Vec3> radians, const std::string& help);
    /// Declares --wavelength, the colours of a hologram. Sets the variable to the three of Defaults.
    Parameter& wavelengths(std::vector<double>& wavelengths);

    const std::deque<Parameter>& all() const { return all_; }
    std::deque<Parameter>& all() { return all_; }
    /// Returns the parameter of a name with or without dashes, or null.
    const Parameter* look_up(std::string_view name) const;
    Parameter* look_up(std::string_view name);
    /// Returns whether the parameter of a name, with or without dashes, is given. Throws Error(internal) if unknown.
    bool given(std::string_view name) const;
    /// Throws Error(usage) if a parameter is given together with one that it excludes, or without one that it needs.
    void require_compatible() const;
    /// Returns the message of an error after the options of its parameters: "--eye, --pitch: the eye sees ...". If
    /// several options set one parameter, it names the given ones, or the first if none is given.
    std::string describe(const Error& error) const;
    /// Returns each name and Parameter::value().
    Metadata values() const;
    /// Returns the values of parameters that have an effect and a value, to be stored in output files.
    Metadata acting() const;

  private:
    Parameter& add(const std::string& name, ParameterKind kind, const std::string& type, const std::string& help);
    template <class T>
    Parameter& add(const std::string& name, ParameterKind kind, const std::string& type, const std::string& help,
                   ParameterValue<T> value, std::function<T(const std::string& text, const std::string& what)> parse,
                   std::function<std::string(const T& value)> write);

    std::deque<Parameter> all_;
    std::string group_ = default_group;
    std::function<bool()> group_acts_;
};

/// Return the shortest text that reads as the same value: "16mm", "633nm,532nm", "40,30deg".
HOGEL_API std::string length_text(double metres);
HOGEL_API std::string lengths_text(const std::vector<double>& metres);
HOGEL_API std::string angle_text(double radians);
HOGEL_API std::string angles_text(const Angles& angles);
HOGEL_API std::string point_text(const Vec3& metres);
HOGEL_API std::string rotation_text(const Vec3& radians);

/// Parses a finite number without a unit. Returns nothing for other texts.
HOGEL_API std::optional<double> parse_number(const std::string& text);
/// Parse a point, "0,0,300mm" (a component without a unit has that of the last), and a length, "16mm". They refuse
/// implausibly large values. Throw Error(usage); the message begins with `what`.
HOGEL_API Vec3 parse_point(const std::string& text, const std::string& what);
HOGEL_API double parse_any_length(const std::string& text, const std::string& what);

/// Splits the names in Error::parameter().
HOGEL_API std::vector<std::string> names_of_parameters(const std::string& parameters);

/// Returns these names with the renames of with_renamed_parameters().
HOGEL_API std::string renamed_parameters(const std::string& parameters,
                                         std::span<const std::pair<std::string_view, std::string_view>> names);

/// Calls a function. Adds these parameters ("hogels, directions") to an Error that names none.
template <class Work>
auto with_parameter(const std::string& parameter, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        if (!error.parameter().empty()) throw;
        throw Error(error.code(), parameter, error.what());
    }
}

/// Calls a function. In the parameters of an Error, replaces the first name of each pair by the second: the name in
/// this command, several ("hogels, size"), or empty if the command does not set it.
template <class Work>
auto with_renamed_parameters(std::initializer_list<std::pair<std::string_view, std::string_view>> names,
                             const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code(), renamed_parameters(error.parameter(), names), error.what());
    }
}

}  // namespace hogel
