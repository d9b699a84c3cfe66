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

// Parameters that a page may change. None of them is a flag.
constexpr std::array<std::string_view, 10> changeable{"hogels", "directions", "size",  "fov",   "front",
                                                      "move",   "rotate",     "light", "pitch", "layers"};
// Has another meaning in other commands.
constexpr std::string_view server_option = "looks";

}  // namespace

// Parsed values.
struct Settings::Values {
    ViewerParameters view;
    std::uint64_t seed = 1;
    Parameters table;

    Values() {
        view.declare(table);
        table.whole("--seed", seed, std::numeric_limits<std::uint64_t>::max(), "");
    }
};

Settings::Settings(const Parameters& given, Takes takes) : takes_(std::move(takes)) {
    for (const Parameter& each : given.all())
        if (each.is_given()) (each.name == "input" ? name_ : initial_[each.name]) = each.value();
    words_ = initial_;
    read();
    input_ = values_->view.viewable();
}

void Settings::read() {
    auto values = std::make_shared<Values>();
    for (const auto& word : words_)
        if (Parameter* const parameter = values->table.look_up(word.first))
            with_parameter(parameter->keyword(), [&] { parameter->read_value(word.second, parameter->option()); });
    values->table.require_compatible();
    values->view.input = name_;
    // Validates here, so that the change is refused and not the later rendering.
    values->view.render.request();
    for (const std::string& light : values->view.render.scene.lights) parse_light(light);
    values_ = std::move(values);
}

const ViewerParameters& Settings::options() const { return values_->view; }
const Parameters& Settings::table() const { return values_->table; }
std::uint64_t Settings::seed() const { return values_->seed; }

Settings Settings::with(const Words& changes) const {
    Settings changed = *this;
    for (const auto& [name, value] : changes) {
        if (std::ranges::find(changeable, name) == changeable.end())
            throw Error(ErrorCode::usage, fmt::format("change: '{}' cannot be changed by a page", name));
        const auto first = initial_.find(name);
        if (!value.empty())
            changed.words_[name] = value;
        else if (first != initial_.end())
            changed.words_[name] = first->second;
        else
            changed.words_.erase(name);
    }
    changed.read();
    return changed;
}

Settings Settings::for_input(const std::string& file, const std::string& name) const {
    Settings other = *this;
    other.words_ = other.initial_;
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
    std::string text = "hogel " + command + values_->table.look_up("input")->option_text(input);
    for (const Parameter& each : values_->table.all())
        if (each.is_given() && each.name != server_option && takes_(command, each.name))
            text += each.option_text(each.value());
    return text;
}

std::string Settings::photo_command() const {
    const std::string input = is_dropped_ ? name_ : input_;
    if (options().layers == 0) return command("photo", input);
    return fmt::format("hogel decompress{} -o layers.h5 --layers {} && {}",
                       values_->table.look_up("input")->option_text(input), options().layers,
                       command("photo", "layers.h5"));
}

std::string Settings::original_command() const {
    return command("photo", !options().original.empty() ? options().original : is_dropped_ ? name_ : input_);
}

std::string Settings::make_command() const {
    const bool needs_hologram = std::ranges::any_of(
        words_, [&](const auto& word) { return takes_("hologram", word.first) && !takes_("make", word.first); });
    const std::string input = is_dropped_ ? name_ : input_;
    return needs_hologram ? command("hologram", input) + " -o hologram.h5" : command("make", input) + " -o made";
}

}  // namespace hogel::view
