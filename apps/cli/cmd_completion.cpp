// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "commands.h"
#include "hogel/error.h"
#include "hogel/scene.h"
#include "hogel/table.h"

namespace hogel::cli {
namespace {

using Commands = std::vector<const Command*>;

std::string replaced(std::string text, const std::string& pattern, const std::string& replacement) {
    for (std::size_t position = 0; (position = text.find(pattern, position)) != std::string::npos;
         position += replacement.size())
        text.replace(position, pattern.size(), replacement);
    return text;
}

// Returns the first line of a help text, quoted for a shell.
std::string quoted_help(const Parameter& parameter) {
    return replaced(parameter.help.substr(0, parameter.help.find('\n')), "'", "'\\''");
}

// Returns the names of a parameter with dashes.
std::vector<std::string> names_of(const Parameter& parameter) {
    std::vector<std::string> names{"--" + parameter.name};
    if (!parameter.alias.empty()) names.push_back("--" + parameter.alias);
    if (!parameter.letter.empty()) names.push_back("-" + parameter.letter);
    return names;
}

std::vector<const Parameter*> options_of(const Command& command) {
    std::vector<const Parameter*> options;
    for (const Parameter& each : command.all())
        if (!each.is_positional) options.push_back(&each);
    return options;
}

// Returns the possible values of a command's operand.
std::vector<std::string> operand_words(const Command& command) {
    for (const Parameter& each : command.all()) {
        if (!each.is_positional) continue;
        return each.type.find("SCENE") != std::string::npos ? scenes().names() : each.choices;
    }
    return {};
}

std::string command_names(const Commands& commands) {
    std::string names = "help";
    for (const Command* each : commands) names += " " + each->name();
    return names;
}

std::string bash(const Commands& commands) {
    std::string options, choices, operands;
    for (const Command* command : commands) {
        std::vector<std::string> names{"--help"};
        for (const Parameter* each : options_of(*command)) {
            const std::vector<std::string> parameter_names = names_of(*each);
            names.insert(names.end(), parameter_names.begin(), parameter_names.end());
            if (!each->choices.empty())
                choices += fmt::format("        {}:--{}) words='{}' ;;\n", command->name(), each->name,
                                       fmt::join(each->choices, " "));
        }
        options += fmt::format("            {}) words='{}' ;;\n", command->name(), fmt::join(names, " "));
        if (const auto words = operand_words(*command); !words.empty())
            operands += fmt::format("        {}) words='{}' ;;\n", command->name(), fmt::join(words, " "));
    }
    return fmt::format(R"(# Completions of hogel for bash.
_hogel() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} words=
    [ "$COMP_CWORD" != 1 ] || words='{}'
    case ${{COMP_WORDS[1]}}:${{COMP_WORDS[COMP_CWORD - 1]}} in
        help:*) words='{}' ;;
{}    esac
    if [ -z "$words" ] && [[ $current == -* ]]; then
        case ${{COMP_WORDS[1]}} in
{}        esac
    fi
    if [ -n "$words" ]; then
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
        return
    fi
    case ${{COMP_WORDS[1]}} in
{}    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; compgen -f -- "$current")
}}
complete -o filenames -F _hogel hogel hogel-mpi
)",
                       command_names(commands), command_names(commands), choices, options, operands);
}

std::string zsh_option(const Parameter& parameter) {
    std::string text = replaced(replaced(quoted_help(parameter), "[", "\\["), "]", "\\]");
    std::string value;
    if (parameter.kind != ParameterKind::flag)
        value =
            fmt::format(":{}:{}", replaced(parameter.type, ":", "\\:"),
                        parameter.choices.empty() ? "_files" : fmt::format("({})", fmt::join(parameter.choices, " ")));
    const char* const repeated = parameter.kind == ParameterKind::texts ? "*" : "";
    std::string lines;
    for (const std::string& name : names_of(parameter))
        lines += fmt::format(" \\\n                '{}{}[{}]{}'", repeated, name, text, value);
    return lines;
}

std::string zsh(const Commands& commands) {
    std::string names, cases;
    for (const Command* command : commands) {
        names += fmt::format("        '{}:{}'\n", command->name(), replaced(command->summary(), "'", "'\\''"));
        cases += fmt::format("        {})\n            _arguments '--help[Print this help and exit]'", command->name());
        for (const Parameter* each : options_of(*command)) cases += zsh_option(*each);
        if (const auto words = operand_words(*command); !words.empty())
            cases += fmt::format(" \\\n                '1:operand:(({}))'", fmt::join(words, " "));
        cases += " \\\n                '*:file:_files' ;;\n";
    }
    return fmt::format(R"(#compdef hogel hogel-mpi
# Completions of hogel for zsh.
_hogel() {{
    local -a commands=(
{}    )
    if (( CURRENT == 2 )) || [[ $words[2] == help ]]; then
        _describe command commands
        return
    fi
    shift words
    (( CURRENT-- ))
    case $words[1] in
{}    esac
}}
if [[ $funcstack[1] == _hogel ]]; then _hogel "$@"; else compdef _hogel hogel hogel-mpi; fi
)",
                       names, cases);
}

std::string fish(const Commands& commands) {
    std::string lines = "# Completions of hogel for fish.\n";
    for (const Command* command : commands) {
        lines += fmt::format("complete -c hogel -n __fish_use_subcommand -f -a {} -d '{}'\n", command->name(),
                             replaced(command->summary(), "'", "\\'"));
        const std::string chosen =
            fmt::format("complete -c hogel -n '__fish_seen_subcommand_from {}'", command->name());
        for (const Parameter* each : options_of(*command)) {
            std::string line = fmt::format("{} -l {}", chosen, each->name);
            if (!each->letter.empty()) line += " -s " + each->letter;
            if (!each->choices.empty())
                line += fmt::format(" -x -a '{}'", fmt::join(each->choices, " "));
            else if (each->kind != ParameterKind::flag)
                line += " -r";
            lines += fmt::format("{} -d '{}'\n", line, quoted_help(*each));
        }
        if (const auto words = operand_words(*command); !words.empty())
            lines += fmt::format("{} -a '{}'\n", chosen, fmt::join(words, " "));
    }
    return lines;
}

int print_completion(const std::string& shell, const Session& session) {
    Session unused;
    const CommandLine line(commands(), unused);
    std::string script;
    if (shell == "bash") script = bash(line.commands());
    if (shell == "zsh") script = zsh(line.commands());
    if (shell == "fish") script = fish(line.commands());
    if (script.empty()) throw_unknown("shell", shell, std::vector<std::string>{"bash", "zsh", "fish"});
    session.result({{"shell", shell}, {"script", script}}, script);
    return 0;
}

}  // namespace

void add_completion(Command& command, Session& session) {
    command.examples(
        "  hogel completion bash > ~/.local/share/bash-completion/completions/hogel\n"
        "  hogel completion zsh > ~/.zfunc/_hogel\n"
        "  hogel completion fish > ~/.config/fish/completions/hogel.fish");
    auto shell = std::make_shared<std::string>();
    command.positional("shell", *shell, "bash|zsh|fish", "The shell").knows({"bash", "zsh", "fish"});
    command.work([shell, &session] { return print_completion(*shell, session); });
}

}  // namespace hogel::cli
