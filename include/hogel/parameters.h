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

/// What the text of a parameter stands for.
enum class ParameterKind {
    flag,             ///< "yes" or "no"
    text,             ///< any
    texts,            ///< several
    choice,           ///< one of Parameter::choices
    number,           ///< "0.5"
    count,            ///< a whole number from 1
    whole,            ///< a whole number from 0
    counts,           ///< "256x256"
    resolution,       ///< "640x480", or "400": columns, with as many rows as the picture takes
    length,           ///< "16mm"
    positive_length,  ///< the same, above zero
    wavelengths,      ///< "633nm,532nm,460nm", up to three, or "rgb" for the three of Defaults
    angle,            ///< "40deg"
    angles,           ///< "40deg" or "40,30deg"
    point,            ///< "0,0,300mm"
    rotation          ///< "-90,0,0deg": angles about x, then y, then z
};

/// The variable of a parameter: one that has a default from the start, or one that is empty until it is set.
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

/// One parameter of a command: what it is called, which texts it takes and which variable they set.
class HOGEL_API Parameter {
  public:
    std::string name;            ///< "focal-plane"
    std::string alias;           ///< another name, or empty
    std::string letter;          ///< "o" of "-o", or empty
    bool is_positional = false;  ///< without a name on the command line
    bool is_required = false;
    ParameterKind kind = ParameterKind::text;
    std::string type;                   ///< what a help shows in place of the text: "LENGTH"; empty for flags
    std::string help;                   ///< what it does; lines after the first explain choices
    std::string group;                  ///< the heading under which a help shows it
    std::string shown_default;          ///< the text that a help shows as the default; empty: none
    std::vector<std::string> choices;   ///< of ParameterKind::choice; words that a text may be
    std::optional<double> low, high;    ///< of ParameterKind::number: the least and the greatest
    std::vector<std::string> excluded;  ///< names of parameters that must not be given together with it
    std::vector<std::string> needed;    ///< names of parameters without which it must not be given
    /// Other names by which errors call what it sets, see Error::parameter(): "focus" of to-focus.
    std::vector<std::string> other_names;

    /// What messages call it: "--focal-plane", or without dashes if it is positional.
    std::string option() const { return (is_positional ? "" : "--") + name; }
    /// What Error::parameter() and Python call it: "focal_plane".
    std::string keyword() const;
    /// What stands on a shell's command line for a value(), with a blank before it: " --fov 40deg", of positional ones
    /// " 'a b.h5'". Nothing for "no".
    std::string option_text(const std::string& value) const;

    // What a declaration adds.
    Parameter& required();
    Parameter& excludes(const Parameter& other) { return excludes(other.name); }
    Parameter& excludes(const std::string& other);
    Parameter& needs(const Parameter& other);
    Parameter& default_text(const std::string& text);
    Parameter& no_default() { return default_text(""); }
    Parameter& range(double least, double greatest);
    Parameter& positive();
    /// Words that a text may be, for completion.
    Parameter& knows(std::vector<std::string> words);
    /// A variable that becomes true if the parameter is given.
    Parameter& sets(bool& given);
    Parameter& sets_parameter(const std::string& other);
    /// When the parameter has an effect on what the command makes, asked after the work; otherwise it always has.
    Parameter& acts_if(std::function<bool()> acts);
    /// It says where results go or how the work is done, and never what they are.
    Parameter& never_acts();

    /// Sets the variable from a text, or from several for ParameterKind::texts. Throws Error(usage), whose message
    /// begins with `what`, the name of the parameter where the text comes from: "--fov".
    void read(const std::vector<std::string>& texts, const std::string& what);
    /// As read() of a text of value(), where several texts have blanks between them.
    void read_value(const std::string& text, const std::string& what);
    /// Whether read() has set it.
    bool is_given() const { return given_; }
    /// The text that the variable was set from, "yes" or "no" for a flag, or that of its default if that has one; where
    /// the variable was changed since, the shortest text that sets it to its value, exactly.
    std::string value() const;
    /// The latter in any case; empty if the variable has no value.
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
    std::string typed_;  // the text that set the variable, or of its default
    std::string then_;   // what written() was then
};

/// The parameters of a command, in the order in which a help shows them. Names are written "--fov" or "-o,--output". A
/// variable that a parameter sets must outlive it; its value when the parameter is declared is the default that is
/// shown.
class HOGEL_API Parameters {
  public:
    Parameters() = default;
    Parameters(const Parameters&) = delete;
    Parameters& operator=(const Parameters&) = delete;

    /// The heading under which a help shows the parameters that are declared from now on, and when they act at all.
    void group(const std::string& heading, std::function<bool()> acts = {});
    static constexpr const char* default_group = "Options";
    static constexpr const char* last_group = "General";  ///< of the parameters that all commands share

    /// A required text without a name on the command line, or one or more of them.
    Parameter& positional(const std::string& name, ParameterValue<std::string> value, const std::string& type,
                          const std::string& help);
    Parameter& positionals(const std::string& name, ParameterValue<std::vector<std::string>> values,
                           const std::string& type, const std::string& help);
    Parameter& text(const std::string& name, ParameterValue<std::string> value, const std::string& type,
                    const std::string& help);
    /// A parameter that may be given several times.
    Parameter& texts(const std::string& name, ParameterValue<std::vector<std::string>> values, const std::string& type,
                     const std::string& help);
    /// A parameter without a default, whose text is read by a function that throws Error(usage).
    Parameter& parsed(const std::string& name, const std::string& type, const std::string& help,
                      std::function<void(const std::string& text)> read);
    Parameter& number(const std::string& name, ParameterValue<double> value, const std::string& type,
                      const std::string& help);
    Parameter& flag(const std::string& name, ParameterValue<bool> value, const std::string& help);
    /// A flag without effect, which names the default.
    Parameter& flag(const std::string& name, const std::string& help);
    /// One of several words, such as the names() of a table.
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
    /// --wavelength, the colours that a hologram is made for. Sets the variable to the three of Defaults.
    Parameter& wavelengths(std::vector<double>& wavelengths);

    const std::deque<Parameter>& all() const { return all_; }
    std::deque<Parameter>& all() { return all_; }
    /// The parameter of a name with or without dashes, or null.
    const Parameter* look_up(std::string_view name) const;
    Parameter* look_up(std::string_view name);
    /// Whether a parameter, of a name with or without dashes, is given. Throws Error(internal) for an unknown name.
    bool given(std::string_view name) const;
    /// Throws Error(usage) if a parameter is given together with one that it excludes, or without one that it needs.
    void require_compatible() const;
    /// The message of an error, which begins with the options of its parameters: "--eye, --pitch: the eye sees ...". Of
    /// the options that set one parameter it names the given ones, or the first one if none is given.
    std::string describe(const Error& error) const;
    /// Each name and Parameter::value().
    Metadata values() const;
    /// Those of parameters that act and have a value: what is to be stored in the files that the command writes.
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

/// The text of a value in the shortest form that reads as the same number: "16mm", "633nm,532nm", "40,30deg".
HOGEL_API std::string length_text(double metres);
HOGEL_API std::string lengths_text(const std::vector<double>& metres);
HOGEL_API std::string angle_text(double radians);
HOGEL_API std::string angles_text(const Angles& angles);
HOGEL_API std::string point_text(const Vec3& metres);
HOGEL_API std::string rotation_text(const Vec3& radians);

/// A finite number without a unit, or nothing if the text is not one.
HOGEL_API std::optional<double> parse_number(const std::string& text);
/// "0,0,300mm": a component without a unit takes that of the last; and a length, "16mm". Both refuse what is too long
/// to be meant. They throw Error(usage), which begins with `what`.
HOGEL_API Vec3 parse_point(const std::string& text, const std::string& what);
HOGEL_API double parse_any_length(const std::string& text, const std::string& what);

/// The names in Error::parameter().
HOGEL_API std::vector<std::string> names_of_parameters(const std::string& parameters);

/// The same with other names, see with_renamed_parameters().
HOGEL_API std::string renamed_parameters(const std::string& parameters,
                                         std::span<const std::pair<std::string_view, std::string_view>> names);

/// Calls the work. An Error(usage) that names no parameter gets this one: "hogels, directions".
template <class Work>
auto with_parameter(const std::string& parameter, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        if (!error.parameter().empty()) throw;
        throw Error(error.code(), parameter, error.what());
    }
}

/// Calls the work. In parameters of an Error the first name of each pair becomes the second, which is what the command
/// calls it, or several, "hogels, size", or empty if the command does not set it here.
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
