// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <map>
#include <sstream>
#include <vector>

#include "help.h"
#include "hogel/error.h"
#include "hogel/parameters.h"
#include "hogel/parts.h"
#include "hogel/version.h"
#include "like.h"
#include "session.h"
#include "standard_output.h"

namespace hogel::cli {
namespace {

CLI::Option* add_option(CLI::App& app, Parameter& parameter) {
    const std::string names = option_names(parameter);
    const std::string option_name = parameter.option();
    if (parameter.kind == ParameterKind::flag)
        return app
            .add_flag_function(
                names, [&parameter, option_name](std::int64_t) { parameter.read({"yes"}, option_name); },
                parameter.help)
            ->disable_flag_override();
    CLI::Option* option = nullptr;
    if (parameter.kind == ParameterKind::texts)
        option = app.add_option_function<std::vector<std::string>>(
                        names,
                        [&parameter, option_name](const std::vector<std::string>& texts) {
                            parameter.read(texts, option_name);
                        },
                        parameter.help)
                     ->allow_extra_args(parameter.is_positional);
    else
        option = app.add_option_function<std::string>(
            names, [&parameter, option_name](const std::string& text) { parameter.read({text}, option_name); },
            parameter.help);
    return option->type_name(parameter.type);
}

// Adds the parameters of a command as options of CLI11.
void add_options(CLI::App& app, Command& command) {
    std::map<std::string, CLI::Option*> options;
    for (Parameter& parameter : command.all()) {
        CLI::Option* option = options[parameter.name] = add_option(app, parameter);
        for (const std::string& other : parameter.excluded) option->excludes(options.at(other));
        for (const std::string& other : parameter.needed) option->needs(options.at(other));
    }
}

}  // namespace

bool Command::is_basic(const Parameter& parameter) const {
    return parameter.is_required || parameter.name == "like" || std::ranges::count(basics_, parameter.name) > 0;
}

void Command::add_like_option() {
    text("--like", like_, "FILE", "Take the options that made this file, except the ones given here")
        .no_default()
        .never_acts()
        .group = default_group;
}

void Command::complete() {
    if (const Parameter* like = look_up("like"); like != nullptr && like->is_given()) {
        if (like_.empty()) throw Error(ErrorCode::usage, "--like: the file name is empty");
        from_like_ = take_like(*this, like_);
    }
    require_parameters();
}

void Command::require_parameters() const {
    for (const Parameter& each : all())
        if (each.is_required && !each.is_given())
            throw Error(ErrorCode::usage, fmt::format("{} is required; see 'hogel {} --help'", each.option(), name()));
}

// Lists the options in a message that come from the file of --like.
std::string Command::origins(const std::string& message) const {
    std::vector<std::string> options;
    for (const std::string& each : from_like_)
        if (message.find("--" + each) != std::string::npos) options.push_back("--" + each);
    return options.empty() ? "" : fmt::format(" ({} as {} says)", fmt::join(options, ", "), like_);
}

std::string Command::describe(const Error& error) const {
    const std::string message = Parameters::describe(error);
    return message + origins(message);
}

namespace {

// Returns the version and the optional parts of this build.
std::string version_text() {
    std::vector<std::string> with, without;
    for (const Part& part : parts()) (part.built_in ? with : without).push_back(part.name);
    const auto line = [](const char* what, const std::vector<std::string>& names) {
        return names.empty() ? "" : fmt::format("\n{} {}", what, fmt::join(names, ", "));
    };
    return "hogel " HOGEL_VERSION + line("with", with) + line("without", without);
}

}  // namespace

struct CommandLine::Impl {
    CLI::App app{"hogel: full-parallax holographic stereograms, from scene to photograph", "hogel"};
    std::vector<std::unique_ptr<Command>> commands;

    Impl() {
        app.formatter(std::make_shared<HelpFormatter>());
        app.set_version_flag("-V,--version", version_text, "Print the version and the parts built in, and exit");
        app.set_help_flag("-h,--help", "Print this help and exit");
        app.require_subcommand(1);
        app.footer(
            "Lengths and angles have units: 16mm, 1.6um, 633nm, 20deg.\n"
            "SCENE is a mesh file (glTF, OBJ, PLY, STL and more), a picture or the name of a built-in scene;\n"
            "depths are positive behind the hologram and negative in front of it.\n"
            "'hogel help COMMAND' explains a command.\n"
            "\n"
            "Examples:\n"
            "  hogel make pumpkin -o pumpkin");
    }

    Command* find(const std::string& name) const {
        const auto found = std::ranges::find(commands, name, [](const auto& command) { return command->name(); });
        return found != commands.end() ? found->get() : nullptr;
    }

    Command* chosen() const { return find(app.get_subcommands().front()->get_name()); }
    bool has_unknown_option() const {
        return app.get_subcommands().empty() ||
               std::ranges::any_of(app.remaining(true), [](const std::string& word) { return word.starts_with('-'); });
    }

    // Returns the requested help or version text.
    std::string requested_text(const CLI::ParseError& error, const std::vector<std::string>& words) const {
        const auto chosen = app.get_subcommands();
        if (chosen.empty()) {
            std::ostringstream text;
            app.exit(error, text);
            return text.str();
        }
        const Command& command = *find(chosen.front()->get_name());
        if (std::ranges::count(words, "--json") > 0) return schema(command);
        const auto help_flag =
            std::ranges::find_if(words, [](const std::string& word) { return word == "--help" || word == "-h"; });
        const bool has_part =
            help_flag != words.end() && help_flag + 1 != words.end() && has_group(command, *(help_flag + 1));
        return help(command, has_part ? *(help_flag + 1) : "");
    }
};

CommandLine::CommandLine(std::span<const CommandInfo> commands, Session& session) : impl_(std::make_unique<Impl>()) {
    for (const CommandInfo& info : commands) {
        CLI::App* app = impl_->app.add_subcommand(info.name, info.text);
        app->group("Commands");
        Command& command = *impl_->commands.emplace_back(std::make_unique<Command>(info.name, info.text));
        add_common_options(command, session);
        info.add(command, session);
        add_options(*app, command);
    }
}

CommandLine::~CommandLine() = default;

Command* CommandLine::look_up(const std::string& name) const { return impl_->find(name); }

std::vector<const Command*> CommandLine::commands() const {
    std::vector<const Command*> all;
    for (const auto& command : impl_->commands) all.push_back(command.get());
    return all;
}

const Command* CommandLine::parse(int argc, const char* const* argv) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    // "help render all" is "render --help all".
    if (!words.empty() && words.front() == "help") {
        words.erase(words.begin());
        if (const Command* command = words.size() == 2 ? impl_->find(words.front()) : nullptr)
            require_group(*command, words.back());
        words.insert(words.begin() + (words.empty() ? 0 : 1), "--help");
    }
    if (!words.empty() && !words.front().starts_with('-') && impl_->find(words.front()) == nullptr)
        throw Error(ErrorCode::usage, explain_unknown_command(impl_->app, words.front()));
    const std::vector<std::string> given = words;
    std::ranges::reverse(words);  // CLI11 expects them in reverse order
    try {
        impl_->app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            // A missing required option is the more likely cause than the extra word.
            const bool is_extra_word = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
            if (is_extra_word && !impl_->has_unknown_option()) impl_->chosen()->require_parameters();
            throw Error(ErrorCode::usage, explain(impl_->app, error));
        }
        write_standard_output(impl_->requested_text(error, given));
        return nullptr;
    }
    Command* const command = impl_->find(impl_->app.get_subcommands().front()->get_name());
    command->complete();
    return command;
}

}  // namespace hogel::cli
