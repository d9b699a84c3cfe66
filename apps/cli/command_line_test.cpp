// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "commands.h"
#include "hogel/parameters.h"
#include "session.h"

namespace hogel::cli {
namespace {

double pupil = 0, f_number = 0, depth = 0;

void add_photo(Command& command, Session&) {
    command.positive_length("--pupil", pupil, "");
    command.number("--f-number", f_number, "NUMBER", "").sets_parameter("pupil");
    command.length("--focal-plane", depth, "");
    command.work([] { return 0; });
}

// Returns the error message of `hogel photo` with these arguments.
std::string description(std::vector<const char*> arguments, const Error& error) {
    const CommandInfo photo{"photo", "", add_photo};
    Session session;
    CommandLine line({&photo, 1}, session);
    arguments.insert(arguments.begin(), {"hogel", "photo"});
    return line.parse(static_cast<int>(arguments.size()), arguments.data())->describe(error);
}

TEST(Command, names_the_option_of_the_name_of_a_parameter_whether_given_or_not) {
    const Error error(ErrorCode::usage, "focal_plane", "too near");
    EXPECT_EQ(description({}, error), "--focal-plane: too near");
    EXPECT_EQ(description({"--focal-plane", "1mm"}, error), "--focal-plane: too near");
}

TEST(Command, names_those_options_that_were_given_and_set_a_parameter) {
    const Error error(ErrorCode::usage, "pupil", "too wide");
    EXPECT_EQ(description({}, error), "--pupil: too wide");
    EXPECT_EQ(description({"--f-number", "2"}, error), "--f-number: too wide");
    EXPECT_EQ(description({"--f-number", "2", "--pupil", "4mm"}, error), "--pupil, --f-number: too wide");
}

TEST(Command, names_options_of_all_parameters_and_no_others) {
    EXPECT_EQ(description({}, Error(ErrorCode::usage, "pupil, focal_plane, pitch", "no")),
              "--pupil, --focal-plane: no");
    EXPECT_EQ(description({}, Error(ErrorCode::usage, "no")), "no");
    EXPECT_EQ(description({}, Error(ErrorCode::bad_input, "pupil", "no")), "no");
}

TEST(CommandLine, has_the_basic_options_of_each_command) {
    Session session;
    const CommandLine line(commands(), session);
    for (const Command* command : line.commands())
        for (const std::string& name : command->basics())
            EXPECT_NE(command->look_up(name), nullptr) << command->name() << " --" << name;
}

// Returns a random valid text for a parameter; empty for kinds that are checked only on use.
std::string drawn_text(const Parameter& parameter, std::mt19937_64& random) {
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto count = [&] { return fmt::format("{}", 1 + random() % 500); };
    switch (parameter.kind) {
        case ParameterKind::flag:
            return "yes";
        case ParameterKind::text:
        case ParameterKind::texts:
            return "";
        case ParameterKind::choice:
            return parameter.choices[random() % parameter.choices.size()];
        case ParameterKind::number:
            return fmt::format("{}", number(parameter.low.value_or(0.1), parameter.high.value_or(9)));
        case ParameterKind::count:
        case ParameterKind::whole:
            return count();
        case ParameterKind::counts:
        case ParameterKind::resolution:
            return random() % 2 ? count() : count() + "x" + count();
        case ParameterKind::length:
            return fmt::format("{}mm", number(-50, 50));
        case ParameterKind::positive_length:
            return fmt::format("{}um", number(0.1, 500));
        case ParameterKind::wavelengths:
            return fmt::format("{},{}nm", number(400, 500), number(600, 700));
        case ParameterKind::angle:
            return fmt::format("{}deg", number(-90, 90));
        case ParameterKind::angles:
            return fmt::format("{},{}rad", number(0, 2), number(0, 2));
        case ParameterKind::point:
            return fmt::format("{},{},{}mm", number(-9, 9), number(-9, 9), number(100, 300));
        case ParameterKind::rotation:
            return fmt::format("{},{},{}deg", number(-90, 90), number(-90, 90), number(-90, 90));
    }
    return "";
}

// Returns the metadata of a command if all its parameters acted.
Metadata described(const Command& command) {
    Metadata all;
    for (const Parameter& each : command.all()) all.emplace_back(each.name, each.written());
    return all;
}

TEST(Parameters, of_each_command_that_are_described_and_read_again_are_the_same) {
    std::mt19937_64 random(1);
    Session session;
    constexpr std::size_t draws = 1000;
    const CommandLine names(commands(), session);
    for (const Command* each : names.commands()) {
        Session one, other;
        const CommandLine first(commands(), one), second(commands(), other);
        Command& drawn = *first.look_up(each->name());
        Command& again = *second.look_up(each->name());
        for (std::size_t draw = 0; draw < draws; ++draw) {
            for (Parameter& parameter : drawn.all())
                if (const std::string text = random() % 3 ? "" : drawn_text(parameter, random); !text.empty())
                    parameter.read_value(text, parameter.name);
            for (Parameter& parameter : drawn.all())
                if (parameter.is_given())
                    again.look_up(parameter.name)->read_value(parameter.written(), parameter.name);
            ASSERT_EQ(described(again), described(drawn)) << each->name();
        }
    }
}

// The parameter of the error that the work throws.
template <class Work>
std::string parameter_of(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.parameter();
    }
    return "no error";
}

TEST(ErrorParameters, are_added_where_there_is_none) {
    const auto throws = [](const char* parameter) { throw Error(ErrorCode::usage, parameter, "no"); };
    EXPECT_EQ(parameter_of([&] { with_parameter("size", [&] { throws(""); }); }), "size");
    EXPECT_EQ(parameter_of([&] { with_parameter("size", [&] { throws("fov"); }); }), "fov");
}

TEST(ErrorParameters, are_renamed_or_dropped) {
    const auto throws = [] { throw Error(ErrorCode::usage, "fov, pitch", "no"); };
    EXPECT_EQ(parameter_of([&] { with_renamed_parameters({{"pitch", "output_pitch"}}, throws); }), "fov, output_pitch");
    EXPECT_EQ(parameter_of([&] { with_renamed_parameters({{"fov", ""}}, throws); }), "pitch");
    EXPECT_EQ(parameter_of([&] { with_renamed_parameters({{"size", ""}}, throws); }), "fov, pitch");
}

}  // namespace
}  // namespace hogel::cli
