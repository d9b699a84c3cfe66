// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ranges>
#include <sstream>

#include "error_parameters.h"
#include "help.h"
#include "hogel/error.h"
#include "hogel/parts.h"
#include "hogel/version.h"
#include "session.h"
#include "standard_output.h"

namespace hogel::cli {
namespace {

// What is wrong with a number, or nothing.
std::string finite_number(const std::string& text) {
    return parse_number(text) ? "" : fmt::format("'{}' is not a number", text);
}

}  // namespace

Option Option::required() const {
    option_->required()->default_str("");  // the help shows no default, which would never be used
    return *this;
}

Option Option::excludes(const Option& other) const {
    option_->excludes(other.option_);
    return *this;
}

Option Option::excludes(const std::string& name) const { return excludes(command_->option(name)); }

Option Option::needs(const Option& other) const {
    option_->needs(other.option_);
    return *this;
}

Option Option::default_text(const std::string& text) const {
    option_->default_str(text);
    return *this;
}

Option Option::range(double low, double high) const {
    option_->check([low, high](const std::string& text) {
        const std::optional<double> number = parse_number(text);
        const bool inside = number && *number >= low && *number <= high;
        return inside ? "" : fmt::format("'{}' is not a number from {} to {}", text, low, high);
    });
    return *this;
}

Option Option::positive() const {
    option_->check([](const std::string& text) {
        const std::optional<double> number = parse_number(text);
        return number && *number > 0 ? "" : fmt::format("'{}' is not a positive number", text);
    });
    return *this;
}

Option Option::sets(bool& given) const {
    option_->each([&given](const std::string&) { given = true; });
    return *this;
}

Option Option::sets_parameter(const std::string& parameter) const {
    command_->setters_.emplace(parameter, option_->get_name());
    return *this;
}

Command::Command(CLI::App& app) : app_(app) { app_.get_option("--help")->group(Command::last_group); }

std::string Command::name() const { return app_.get_name(); }

void Command::examples(const std::string& lines) { app_.footer("Examples:\n" + lines); }

Option Command::add(CLI::Option* option) {
    option->group(group_);
    return {*this, option};
}

Option Command::option(const std::string& name) { return {*this, app_.get_option(name)}; }

Option Command::positional(const std::string& name, std::string& value, const std::string& type,
                           const std::string& help) {
    return add(app_.add_option(name, value, help)->type_name(type)->required());
}

Option Command::positionals(const std::string& name, std::vector<std::string>& values, const std::string& type,
                            const std::string& help) {
    return add(app_.add_option(name, values, help)->type_name(type)->required());
}

Option Command::text(const std::string& name, std::string& value, const std::string& type, const std::string& help) {
    return add(app_.add_option(name, value, help)->type_name(type)->capture_default_str());
}

Option Command::texts(const std::string& name, std::vector<std::string>& values, const std::string& type,
                      const std::string& help) {
    return add(app_.add_option(name, values, help)->type_name(type)->allow_extra_args(false));
}

Option Command::parsed(const std::string& name, const std::string& type, const std::string& help,
                       std::function<void(const std::string& text)> read) {
    return read_option(name, type, "", help,
                       [read = std::move(read)](const std::string& text, const std::string&) { read(text); });
}

Option Command::number(const std::string& name, double& value, const std::string& type, const std::string& help) {
    return add(app_.add_option(name, value, help)->type_name(type)->capture_default_str()->check(finite_number));
}

Option Command::number(const std::string& name, std::optional<double>& value, const std::string& type,
                       const std::string& help) {
    return add(app_.add_option(name, value, help)->type_name(type)->check(finite_number));
}

Option Command::flag(const std::string& name, bool& value, const std::string& help) {
    return add(app_.add_flag(name, value, help));
}

Option Command::flag(const std::string& name, const std::string& help) {
    return add(app_.add_flag_function(
        name, [](std::int64_t) {}, help));
}

Option Command::choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
                       const std::string& type, const std::string& help) {
    return add(app_.add_option(name, value, help)
                   ->type_name(type)
                   ->check(CLI::IsMember(words).description(""))
                   ->capture_default_str());
}

Option Command::read_option(const std::string& name, const std::string& type, const std::string& shown,
                            const std::string& help, Read read) {
    const std::string called = name.substr(0, name.find(','));
    return add(app_.add_option_function<std::string>(
                       name, [called, read = std::move(read)](const std::string& text) { read(text, called); }, help)
                   ->type_name(type)
                   ->default_str(shown));
}

bool Command::given(const std::string& name) const { return app_.get_option(name)->count() > 0; }

std::vector<std::string> Command::setters(const std::string& parameter) const {
    std::string name = "--" + parameter;
    std::ranges::replace(name, '_', '-');
    std::vector<std::string> names;
    if (app_.get_option_no_throw(name) != nullptr) names.push_back(name);
    const auto [first, last] = setters_.equal_range(parameter);
    for (auto each = first; each != last; ++each) names.push_back(each->second);
    return names;
}

std::string Command::describe(const Error& error) const {
    std::vector<std::string> options;
    const auto take = [&](const std::string& option) {
        if (!std::ranges::count(options, option)) options.push_back(option);
    };
    for (const std::string& parameter : names_of_parameters(error.parameter())) {
        const std::vector<std::string> names = setters(parameter);
        const auto is_given = [&](const std::string& name) { return given(name); };
        if (std::ranges::any_of(names, is_given))
            std::ranges::for_each(names | std::views::filter(is_given), take);
        else if (!names.empty())
            take(names.front());
    }
    return options.empty() ? error.what() : fmt::format("{}: {}", fmt::join(options, ", "), error.what());
}

Metadata Command::values() const {
    Metadata values;
    for (const CLI::Option* option : app_.get_options()) {
        const bool is_flag = option->get_expected_min() == 0, is_given = option->count() > 0;
        std::string value = is_given ? CLI::detail::join(option->results(), " ") : option->get_default_str();
        if (is_flag) value = is_given ? "yes" : "no";
        values.emplace_back(option->get_single_name(), value);
    }
    return values;
}

namespace {

// The version, and a line that names the optional parts of this build.
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
            "SCENE is a mesh file (glTF, OBJ, PLY, STL and more) or the name of a built-in scene;\n"
            "depths are positive behind the hologram and negative in front of it.\n"
            "'hogel help COMMAND' explains a command.\n"
            "\n"
            "Examples:\n"
            "  hogel make pumpkin -o pumpkin");
    }

    const Command* find(const std::string& name) const {
        const auto found = std::ranges::find(commands, name, [](const auto& command) { return command->name(); });
        return found != commands.end() ? found->get() : nullptr;
    }
};

CommandLine::CommandLine(std::span<const CommandInfo> commands, Session& session) : impl_(std::make_unique<Impl>()) {
    for (const CommandInfo& info : commands) {
        CLI::App* app = impl_->app.add_subcommand(info.name, info.text);
        app->group("Commands");
        Command& command = *impl_->commands.emplace_back(std::make_unique<Command>(*app));
        add_common_options(command, session);
        info.add(command, session);
    }
}

CommandLine::~CommandLine() = default;

const Command* CommandLine::parse(int argc, const char* const* argv) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    // "help render" is "render --help".
    if (!words.empty() && words.front() == "help") {
        words.erase(words.begin());
        words.resize(std::min<std::size_t>(words.size(), 1));
        words.emplace_back("--help");
    }
    if (!words.empty() && !words.front().starts_with('-') && impl_->find(words.front()) == nullptr)
        throw Error(ErrorCode::usage, explain_unknown_command(impl_->app, words.front()));
    std::ranges::reverse(words);  // CLI11 expects them in reverse order
    try {
        impl_->app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw Error(ErrorCode::usage, explain(impl_->app, error));
        std::ostringstream help;
        impl_->app.exit(error, help);
        write_standard_output(help.str());
        return nullptr;
    }
    return impl_->find(impl_->app.get_subcommands().front()->get_name());
}

}  // namespace hogel::cli
