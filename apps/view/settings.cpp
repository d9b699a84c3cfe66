// SPDX-License-Identifier: Apache-2.0
#include "view/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "cli/commands.h"
#include "cli/like.h"
#include "hogel/error.h"

namespace hogel::view {
namespace {

using Arguments = std::vector<std::string>;

// Options that a page may change. All of them have a value.
constexpr std::array<std::string_view, 10> changeable{"hogels", "directions", "size",  "fov",   "front",
                                                      "move",   "rotate",     "light", "pitch", "layers"};
// Options of the server that other commands have for something else.
constexpr std::array<std::string_view, 2> of_server{"looks", "json"};

bool contains(const auto& names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

std::string_view name_of(std::string_view word) { return word.substr(0, word.find('=')); }

// Without an option, which has a value behind it or behind '='.
void remove(Arguments& words, std::string_view option) {
    for (std::size_t i = 0; i < words.size();) {
        const bool found = name_of(words[i]) == option, apart = words[i] == option;
        const auto begin = words.begin() + static_cast<std::ptrdiff_t>(i);
        if (found)
            words.erase(begin, begin + (apart && i + 1 < words.size() ? 2 : 1));
        else
            ++i;
    }
}

// An option as it stands in a command line, with its value; nothing where it is not.
Arguments find_option(const Arguments& words, std::string_view option) {
    const auto found = std::ranges::find_if(words, [&](const std::string& word) { return name_of(word) == option; });
    if (found == words.end()) return {};
    return {found, found + (*found == option && found + 1 != words.end() ? 2 : 1)};
}

// Whether a command takes an option ("--size").
bool takes(const std::string& command, std::string_view option) {
    static cli::Session none;
    static const cli::CommandLine line(cli::commands(), none);
    return line.look_up(command)->look_up(option) != nullptr;
}

}  // namespace

// A command line that is read. The session gives its options to the function that declares them.
struct Settings::Line : cli::Session {
    cli::ViewOptions view;
    std::unique_ptr<cli::CommandLine> parser;

    static void declare(cli::Command& command, cli::Session& session) {
        cli::add_view_options(command, static_cast<Line&>(session).view);
    }
};

std::shared_ptr<Settings::Line> Settings::parsed(const Arguments& words, const std::stop_source& stop) {
    static const cli::CommandInfo rows[] = {{"view", cli::view_summary, Line::declare}};
    auto line = std::make_shared<Line>();
    line->stop = stop;
    line->parser = std::make_unique<cli::CommandLine>(rows, *line);
    std::vector<const char*> arguments{"hogel", "view"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    line->command = line->parser->parse(static_cast<int>(arguments.size()), arguments.data());
    return line;
}

// The input may have the name of an option's value. It is the word in whose place the parser finds another input.
Settings::Settings(const cli::Session& session, const cli::ViewOptions& options)
    : input_(cli::require_viewable(options)), name_(options.input) {
    constexpr const char* another = "another input";
    for (char* const* at = session.arguments + 2; *at != nullptr; ++at) first_.emplace_back(*at);
    for (std::size_t i = 0; i < first_.size(); ++i) {
        if (first_[i] != name_) continue;
        Arguments words = first_;
        words[i] = another;
        try {
            if (parsed(words, session.stop)->view.input != another) continue;
        } catch (const Error&) {
            continue;  // the value of an option that expects something else
        }
        first_.erase(first_.begin() + static_cast<std::ptrdiff_t>(i));
        break;
    }
    words_ = first_;
    line_ = std::make_shared<Line>();
    line_->stop = session.stop;
    read();
}

// The parser is told another name, because that of a file may be one of a command.
void Settings::read() {
    Arguments words = words_;
    words.insert(words.begin(), "input");
    line_ = parsed(words, line_->stop);
    line_->view.input = name_;
}

const cli::Session& Settings::session() const { return *line_; }
const cli::ViewOptions& Settings::options() const { return line_->view; }

Settings Settings::with(const Settings::Words& changes) const {
    Settings changed = *this;
    for (const auto& [name, value] : changes) {
        if (!contains(changeable, name))
            throw Error(ErrorCode::usage, fmt::format("change: '{}' is no option that a page changes", name));
        remove(changed.words_, "--" + name);
        const Arguments word =
            value.empty() ? find_option(first_, "--" + name) : Arguments{fmt::format("--{}={}", name, value)};
        changed.words_.insert(changed.words_.end(), word.begin(), word.end());
    }
    changed.read();
    return changed;
}

Settings Settings::of(const std::string& file, const std::string& name) const {
    Settings other = *this;
    other.words_ = other.first_;
    remove(other.words_, "--original");
    other.name_ = name;
    other.read();
    cli::ViewOptions options = other.options();
    options.input = file;
    other.input_ = cli::require_viewable(options);
    other.is_dropped_ = true;
    return other;
}

bool Settings::same_light_field(const Settings& other) const {
    const auto light_field_words = [](Arguments words) {
        remove(words, "--pitch");
        return words;
    };
    return input_ == other.input_ && light_field_words(words_) == light_field_words(other.words_);
}

std::string Settings::command(const std::string& command, const std::string& input) const {
    std::string text = "hogel " + command + " " + cli::shell_word(input);
    for (std::size_t i = 0; i < words_.size(); ++i) {
        const std::string name{name_of(words_[i])};
        const Parameter* const own = line_->command->look_up(name);
        if (own == nullptr) continue;
        const bool is_flag = own->kind == ParameterKind::flag, has_value = name != words_[i];
        const std::string value = is_flag                 ? ""
                                  : has_value             ? words_[i].substr(name.size() + 1)
                                  : i + 1 < words_.size() ? words_[++i]
                                                          : "";
        if (contains(of_server, own->name) || !takes(command, name)) continue;
        text += " " + name + (is_flag ? "" : " " + cli::shell_word(value));
    }
    return text;
}

std::string Settings::photo_command() const {
    const std::string input = is_dropped_ ? name_ : input_;
    if (options().layers == 0) return command("photo", input);
    return fmt::format("hogel decompress {} -o layers.h5 --layers {} && {}", cli::shell_word(input), options().layers,
                       command("photo", "layers.h5"));
}

std::string Settings::original_command() const {
    return command("photo", !options().original.empty() ? options().original : is_dropped_ ? name_ : input_);
}

std::string Settings::make_command() const {
    const bool by_itself = std::ranges::any_of(words_, [](const std::string& word) {
        return takes("hologram", name_of(word)) && !takes("make", name_of(word));
    });
    const std::string input = is_dropped_ ? name_ : input_;
    return by_itself ? command("hologram", input) + " -o hologram.h5" : command("make", input) + " -o made";
}

}  // namespace hogel::view
