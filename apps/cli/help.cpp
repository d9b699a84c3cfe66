// SPDX-License-Identifier: Apache-2.0
#include "help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "command_line.h"
#include "hogel/error.h"
#include "hogel/table.h"
#include "result.h"

namespace hogel::cli {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

// Returns the message for an unknown option such as "--hogel" or "--hogel=4x4".
std::string explain_unknown_option(const CLI::App& app, const std::string& word) {
    const std::string option = word.substr(0, word.find('='));
    std::vector<std::string> known;
    for (const CLI::Option* each : app.get_options())
        for (const std::string& name : each->get_lnames()) known.push_back(name);
    const std::size_t name = option.find_first_not_of('-');
    const std::string nearest = name == std::string::npos ? "" : nearest_word(option.substr(name), known);
    return fmt::format("{} has no option {}{}", app.get_name(), option,
                       nearest.empty() ? "" : fmt::format(" (did you mean --{}?)", nearest));
}

// Returns the number of columns of the help: that of the terminal, clamped to 60 to 120, or 100 in a file or a pipe.
std::size_t help_columns() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 100;
    return std::clamp<std::size_t>(size.ws_col, 60, 120);
}

// Breaks a line at spaces into lines of at most `columns` characters. Continuation lines begin with `indent`. Longer
// words are not broken.
std::string wrap_line(std::string_view line, std::size_t columns, std::string_view indent) {
    std::string text;
    std::size_t width = columns;
    while (line.size() > width) {
        std::size_t space = line.rfind(' ', width);
        if (space == std::string_view::npos || space == 0) space = line.find(' ');
        if (space == std::string_view::npos) break;
        text += fmt::format("{}\n{}", line.substr(0, space), indent);
        line.remove_prefix(space + 1);
        width = columns - indent.size();
    }
    return text + std::string(line);
}

// Wraps the lines of a description. Lines after the first are choices; their continuations are indented.
std::string wrap(std::string_view text, std::size_t columns) {
    std::string wrapped;
    for (bool first = true;; first = false) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        wrapped += (first ? "" : "\n") + wrap_line(text.substr(0, end), columns, first ? "" : "  ");
        if (end == text.size()) return wrapped;
        text.remove_prefix(end + 1);
    }
}

constexpr std::size_t name_columns = 24;  // width of the column of names

// Formats a name with its description beside it, or below it if the name is long.
std::string entry(const std::string& name, const std::string& description) {
    const std::string margin = "\n" + std::string(name_columns, ' ');
    std::string text = wrap(description, help_columns() - name_columns);
    for (std::size_t position = 0; (position = text.find('\n', position)) != std::string::npos;
         position += margin.size())
        text.replace(position, 1, margin);
    const bool is_long = name.size() + 3 > name_columns;
    return fmt::format("  {:<{}}{}{}\n", name, name_columns - 2, is_long && !text.empty() ? margin : "", text);
}

std::string entry(const Parameter& parameter) {
    if (parameter.is_positional) return entry(parameter.type, parameter.help);
    std::string name = option_names(parameter);
    if (!parameter.type.empty()) name += " " + parameter.type;
    std::string text = parameter.help;
    // The default is appended to the first line; the following lines explain the choices.
    if (!parameter.shown_default.empty())
        text.insert(std::min(text.find('\n'), text.size()), fmt::format(" [{}]", parameter.shown_default));
    return entry(name, text);
}

std::string usage(const Command& command) {
    std::string usage = "hogel " + command.name();
    for (const Parameter& each : command.all())
        if (each.is_positional) usage += " " + each.type;
    for (const Parameter& each : command.all())
        if (!each.is_positional && each.is_required)
            usage += fmt::format(" {} {}", each.letter.empty() ? "--" + each.name : "-" + each.letter, each.type);
    return usage + " [OPTIONS]";
}

// Returns the headings of a command's options; the group common to all commands comes last.
std::vector<std::string> headings(const Command& command) {
    std::vector<std::string> headings;
    for (const Parameter& each : command.all())
        if (!each.is_positional && !std::ranges::count(headings, each.group)) headings.push_back(each.group);
    std::ranges::stable_partition(headings, [](const std::string& each) { return each != Parameters::last_group; });
    return headings;
}

// Returns the name of a group after --help: "light-field-of-a-scene".
std::string word_of(std::string heading) {
    heading.resize(std::min(heading.find(" ("), heading.size()));
    std::erase(heading, ',');
    for (char& c : heading) c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return heading;
}

std::string group_help(const Command& command, const std::string& heading) {
    std::string text = fmt::format("\n{}:\n", heading);
    if (heading == Parameters::last_group) text += entry("-h,--help [all|GROUP]", "Print this help and exit");
    for (const Parameter& each : command.all())
        if (!each.is_positional && each.group == heading) text += entry(each);
    return text;
}

std::string operands(const Command& command) {
    std::string text;
    for (const Parameter& each : command.all())
        if (each.is_positional) text += entry(each);
    return text.empty() ? text : "\n" + text;
}

std::string first_lines(const std::string& text, std::size_t count) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < count && end != std::string::npos; ++i) end = text.find('\n', end + (i > 0 ? 1 : 0));
    return text.substr(0, end);
}

std::string complete_help(const Command& command) {
    std::string text = operands(command);
    for (const std::string& heading : headings(command)) text += group_help(command, heading);
    return command.examples().empty() ? text : fmt::format("{}\nExamples:\n{}\n", text, command.examples());
}

// Returns three examples, the basic options, and the commands that print the other options.
std::string short_help(const Command& command) {
    std::string text =
        command.examples().empty() ? "" : fmt::format("\nExamples:\n{}\n", first_lines(command.examples(), 3));
    text += operands(command) + fmt::format("\n{}:\n", Parameters::default_group);
    std::size_t options = 0, shown = 0;
    for (const Parameter& each : command.all()) {
        if (each.is_positional) continue;
        ++options;
        if (!command.is_basic(each)) continue;
        text += entry(each);
        ++shown;
    }
    std::vector<std::string> groups;
    for (const std::string& heading : headings(command)) groups.push_back(word_of(heading));
    text += fmt::format("\n{} of {} options; the others:\n  hogel {} --help all\n", shown, options, command.name());
    return text +
           wrap_line(fmt::format("  hogel {} --help {}", command.name(), fmt::join(groups, " | ")), help_columns(),
                     "    ") +
           "\n";
}

// Returns the heading that begins with this word, or an empty text.
std::string find_heading(const Command& command, const std::string& word) {
    for (const std::string& heading : headings(command))
        if (word_of(heading).starts_with(word)) return heading;
    return "";
}

const char* kind_name(ParameterKind kind) {
    switch (kind) {
        case ParameterKind::flag:
            return "flag";
        case ParameterKind::text:
            return "text";
        case ParameterKind::texts:
            return "texts";
        case ParameterKind::choice:
            return "choice";
        case ParameterKind::number:
            return "number";
        case ParameterKind::count:
            return "count";
        case ParameterKind::whole:
            return "whole";
        case ParameterKind::counts:
            return "counts";
        case ParameterKind::resolution:
            return "resolution";
        case ParameterKind::length:
            return "length";
        case ParameterKind::positive_length:
            return "positive_length";
        case ParameterKind::wavelengths:
            return "wavelengths";
        case ParameterKind::angle:
            return "angle";
        case ParameterKind::angles:
            return "angles";
        case ParameterKind::rotation:
            return "rotation";
        case ParameterKind::point:
            return "point";
    }
    return "";
}

ResultList list_of(const std::vector<std::string>& texts) { return {texts.begin(), texts.end()}; }

Result schema_of(const Parameter& parameter) {
    Result schema{{"name", parameter.name}, {"kind", kind_name(parameter.kind)}, {"help", parameter.help}};
    const auto add = [&](const char* name, const std::string& text) {
        if (!text.empty()) schema.emplace_back(name, text);
    };
    add("letter", parameter.letter);
    add("alias", parameter.alias);
    add("type", parameter.type);
    add("group", parameter.is_positional ? "" : parameter.group);
    add("default", parameter.shown_default);
    if (parameter.is_positional) schema.emplace_back("positional", true);
    if (parameter.is_required) schema.emplace_back("required", true);
    if (parameter.low) schema.emplace_back("least", *parameter.low);
    if (parameter.high) schema.emplace_back("greatest", *parameter.high);
    if (!parameter.choices.empty()) schema.emplace_back("choices", list_of(parameter.choices));
    if (!parameter.excluded.empty()) schema.emplace_back("excludes", list_of(parameter.excluded));
    if (!parameter.needed.empty()) schema.emplace_back("needs", list_of(parameter.needed));
    return schema;
}

}  // namespace

std::string option_names(const Parameter& parameter) {
    if (parameter.is_positional) return parameter.name;
    return (parameter.letter.empty() ? "" : "-" + parameter.letter + ",") + "--" + parameter.name +
           (parameter.alias.empty() ? "" : ",--" + parameter.alias);
}

std::string HelpFormatter::make_usage(const CLI::App* /*app*/, std::string name) const {
    return "\nUsage: " + name + " COMMAND ...\n";
}

bool has_group(const Command& command, const std::string& word) {
    return word == "all" || !find_heading(command, word).empty();
}

void require_group(const Command& command, const std::string& word) {
    if (word.starts_with('-') || has_group(command, word)) return;
    std::vector<std::string> groups;
    for (const std::string& heading : headings(command)) groups.push_back(word_of(heading));
    throw Error(ErrorCode::usage, fmt::format("{} has no options '{}'; expected all or one of {}", command.name(), word,
                                              fmt::join(groups, ", ")));
}

std::string help(const Command& command, const std::string& part) {
    const std::string begin = fmt::format("{}\n\nUsage: {}\n", command.summary(), usage(command));
    if (part.empty() && !command.basics().empty()) return begin + short_help(command);
    if (part.empty() || part == "all") return begin + complete_help(command);
    return begin + group_help(command, find_heading(command, part));
}

std::string schema(const Command& command) {
    ResultList parameters;
    for (const Parameter& each : command.all()) parameters.emplace_back(schema_of(each));
    return to_json({{"command", command.name()}, {"help", command.summary()}, {"parameters", parameters}}) + "\n";
}

std::string explain_unknown_command(const CLI::App& app, const std::string& word) {
    const std::vector<std::string> names = command_names(app);
    if (word == "bench")
        return "there is no command 'bench'; use the program hogel-bench to measure renderers and coders";
    const std::string nearest = nearest_word(word, names);
    return fmt::format("there is no command '{}'{}; expected one of {}", word,
                       nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest), fmt::join(names, ", "));
}

std::string explain(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> rest = app.remaining(true);
    const auto chosen = app.get_subcommands();
    if (chosen.empty()) {
        if (rest.empty())
            return fmt::format("no command given; expected one of {}", fmt::join(command_names(app), ", "));
        if (!rest.front().starts_with('-')) return explain_unknown_command(app, rest.front());
        return explain_unknown_option(app, rest.front()) + "; see 'hogel --help'";
    }
    const CLI::App& command = *chosen.front();
    const auto unknown = std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with('-'); });
    const std::string message = error.what();
    if (const std::size_t end = message.find(" was given a disallowed flag override"); end != std::string::npos)
        return fmt::format("--{} takes no value", message.substr(0, end));
    const std::string problem = unknown != rest.end() ? explain_unknown_option(command, *unknown) : message;
    return fmt::format("{}; see 'hogel {} --help'", problem, command.get_name());
}

}  // namespace hogel::cli
