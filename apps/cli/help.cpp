// SPDX-License-Identifier: Apache-2.0
#include "help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include "command_line.h"
#include "hogel/table.h"

namespace hogel::cli {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

// The name of an option with its dashes: "-o" or "--output".
std::string written_name(const CLI::Option& option) {
    return option.get_snames().empty() ? "--" + option.get_lnames().front() : "-" + option.get_snames().front();
}

// The message for an unknown option such as "--hogel" or "--hogel=4x4".
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

// Columns for help: those of a terminal, within what is easy to read, or 100 in a file or a pipe.
std::size_t help_columns() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 100;
    return std::clamp<std::size_t>(size.ws_col, 60, 120);
}

// Breaks a line at spaces so that it and what follows fit into `columns`; `indent` goes before what follows. A word
// that is longer stays whole.
std::string wrap_line(std::string_view line, std::size_t columns, std::string_view indent) {
    std::string text;
    std::size_t room = columns;
    while (line.size() > room) {
        std::size_t space = line.rfind(' ', room);
        if (space == std::string_view::npos || space == 0) space = line.find(' ');
        if (space == std::string_view::npos) break;
        text += fmt::format("{}\n{}", line.substr(0, space), indent);
        line.remove_prefix(space + 1);
        room = columns - indent.size();
    }
    return text + std::string(line);
}

// The lines of a description; those after the first are choices, whose continuations are indented.
std::string wrap(std::string_view text, std::size_t columns) {
    std::string wrapped;
    for (bool first = true;; first = false) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        wrapped += (first ? "" : "\n") + wrap_line(text.substr(0, end), columns, first ? "" : "  ");
        if (end == text.size()) return wrapped;
        text.remove_prefix(end + 1);
    }
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    if (mode != CLI::AppFormatMode::Normal) return make_expanded(app);
    std::vector<std::string> groups = app->get_groups();
    std::ranges::stable_partition(groups, [](const std::string& group) { return group != Command::last_group; });
    std::string text = make_description(app) + make_usage(app, std::move(name)) + make_positionals(app);
    for (const std::string& group : groups) {
        const auto options = app->get_options(
            [&](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
        if (!options.empty()) text += make_group(group, false, options);
    }
    return text + make_subcommands(app, mode) + "\n" + make_footer(app);
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
    std::string usage = "\nUsage: " + name;
    if (app->get_parent() == nullptr) return usage + " COMMAND ...\n";
    for (const CLI::Option* option : app->get_options())
        if (option->get_positional()) usage += " " + option->get_type_name();
    for (const CLI::Option* option : app->get_options())
        if (!option->get_positional() && option->get_required())
            usage += fmt::format(" {} {}", written_name(*option), option->get_type_name());
    return usage + " [OPTIONS]\n";
}

std::string HelpFormatter::make_positionals(const CLI::App* app) const {
    std::string text;
    const std::size_t width = get_column_width() - 2;
    for (const CLI::Option* option : app->get_options()) {
        if (!option->get_positional()) continue;
        std::string type = option->get_type_name();
        if (type.size() >= width) type += "\n" + std::string(width + 2, ' ');
        std::string words = wrap(option->get_description(), help_columns() - width - 2);
        for (std::size_t at = 0; (at = words.find('\n', at)) != std::string::npos; at += width + 3)
            words.insert(at + 1, width + 2, ' ');
        text += fmt::format("  {:<{}}{}\n", type, width, words);
    }
    return text.empty() ? text : "\n" + text;
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    return option->get_type_size() == 0 ? "" : " " + option->get_type_name();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
    const std::string shown = option->get_default_str();
    std::string words = option->get_description();
    // The default is appended to the first line; the following lines explain the choices.
    if (!shown.empty()) words.insert(std::min(words.find('\n'), words.size()), fmt::format(" [{}]", shown));
    return wrap(words, help_columns() - get_column_width());
}

std::string explain_unknown_command(const CLI::App& app, const std::string& word) {
    const std::vector<std::string> names = command_names(app);
    if (word == "bench")
        return "there is no command 'bench'; what measures renderers and coders is a program of its own, hogel-bench";
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
    const std::string problem =
        unknown != rest.end() ? explain_unknown_option(command, *unknown) : std::string(error.what());
    return fmt::format("{}; see 'hogel {} --help'", problem, command.get_name());
}

}  // namespace hogel::cli
