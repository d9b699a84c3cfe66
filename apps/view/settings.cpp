// SPDX-License-Identifier: Apache-2.0
#include "view/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "hogel/error.h"

namespace hogel::view {
namespace {

// Parameters that a page may change. All of them have a value.
constexpr std::array<std::string_view, 10> changeable{"hogels", "directions", "size",  "fov",   "front",
                                                      "move",   "rotate",     "light", "pitch", "layers"};
// A parameter of the server that other commands have for something else.
constexpr std::string_view of_server = "looks";

}  // namespace

// The values of the texts.
struct Settings::Line {
    ViewerParameters view;
    std::uint64_t seed = 1;
    Parameters table;

    Line() {
        view.declare(table);
        table.whole("--seed", seed, std::numeric_limits<std::uint64_t>::max(), "");
    }
};

Settings::Settings(const Parameters& given, Takes takes) : takes_(std::move(takes)) {
    for (const Parameter& each : given.all())
        if (each.is_given()) (each.name == "input" ? name_ : first_[each.name]) = each.value();
    words_ = first_;
    read();
    input_ = line_->view.viewable();
}

void Settings::read() {
    auto line = std::make_shared<Line>();
    for (const auto& word : words_)
        if (Parameter* const own = line->table.look_up(word.first))
            with_parameter(own->keyword(), [&] { own->read_value(word.second, own->option()); });
    line->table.require_compatible();
    line->view.input = name_;
    // What no scene can have is refused where it is changed.
    line->view.render.request();
    for (const std::string& light : line->view.render.scene.lights) parse_light(light);
    line_ = std::move(line);
}

const ViewerParameters& Settings::options() const { return line_->view; }
const Parameters& Settings::table() const { return line_->table; }
std::uint64_t Settings::seed() const { return line_->seed; }

Settings Settings::with(const Words& changes) const {
    Settings changed = *this;
    for (const auto& [name, value] : changes) {
        if (std::ranges::find(changeable, name) == changeable.end())
            throw Error(ErrorCode::usage, fmt::format("change: '{}' is no option that a page changes", name));
        const auto first = first_.find(name);
        if (!value.empty())
            changed.words_[name] = value;
        else if (first != first_.end())
            changed.words_[name] = first->second;
        else
            changed.words_.erase(name);
    }
    changed.read();
    return changed;
}

Settings Settings::of(const std::string& file, const std::string& name) const {
    Settings other = *this;
    other.words_ = other.first_;
    other.words_.erase("original");
    other.name_ = name;
    other.read();
    ViewerParameters options = other.options();
    options.input = file;
    other.input_ = options.viewable();
    other.is_dropped_ = true;
    return other;
}

bool Settings::same_light_field(const Settings& other) const {
    const auto light_field_words = [](Words words) {
        words.erase("pitch");
        return words;
    };
    return input_ == other.input_ && light_field_words(words_) == light_field_words(other.words_);
}

std::string Settings::command(const std::string& command, const std::string& input) const {
    std::string text = "hogel " + command + line_->table.look_up("input")->option_text(input);
    for (const Parameter& each : line_->table.all())
        if (each.is_given() && each.name != of_server && takes_(command, each.name))
            text += each.option_text(each.value());
    return text;
}

std::string Settings::photo_command() const {
    const std::string input = is_dropped_ ? name_ : input_;
    if (options().layers == 0) return command("photo", input);
    return fmt::format("hogel decompress{} -o layers.h5 --layers {} && {}",
                       line_->table.look_up("input")->option_text(input), options().layers,
                       command("photo", "layers.h5"));
}

std::string Settings::original_command() const {
    return command("photo", !options().original.empty() ? options().original : is_dropped_ ? name_ : input_);
}

std::string Settings::make_command() const {
    const bool by_itself = std::ranges::any_of(
        words_, [&](const auto& word) { return takes_("hologram", word.first) && !takes_("make", word.first); });
    const std::string input = is_dropped_ ? name_ : input_;
    return by_itself ? command("hologram", input) + " -o hologram.h5" : command("make", input) + " -o made";
}

}  // namespace hogel::view
