// SPDX-License-Identifier: Apache-2.0
#include "hogel/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ranges>
#include <type_traits>
#include <utility>

#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "hogel/words/texts.h"

namespace hogel {

std::string Parameter::keyword() const {
    std::string keyword = name;
    std::ranges::replace(keyword, '-', '_');
    return keyword;
}

std::string Parameter::option_text(const std::string& value) const {
    if (is_positional) return " " + words::shell_word((value.starts_with('-') ? "./" : "") + value);
    if (kind == ParameterKind::flag) return value == "yes" ? " " + option() : "";
    if (kind != ParameterKind::texts) return fmt::format(" {} {}", option(), words::shell_word(value));
    std::string text;
    for (const auto word : std::views::split(value, ' '))
        if (!word.empty()) text += fmt::format(" {} {}", option(), words::shell_word({word.begin(), word.end()}));
    return text;
}

Parameter& Parameter::required() {
    is_required = true;
    shown_default.clear();  // never used
    typed_.clear();
    return *this;
}

Parameter& Parameter::excludes(const std::string& other) {
    excluded.push_back(other.substr(std::min(other.find_first_not_of('-'), other.size())));
    return *this;
}

Parameter& Parameter::needs(const Parameter& other) {
    needed.push_back(other.name);
    return *this;
}

Parameter& Parameter::default_text(const std::string& text) {
    shown_default = text;
    typed_.clear();
    return *this;
}

Parameter& Parameter::acts_if(std::function<bool()> acts) {
    acts_ = std::move(acts);
    return *this;
}

Parameter& Parameter::never_acts() {
    return acts_if([] { return false; });
}

bool Parameter::acts() const { return (!group_acts_ || group_acts_()) && (!acts_ || acts_()); }

Parameter& Parameter::range(double least, double greatest) {
    low = least;
    high = greatest;
    return *this;
}

Parameter& Parameter::positive() {
    is_positive_ = true;
    return *this;
}

Parameter& Parameter::knows(std::vector<std::string> words) {
    choices = std::move(words);
    return *this;
}

Parameter& Parameter::sets(bool& given) {
    is_set_ = &given;
    return *this;
}

Parameter& Parameter::sets_parameter(const std::string& other) {
    other_names.push_back(other);
    return *this;
}

void Parameter::read(const std::vector<std::string>& texts, const std::string& what) {
    if (read_all_) {
        read_all_(texts);
    } else {
        const std::string& text = texts.at(0);
        const std::optional<double> number = low || is_positive_ ? parse_number(text) : std::nullopt;
        if (low && !(number && *number >= *low && *number <= *high))
            throw Error(ErrorCode::usage,
                        fmt::format("{}: '{}' is not a number from {} to {}", what, text, *low, *high));
        if (is_positive_ && !(number && *number > 0))
            throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a positive number", what, text));
        read_(text, what);
    }
    given_ = true;
    typed_ = fmt::format("{}", fmt::join(texts, " "));
    then_ = written();
    if (is_set_ != nullptr) *is_set_ = true;
}

void Parameter::read_value(const std::string& text, const std::string& what) {
    if (!read_all_) return read({text}, what);
    std::vector<std::string> texts;
    for (const auto word : std::views::split(text, ' '))
        if (!word.empty()) texts.emplace_back(word.begin(), word.end());
    read(texts, what);
}

std::string Parameter::value() const {
    if (write_ && write_() != then_) return write_();
    return typed_.empty() && kind == ParameterKind::flag ? "no" : typed_;
}

Parameter& Parameters::add(const std::string& name, ParameterKind kind, const std::string& type,
                           const std::string& help) {
    Parameter& made = all_.emplace_back();
    made.is_positional = !name.starts_with('-');
    for (const auto part : std::views::split(name, ',')) {
        const std::string_view word(part.begin(), part.end());
        if (made.is_positional)
            made.name = word;
        else if (!word.starts_with("--"))
            made.letter = word.substr(1);
        else
            (made.name.empty() ? made.name : made.alias) = word.substr(2);
    }
    made.kind = kind;
    made.type = type;
    made.help = help;
    made.group = group_;
    made.group_acts_ = group_acts_;
    return made;
}

template <class T>
Parameter& Parameters::add(const std::string& name, ParameterKind kind, const std::string& type,
                           const std::string& help, ParameterValue<T> value,
                           std::function<T(const std::string& text, const std::string& what)> parse,
                           std::function<std::string(const T& value)> write) {
    Parameter& made = add(name, kind, type, help);
    made.read_ = [value, parse = std::move(parse)](const std::string& text, const std::string& what) {
        value.set(parse(text, what));
    };
    made.write_ = [value, write = std::move(write)] {
        const std::optional<T> now = value.get();
        return now ? write(*now) : std::string();
    };
    made.shown_default = made.typed_ = made.then_ = made.write_();
    return made;
}

namespace {

std::string as_it_is(const std::string& text) { return text; }

}  // namespace

Parameter& Parameters::text(const std::string& name, ParameterValue<std::string> value, const std::string& type,
                            const std::string& help) {
    return add<std::string>(
        name, ParameterKind::text, type, help, value, [](const std::string& text, const std::string&) { return text; },
        as_it_is);
}

Parameter& Parameters::positional(const std::string& name, ParameterValue<std::string> value, const std::string& type,
                                  const std::string& help) {
    return text(name, value, type, help).required();
}

Parameter& Parameters::texts(const std::string& name, ParameterValue<std::vector<std::string>> values,
                             const std::string& type, const std::string& help) {
    Parameter& made = add(name, ParameterKind::texts, type, help);
    made.read_all_ = [values](const std::vector<std::string>& texts) { values.set(texts); };
    made.write_ = [values] {
        const auto now = values.get();
        return now ? fmt::format("{}", fmt::join(*now, " ")) : std::string();
    };
    return made;
}

Parameter& Parameters::positionals(const std::string& name, ParameterValue<std::vector<std::string>> values,
                                   const std::string& type, const std::string& help) {
    return texts(name, values, type, help).required();
}

Parameter& Parameters::parsed(const std::string& name, const std::string& type, const std::string& help,
                              std::function<void(const std::string& text)> read) {
    Parameter& made = add(name, ParameterKind::text, type, help);
    made.read_ = [read = std::move(read)](const std::string& text, const std::string& what) {
        try {
            read(text);
        } catch (const Error& error) {
            if (error.parameter().empty()) throw;
            throw Error(error.code(), fmt::format("{}: {}", what, error.what()));
        }
    };
    return made;
}

Parameter& Parameters::number(const std::string& name, ParameterValue<double> value, const std::string& type,
                              const std::string& help) {
    return add<double>(name, ParameterKind::number, type, help, value, words::parse_finite_number, words::number_text);
}

Parameter& Parameters::flag(const std::string& name, ParameterValue<bool> value, const std::string& help) {
    Parameter& made = add<bool>(name, ParameterKind::flag, "", help, value, words::parse_flag,
                                [](const bool& is) { return std::string(is ? "yes" : "no"); });
    return made.no_default();
}

Parameter& Parameters::flag(const std::string& name, const std::string& help) {
    Parameter& made = add(name, ParameterKind::flag, "", help);
    made.read_ = [](const std::string&, const std::string&) {};
    return made;
}

Parameter& Parameters::choice(const std::string& name, ParameterValue<std::string> value,
                              const std::vector<std::string>& words, const std::string& type, const std::string& help) {
    Parameter& made = add<std::string>(
        name, ParameterKind::choice, type, help, value,
        [words](const std::string& text, const std::string& what) { return words::parse_choice(text, what, words); },
        as_it_is);
    made.choices = words;
    return made;
}

Parameter& Parameters::length(const std::string& name, ParameterValue<double> metres, const std::string& help) {
    return add<double>(name, ParameterKind::length, "LENGTH", help, metres, parse_any_length, length_text);
}

Parameter& Parameters::positive_length(const std::string& name, ParameterValue<double> metres,
                                       const std::string& help) {
    return add<double>(name, ParameterKind::positive_length, "LENGTH", help, metres, words::parse_positive_length,
                       length_text);
}

Parameter& Parameters::angle(const std::string& name, ParameterValue<double> radians, const std::string& help) {
    return add<double>(name, ParameterKind::angle, "ANGLE", help, radians, parse_angle, angle_text);
}

Parameter& Parameters::angles(const std::string& name, ParameterValue<Angles> angles, const std::string& help) {
    return add<Angles>(name, ParameterKind::angles, "ANGLE[,ANGLE]", help, angles, words::parse_angles, angles_text);
}

Parameter& Parameters::count(const std::string& name, ParameterValue<std::size_t> count, const std::string& help) {
    return add<std::size_t>(
        name, ParameterKind::count, "N", help, count,
        [](const std::string& text, const std::string& what) { return words::parse_count(text, what); },
        [](const std::size_t& number) { return fmt::format("{}", number); });
}

Parameter& Parameters::whole(const std::string& name, ParameterValue<std::uint64_t> number, std::uint64_t max,
                             const std::string& help) {
    return add<std::uint64_t>(
        name, ParameterKind::whole, "N", help, number,
        [max](const std::string& text, const std::string& what) { return words::parse_whole(text, what, max); },
        [](const std::uint64_t& now) { return fmt::format("{}", now); });
}

Parameter& Parameters::counts(const std::string& name, ParameterValue<Counts> counts, const std::string& help) {
    return add<Counts>(name, ParameterKind::counts, "WxH", help, counts, words::parse_counts, words::counts_text);
}

Parameter& Parameters::resolution(const std::string& name, ParameterValue<Counts> counts, const std::string& help) {
    return add<Counts>(name, ParameterKind::resolution, "W|WxH", help, counts, words::parse_resolution,
                       words::resolution_text);
}

Parameter& Parameters::point(const std::string& name, ParameterValue<Vec3> point, const std::string& help) {
    return add<Vec3>(name, ParameterKind::point, "X,Y,Z", help, point, parse_point, point_text);
}

Parameter& Parameters::rotation(const std::string& name, ParameterValue<Vec3> radians, const std::string& help) {
    return add<Vec3>(name, ParameterKind::rotation, "X,Y,Zdeg", help, radians, words::parse_rotation, rotation_text);
}

Parameter& Parameters::wavelengths(std::vector<double>& wavelengths) {
    wavelengths = words::parse_wavelengths("rgb", "");
    Parameter& made =
        add<std::vector<double>>("--wavelength", ParameterKind::wavelengths, "LENGTH[,...]|rgb",
                                 fmt::format("Wavelengths, or rgb for {}, {} and {}", format_length(defaults.red),
                                             format_length(defaults.green), format_length(defaults.blue)),
                                 wavelengths, words::parse_wavelengths, lengths_text);
    made.shown_default = made.typed_ = "rgb";
    return made;
}

Parameter* Parameters::look_up(std::string_view name) {
    name.remove_prefix(std::min(name.find_first_not_of('-'), name.size()));
    const auto found = std::ranges::find(all_, name, &Parameter::name);
    return found != all_.end() ? &*found : nullptr;
}

const Parameter* Parameters::look_up(std::string_view name) const {
    return const_cast<Parameters*>(this)->look_up(name);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

bool Parameters::given(std::string_view name) const {
    if (const Parameter* found = look_up(name)) return found->is_given();
    throw Error(ErrorCode::internal, fmt::format("there is no parameter {}", name));
}

void Parameters::group(const std::string& heading, std::function<bool()> acts) {
    group_ = heading;
    group_acts_ = std::move(acts);
}

Metadata Parameters::acting() const {
    Metadata values;
    for (const Parameter& each : all_)
        if (std::string value = each.acts() ? each.value() : ""; !value.empty())
            values.emplace_back(each.name, std::move(value));
    return values;
}

void Parameters::require_compatible() const {
    for (const Parameter& each : all_) {
        if (!each.is_given()) continue;
        for (const std::string& other : each.excluded)
            if (given(other))
                throw Error(ErrorCode::usage, fmt::format("{}, {}", look_up(other)->keyword(), each.keyword()),
                            "only one of them can be asked for");
        for (const std::string& other : each.needed)
            if (!given(other))
                throw Error(ErrorCode::usage, each.keyword(),
                            fmt::format("is without effect unless {} is given", look_up(other)->keyword()));
    }
}

std::string Parameters::describe(const Error& error) const {
    std::vector<std::string> options;
    const auto take = [&](const Parameter* parameter) {
        const std::string option = parameter->option();
        if (!std::ranges::count(options, option)) options.push_back(option);
    };
    for (const std::string& name : names_of_parameters(error.parameter())) {
        std::vector<const Parameter*> setters;
        for (const Parameter& each : all_) {
            if (each.keyword() == name) setters.insert(setters.begin(), &each);
            if (std::ranges::count(each.other_names, name)) setters.push_back(&each);
        }
        if (std::ranges::any_of(setters, &Parameter::is_given))
            std::ranges::for_each(setters | std::views::filter(&Parameter::is_given), take);
        else if (!setters.empty())
            take(setters.front());
    }
    const std::string message = error.what(), names = fmt::format("{}: ", fmt::join(options, ", "));
    return options.empty() || message.starts_with(names) ? message : names + message;
}

Metadata Parameters::values() const {
    Metadata values;
    for (const Parameter& each : all_) values.emplace_back(each.name, each.value());
    return values;
}

}  // namespace hogel
