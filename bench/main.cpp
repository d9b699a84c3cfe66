// SPDX-License-Identifier: Apache-2.0
// Commands and options of hogel-bench. The only file of the program that includes CLI11.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <new>

#include "bench/codec/codec.h"
#include "bench/patterns/patterns.h"
#include "bench/peers/coders.h"
#include "bench/peers/renderers.h"
#include "bench/render/render.h"
#include "bench/session.h"
#include "hogel/error.h"
#include "hogel/resources.h"
#include "hogel/table.h"
#include "hogel/version.h"
#include "thesis/wavelets/transform.h"

namespace hogel::bench {
namespace {

// One run: the options shared by all commands, and the work of the chosen command.
struct Program {
    Session session;
    std::size_t threads = 0;  // 0: all
    std::function<void()> run;
};

// Adds an option with a value read by `parse`, which throws Error(usage) with the option's name.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App* command, const std::string& name, Value& value, const std::string& help,
                        const char* type, const std::string& shown, Parse parse) {
    return command
        ->add_option_function<std::string>(
            name, [&value, name, parse](const std::string& text) { value = parse(text, name); }, help)
        ->type_name(type)
        ->default_str(shown);
}

void add_count(CLI::App* command, const std::string& name, std::size_t& count, const std::string& help) {
    add_parsed(command, name, count, help, "N", fmt::format("{}", count), parse_count);
}

void add_names(CLI::App* command, const std::string& name, std::vector<std::string>& names, const std::string& help) {
    command->add_option(name, names, help)->type_name("NAME,...")->delimiter(',');
}

// Adds an option for a number in a range. Shows no default if the value is optional.
template <class Value>
void add_number(CLI::App* command, const std::string& name, Value& value, const CLI::Range& range,
                const std::string& help, const char* type) {
    CLI::Option* option =
        command->add_option(name, value, help)->type_name(type)->check(CLI::Validator(range).description(""));
    if constexpr (std::is_arithmetic_v<Value>) option->capture_default_str();
}

void add_size(CLI::App* command, double& metres) {
    add_parsed(command, "--size", metres, "Width of the hologram", "LENGTH", typed_length(metres),
               [](const std::string& text, const std::string& name) { return parse_length(text, name); });
}

void add_field_of_view(CLI::App* command, Angles& angles) {
    add_parsed(command, "--fov", angles, "Field of view, the full angle; or across and down", "ANGLE[,ANGLE]",
               typed(angles), parse_angles);
}

void add_output(CLI::App* command, std::string& output) {
    command->add_option("-o,--output", output, "Folder for plots, SVG")->type_name("DIR");
}

template <class Options>
CLI::App* add_command(CLI::App& app, Program& program, const char* name, const char* description,
                      const std::shared_ptr<Options>& options, std::function<void(const Options&)> run) {
    CLI::App* command = app.add_subcommand(name, description);
    command->add_option("--threads", program.threads, "Threads to use; 0: as many as there are cores")
        ->type_name("N")
        ->capture_default_str();
    command->callback([&program, options, run = std::move(run)] { program.run = [options, run] { run(*options); }; });
    return command;
}

void add_session_options(CLI::App* command, Session& session) {
    command->add_flag("-q,--quiet", session.quiet, "Print tables and errors alone");
    command->add_flag("-v,--verbose", session.verbose, "Print what is measured at present");
}

void add_render_light_field(CLI::App* command, RenderOptions& options) {
    const RenderDefaults& d = render_defaults;
    add_parsed(command, "--hogels", options.hogels,
               fmt::format("Hogels across and down ({0}x{0}; with --peers {1}x{1} and {0}x{0}, with --scaling {1}x{1}, "
                           "with --stream {2}x{2}; with --dense those that fill the width, {3})",
                           d.hogels, d.few_hogels, d.stream_hogels, d.dense_across),
               "WxH", "", parse_counts);
    add_parsed(
        command, "--directions", options.directions,
        fmt::format("Directions across and down in each hogel ({0}x{0}; with --peers, --stream and --dense {1}x{1})",
                    d.directions, d.many_directions),
        "WxH", "", parse_counts);
    add_size(command, options.size);
    add_field_of_view(command, options.field_of_view);
    command
        ->add_option("--shading", options.shading,
                     fmt::format("Model of shading; if none is named, that of the thesis or {}", default_shading))
        ->type_name("NAME");
    add_number(command, "--cache-spacing", options.cache_spacing, CLI::Range(0.0, 16.0),
               fmt::format("As of hogel render; if none is given 0, no cache, but {:g} with --scaling and --stream",
                           default_cache_spacing),
               "F");
}

struct RenderChoice : RenderOptions {
    bool scaling = false, stream = false, dense = false, interpolation = false, tiles = false;
    CLI::Option* peers_option = nullptr;
};

void measure_render(const RenderChoice& choice, const Session& session) {
    if (choice.peers_option->count() > 0)
        measure_peers(choice, session);
    else if (choice.scaling)
        measure_scaling(choice, session);
    else if (choice.stream)
        measure_stream(choice, session);
    else if (choice.dense)
        measure_dense(choice, session);
    else if (choice.interpolation)
        measure_interpolation(choice, session);
    else if (choice.tiles)
        measure_tiles(choice, session);
    else
        measure_regions(choice, session);
}

void add_render_measurements(CLI::App* command, RenderChoice& options) {
    std::vector<std::string> peer_names{""};
    for (const RenderPeerInfo& peer : render_peers()) peer_names.push_back(peer.name);
    options.peers_option =
        command
            ->add_option("--peers", options.peers,
                         fmt::format("Instead: samples a second, side by side with {}; all if none are named",
                                     fmt::join(peer_names.begin() + 1, peer_names.end(), ", ")))
            ->type_name("NAME,...")
            ->expected(0, static_cast<int>(render_peers().size()))
            ->delimiter(',')
            ->check(CLI::IsMember(peer_names).description(""));
    CLI::Option* scaling = command->add_flag("--scaling", options.scaling,
                                             "Instead: how the time grows with hogels, directions and triangles, and "
                                             "what a second thread gains");
    CLI::Option* stream = command->add_flag("--stream", options.stream,
                                            "Instead: whole light fields, which may be larger than memory, into a "
                                            "sink that keeps nothing of them");
    scaling->excludes(options.peers_option);
    stream->excludes(options.peers_option)->excludes(scaling);
    command
        ->add_flag("--dense", options.dense,
                   "Instead: the regions with hogels so close that a point moves less than a direction from one to the "
                   "next, and the three curves of Kartch's thesis in a plot of their own")
        ->excludes(options.peers_option)
        ->excludes(scaling)
        ->excludes(stream);
    command->add_flag("--tiles", options.tiles, "Instead: processor time of each tile of 4x4 hogels, microseconds")
        ->excludes(options.peers_option)
        ->excludes(scaling)
        ->excludes(stream);
    command
        ->add_flag("--interpolation", options.interpolation,
                   "Instead: error and time of shading that is interpolated between viewpoints")
        ->excludes(options.peers_option)
        ->excludes(scaling)
        ->excludes(stream);
}

void add_render(CLI::App& app, Program& program) {
    auto options = std::make_shared<RenderChoice>();
    CLI::App* command = add_command<RenderChoice>(
        app, program, "render", "Renderers: time for each hogel against the size of the region", options,
        [&session = program.session](const RenderChoice& choice) { measure_render(choice, session); });
    command->footer(
        "Examples:\n"
        "  hogel-bench render -o plots\n"
        "  hogel-bench render --scenes pumpkin --algorithms zbuffer,simplex,epi --largest 32\n"
        "  hogel-bench render --peers --scenes church,pumpkin:10 --threads 2\n"
        "  hogel-bench render --dense --scenes church-radiance,pumpkin -o plots\n"
        "  hogel-bench render --scaling -o plots\n"
        "  hogel-bench render --stream --scenes pumpkin --hogels 512 --directions 256");
    add_session_options(command, program.session);
    add_output(command, options->output);
    command
        ->add_option("--scenes", options->scenes,
                     "Scenes; pumpkin:10 is one whose triangles are cut into 10 x 10 each; those of the thesis if none "
                     "are named")
        ->type_name("SCENE,...")
        ->delimiter(',');
    add_names(command, "--algorithms", options->algorithms,
              fmt::format("Renderers; all if none are named; with --peers, --scaling and --stream the first, or {}",
                          default_algorithm));
    add_render_light_field(command, *options);
    add_parsed(command, "--largest", options->max_side,
               fmt::format("Largest side of a region, in hogels ({})", render_defaults.dense_side), "N", "",
               parse_count);
    add_number(
        command, "--seconds", options->seconds, CLI::Range(1e-3, 1e6),
        fmt::format("Stop enlarging regions that would take longer ({:g}); with --dense, measure a part of their "
                    "directions instead ({:g}); with --peers, time of each peer in a round ({:g})",
                    render_defaults.seconds, render_defaults.dense_seconds, render_defaults.peer_seconds),
        "S");
    add_number(command, "--memory", options->gigabytes, CLI::Range(1e-3, 1e6),
               "Stop enlarging regions that would take more, at 20 bytes a ray; with --dense, render them in slabs of "
               "directions",
               "GB");
    add_render_measurements(command, *options);
    add_count(command, "--rounds", options->rounds, "Rounds of which --peers and --scaling take medians");
}

void add_codec(CLI::App& app, Program& program) {
    auto options = std::make_shared<CodecOptions>();
    CLI::App* command = add_command<CodecOptions>(
        app, program, "codec", "Coders: quality against size, and speed", options,
        [&session = program.session](const CodecOptions& chosen) { measure_codec(chosen, session); });
    command->footer(
        "Examples:\n"
        "  hogel-bench codec pumpkin --hogels 16x16 --directions 128 -o plots\n"
        "  hogel-bench codec a.h5 --coders hogel --grey --peers x265,svt-av1");
    command
        ->add_option("input", options->input,
                     "Light field or scene; dense, dense-hdr: ellipses that hardly move from hogel to hogel")
        ->type_name("X.h5|X.hgl|SCENE|dense|dense-hdr")
        ->required();
    add_session_options(command, program.session);
    add_output(command, options->output);
    add_names(command, "--coders", options->coders,
              fmt::format("{}; all if none are named", fmt::join(coders().names(), ", ")));
    command->add_option("--transforms", options->transforms, "Transforms; all if none are named")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->check(CLI::IsMember(wavelets::transform_names()).description(""));
    command->add_option("--sqnr", options->sqnrs, "SQNRs at which to print the rate")
        ->type_name("DB,...")
        ->delimiter(',')
        ->check(CLI::Range(1.0, 120.0).description(""))
        ->capture_default_str();
    command->add_option("--ppb", options->rates, "Pixels per bit at which to print the SQNR")
        ->type_name("N,...")
        ->delimiter(',')
        ->check(CLI::PositiveNumber.description(""))
        ->capture_default_str();
    command->add_flag("--thesis", options->thesis,
                      "Draw the point that Kartch's thesis gives, 30 dB at 8 pixels a bit");
    command->add_flag("--grey", options->grey, "Measure the mean of the colours");
    command
        ->add_option("--peers", options->peers,
                     fmt::format("Others, where they are installed: {}", fmt::join(coder_peers(), ", ")))
        ->type_name("NAME,...")
        ->delimiter(',')
        ->check(CLI::IsMember(coder_peers()).description(""));
    LightFieldOptions& light_field = options->light_field;
    add_parsed(command, "--hogels", light_field.hogels, "Hogels of a scene, across and down", "WxH",
               typed(light_field.hogels), parse_counts);
    add_parsed(command, "--directions", light_field.directions, "Directions across and down in each hogel", "WxH",
               typed(light_field.directions), parse_counts);
    add_size(command, light_field.size);
    add_field_of_view(command, light_field.field_of_view);
    command->add_option("--algorithm", light_field.algorithm, "Renderer")->type_name("NAME")->capture_default_str();
    command->add_option("--shading", light_field.shading, "Model of shading")->type_name("NAME")->capture_default_str();
    add_number(command, "--cache-spacing", light_field.cache_spacing, CLI::Range(0.0, 16.0), "As of hogel render", "F");
}

void add_thesis(CLI::App& app, Program& program) {
    const auto options = std::make_shared<ThesisOptions>();
    CLI::App* command = add_command<ThesisOptions>(
        app, program, "thesis", "Curves and pictures of chapter 4 of Kartch's thesis: transforms and coders", options,
        [&program](const ThesisOptions& chosen) { redraw_thesis(chosen, program.session); });
    add_session_options(command, program.session);
    add_output(command, options->output);
    add_names(command, "--scenes", options->scenes, "Scenes (pumpkin,church)");
    LightFieldOptions& light_field = options->light_field;
    add_parsed(command, "--hogels", light_field.hogels, "Hogels across and down", "WxH", typed(light_field.hogels),
               parse_counts);
    add_count(command, "--across", light_field.across, "Hogels that would fill the hologram's width");
    add_parsed(command, "--directions", light_field.directions, "Directions across and down in each hogel", "WxH",
               typed(light_field.directions), parse_counts);
    add_field_of_view(command, light_field.field_of_view);
    command->add_option("--rates", options->rates, "Pixels per bit, rising, for which the rule of a histogram is asked")
        ->type_name("N,...")
        ->delimiter(',')
        ->check(CLI::PositiveNumber.description(""))
        ->capture_default_str();
    add_names(command, "--transforms", options->transforms,
              "Wavelets, dct8-jpeg, dct8-own, hogel, ezw-haar, ezw-d6; all if none are named");
    command->add_flag("--radiance", options->radiance, "Code L instead of its square root");
    add_count(command, "--crop", options->crop, "Side of the pictures, directions");
}

void add_patterns(CLI::App& app, Program& program) {
    const auto options = std::make_shared<PatternBenchOptions>();
    CLI::App* command = add_command<PatternBenchOptions>(
        app, program, "patterns", "Time and quality of the encodings of patterns for modulators", options,
        [&program](const PatternBenchOptions& chosen) { measure_patterns(chosen, program.session); });
    add_session_options(command, program.session);
    command->add_option("--scene", options->scene, "Scene or mesh file")->type_name("SCENE")->capture_default_str();
    command->add_option("--device", options->device, "Modulator")->type_name("NAME")->capture_default_str();
    add_names(command, "--encodings", options->encodings, "Encodings; all but supervised if none are named");
    add_count(command, "--rounds", options->rounds, "Rounds; the median counts");
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

// Prints an error as one line on stderr.
int fail(ErrorCode code, std::string message) {
    std::ranges::replace(message, '\n', ' ');
    fmt::print(stderr, "hogel-bench: {}\n", message);
    return static_cast<int>(code);
}

int run(int argc, char** argv) {
    CLI::App app{"hogel-bench: measures hogel and its peers", "hogel-bench"};
    Program program;
    app.set_version_flag("--version", "hogel-bench " HOGEL_VERSION, "Print the version and exit");
    app.require_subcommand(1);
    add_render(app, program);
    add_codec(app, program);
    add_thesis(app, program);
    add_patterns(app, program);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        const std::vector<std::string> extra = app.remaining();
        if (app.get_subcommands().empty() && !extra.empty())
            throw_unknown("command", extra.front(), command_names(app));
        return fail(ErrorCode::usage, error.what());
    }
    const ThreadLimit limit(program.threads);
    program.run();
    return 0;
}

}  // namespace
}  // namespace hogel::bench

int main(int argc, char** argv) {
    using namespace hogel;
    using namespace hogel::bench;
    catch_interrupts();
    int status = 0;
    try {
        status = run(argc, argv);
    } catch (const Error& error) {
        if (interrupted_by() == 0) return fail(error.code(), error.what());
        fail(ErrorCode::cancelled, "stopped");
        return 128 + interrupted_by();
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::internal, "out of memory");
    } catch (const std::exception& error) {
        return fail(ErrorCode::internal, fmt::format("internal error: {}", error.what()));
    }
    if (std::fflush(stdout) != 0) return fail(ErrorCode::cannot_write, "cannot write to the standard output");
    return status;
}
