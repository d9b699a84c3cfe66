// SPDX-License-Identifier: Apache-2.0
#include "like.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "command_line.h"
#include "commands.h"
#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/image.h"
#include "hogel/scene.h"

namespace hogel::cli {
namespace {

constexpr std::string_view option_prefix = "option ";

// Returns the command stored in the entries, or an empty text.
std::string command_in(const Metadata& entries) {
    const auto found = std::ranges::find(entries, "command", &Metadata::value_type::first);
    return found == entries.end() ? "" : found->second;
}

// Returns the metadata of a file. For `hogel make` only the report contains all options; its other files contain those
// that acted on them.
Metadata entries_of(const std::string& file, const Command& command) {
    if (const std::optional<Metadata> run = run_of_make(file)) return *run;
    if (command.name() == "make")
        throw Error(
            ErrorCode::bad_input,
            fmt::format("--like: {} is not a run of 'hogel make'; expected its folder or its report.json", file));
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        throw Error(ErrorCode::bad_input, fmt::format("--like: {} is a folder; expected a file", file));
    switch (file_kind(file)) {
        case FileKind::picture:
            return read_metadata(file);
        case FileKind::mesh:
            return import_scene(file, Progress()).provenance;
        default:
            return summarize(file).text;
    }
}

void require_same_command(const Metadata& entries, const Command& command, const std::string& file) {
    const std::string command_name = command_in(entries);
    if (command_name.empty())
        throw Error(ErrorCode::bad_input, fmt::format("--like: {} does not store the command that made it", file));
    if (command_name != "hogel " + command.name())
        throw Error(ErrorCode::bad_input,
                    fmt::format("--like: {} was made by '{}', not by 'hogel {}'", file, command_name, command.name()));
}

// Returns the names of the given parameters and of the parameters that these exclude.
std::set<std::string> names_to_keep(const Command& command) {
    std::set<std::string> keep;
    for (const Parameter& each : command.all()) {
        if (each.is_given()) {
            keep.insert(each.name);
            keep.insert(each.excluded.begin(), each.excluded.end());
        }
        for (const std::string& other : each.excluded)
            if (command.given(other)) keep.insert(each.name);
    }
    return keep;
}

}  // namespace

std::optional<Metadata> run_of_make(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::filesystem::path report = is_directory(path, ignored) ? path / "report.json" : path;
    if (report.extension() != ".json") return {};
    std::ifstream file(report);
    const auto json = nlohmann::json::parse(file, nullptr, false);
    const auto run = json.is_object() ? json.find("run") : json.end();
    if (run == json.end() || !run->is_object()) return {};
    Metadata entries;
    for (const auto& [name, value] : run->items())
        if (value.is_string()) entries.emplace_back(name, value.get<std::string>());
    return entries;
}

std::vector<std::string> take_like(Command& command, const std::string& file) {
    const Metadata entries = entries_of(file, command);
    require_same_command(entries, command, file);
    const std::set<std::string> keep = names_to_keep(command);
    std::vector<std::string> taken;
    for (const auto& [key, value] : entries) {
        if (!key.starts_with(option_prefix)) continue;
        const std::string name = key.substr(option_prefix.size());
        Parameter* const parameter = command.look_up(name);
        if (parameter == nullptr)
            throw Error(ErrorCode::bad_input, fmt::format("--like: {} was made with --{}, which hogel {} does not have",
                                                          file, name, command.name()));
        const bool is_off = parameter->kind == ParameterKind::flag && value == "no";
        if (keep.contains(name) || is_off) continue;
        parameter->read_value(value, fmt::format("{}: --{}", file, name));
        taken.push_back(name);
    }
    return taken;
}

std::string command_line_of(const Metadata& entries) {
    const std::string command_name = command_in(entries);
    constexpr std::string_view program = "hogel ";
    if (!command_name.starts_with(program)) return "";
    Session ignored;
    const CommandLine line(commands(), ignored);
    const Command* const command = line.look_up(command_name.substr(program.size()));
    if (command == nullptr) return "";
    std::string operands, options;
    for (const auto& [key, value] : entries) {
        if (!key.starts_with(option_prefix)) continue;
        const Parameter* const parameter = command->look_up(key.substr(option_prefix.size()));
        if (parameter == nullptr) continue;
        (parameter->is_positional ? operands : options) += parameter->option_text(value);
    }
    // Some files of `hogel make` do not store the scene.
    const bool has_operand =
        std::ranges::any_of(command->all(), [](const Parameter& each) { return each.is_positional; });
    return has_operand && operands.empty() ? "" : command_name + operands + options;
}

}  // namespace hogel::cli
