// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands.h"
#include "hogel/communicator.h"
#include "hogel/files.h"
#include "hogel/pattern.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "hogel/units.h"
#include "inputs.h"
#include "movie.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

// Correlation below which a picture differs visibly from that of the hologram.
constexpr double poor_correlation = 0.9;

struct Options {
    std::string input, output;
    PatternParameters pattern;
    LightFieldParameters render;
    HologramParameters hologram;
    FieldParameters field;
    bool resume = false;
};

// Fields and their patterns.
struct Encoded {
    Fields fields;
    SuitablePatterns patterns;
};

// Returns whether a pattern has measures that compare its phases with a field.
bool compares_with_field(Encoding encoding) { return is_phase_only(encoding) && encoding != Encoding::supervised; }

// Returns the efficiency and the aperture of a pattern.
// @param per_cycle  wavelength over pixel pitch
Result result_of(const Pattern& pattern, double wavelength, double per_cycle, Encoding encoding) {
    Result result{{"wavelength_m", wavelength}, {"efficiency", pattern.efficiency}, {"power", pattern.power}};
    if (compares_with_field(encoding)) {
        result.emplace_back("light_field_efficiency", pattern.light_field_efficiency);
        result.emplace_back("correlation", pattern.correlation);
    }
    result.emplace_back("aperture_cycles", pattern.aperture.radius);
    result.emplace_back("aperture_x_cycles", pattern.aperture.x);
    result.emplace_back("aperture_y_cycles", pattern.aperture.y);
    result.emplace_back("aperture_per_focal_length", pattern.aperture.radius * per_cycle);
    if (pattern.iterations > 0) result.emplace_back("iterations", pattern.iterations);
    if (pattern.reference_angle != 0)
        result.emplace_back("reference_angle_deg", pattern.reference_angle * 180 / std::numbers::pi);
    return result;
}

// Returns the widest field of view, radians, that passes an aperture of a quarter of the band. Double-phase encoding
// shows it well.
double max_field_of_view(double per_cycle) { return 2 * std::asin(std::min(1.0, per_cycle / 8)); }

void report(const Pattern& pattern, double wavelength, double per_cycle, Encoding encoding, const Session& session) {
    const std::string name = format_length(wavelength);
    const bool phases = compares_with_field(encoding);
    std::string line = fmt::format("{}: efficiency {:.2f} %", name, 100 * pattern.efficiency);
    if (phases)
        line += fmt::format(", of its light field {:.2f} %, correlation {:.4f}", 100 * pattern.light_field_efficiency,
                            pattern.correlation);
    if (pattern.iterations > 0) line += fmt::format(" after {} iterations", pattern.iterations);
    if (pattern.reference_angle != 0)
        line +=
            fmt::format(", the hologram's order at {:.3f} degrees", -pattern.reference_angle * 180 / std::numbers::pi);
    session.say(line);
    session.say(fmt::format("{}: aperture: {}", name, describe(pattern.aperture, per_cycle)));
    if (phases && pattern.correlation < poor_correlation)
        session.say(
            fmt::format("{}: warning: the light through this aperture differs from the hologram (correlation "
                        "below {}); limit the light to {:.2g} degrees, as with hogel hologram --method olas "
                        "--phase fixed --fov {:.2g}deg, and use --encoding double-phase",
                        name, poor_correlation, max_field_of_view(per_cycle) * 90 / std::numbers::pi,
                        max_field_of_view(per_cycle) * 180 / std::numbers::pi));
}

// Returns the ratio of the illumination powers that reproduce the colours of the hologram, relative to the second
// wavelength.
std::string powers_of(std::span<const Pattern> patterns) {
    std::vector<std::string> ratio;
    for (const Pattern& pattern : patterns) ratio.push_back(fmt::format("{:.3g}", pattern.power / patterns[1].power));
    return fmt::format("illumination powers that reproduce the colours of the hologram: {}", fmt::join(ratio, " : "));
}

void report(const PupilQuality& quality, double wavelength, const Session& session) {
    session.say(
        fmt::format("{}: photographs through pupils, against those by rays: PSNR {:.2f} dB ({:.2f} in the "
                    "middle, {:.2f} outside), SSIM {:.3f}, speckle contrast {:.2f}",
                    format_length(wavelength), quality.psnr, quality.psnr_middle, quality.psnr_outside, quality.ssim,
                    quality.contrast));
}

Result result_of(const PupilQuality& quality) {
    return {{"psnr_db", quality.psnr},
            {"lowest_psnr_db", quality.lowest_psnr},
            {"psnr_middle_db", quality.psnr_middle},
            {"psnr_outside_db", quality.psnr_outside},
            {"ssim", quality.ssim},
            {"speckle_contrast", quality.contrast},
            {"efficiency", quality.efficiency}};
}

// Throws an error for a number of wavelengths that a pattern, or the file of it, does not take.
void require_colours(const Options& options, const Fields& fields) {
    if (fields.size() != 1 && fields.size() != 3)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: has {} wavelengths; a pattern takes one or three", options.input, fields.size()));
    require_levels_name(options.output, options.pattern.modulator().levels - 1, fields.size());
}

Fields at_modulator(const Options& options, const Fields& fields, const Session& session) {
    Stage stage(session, "propagation");
    return options.pattern.at_modulator(fields, stage.progress());
}

Encoded encode_hologram(Options& options, const Session& session) {
    if (options.pattern.encoding == "supervised")
        throw Error(ErrorCode::usage, "encoding",
                    fmt::format("supervised needs a light field or a scene, but {} is a hologram; give slm the light "
                                "field or scene itself, or use gradient",
                                options.input));
    options.field.pitch = options.hologram.pitch_given ? options.hologram.pitch : 0;
    options.field.wavelengths = options.hologram.wavelengths;
    Encoded encoded{open_and_reconstruct(session, options.input, options.field), {}};
    options.hologram.resolve(options.field);
    require_colours(options, encoded.fields);
    encoded.fields = at_modulator(options, encoded.fields, session);
    Stage stage(session, "pattern");
    encoded.patterns = options.pattern.encode(encoded.fields, stage.progress());
    return encoded;
}

// Selects the method of the hologram where no option does: for a picture without speckle, unless the encoding shows
// random phases or the light field has no depth.
void select_method(HologramParameters& hologram, bool is_supervised, bool has_depth, const Session& session) {
    if (is_supervised || hologram.method_given) return;
    if (!has_depth) {
        session.say(
            "the light field has no depth: its picture has speckle; hogel render or import with --depth stores depth");
        return;
    }
    hologram.method = "olas";
    if (hologram.phase.empty()) hologram.phase = "fixed";
}

// Makes holograms with samples of the modulator's pitch, and encodes them.
Encoded encode_light_field(Options& options, InputKind kind, const Session& session) {
    const bool is_supervised = options.pattern.encoding == "supervised";
    options.hologram.fit(options.pattern.modulator(), options.render, !is_supervised);
    LightField light_field = open_or_render(session, options.input, options.render);
    if (kind == InputKind::light_field)
        light_field = fitted(session, light_field, options.hologram, options.pattern.modulator(), !is_supervised);
    light_field = with_common_directions(light_field);
    select_method(options.hologram, is_supervised, light_field.has_depth(), session);
    const HologramRequest request =
        options.hologram.request(light_field.grids(), session.seed, options.pattern.looks());
    check_holograms(light_field.grids(), request, kind == InputKind::scene);
    light_field = prepare_for_reading(session, light_field, 2 * request.channels.size(), light_field.has_depth());
    if (const std::string warning = warning_about(light_field, request); !warning.empty()) session.say(warning);
    options.hologram.resolve(request, light_field.grid());
    Encoded encoded{make_holograms(light_field, request), {}};
    require_colours(options, encoded.fields);
    encoded.fields = at_modulator(options, encoded.fields, session);
    Stage stage(session, "pattern");
    encoded.patterns = options.pattern.encode(encoded.fields, light_field, request, stage.progress());
    return encoded;
}

// Reports the patterns of all wavelengths, and returns their results.
ResultList report_patterns(const Encoded& made, const Modulator& modulator, const Session& session) {
    const SuitablePatterns& encoded = made.patterns;
    const std::size_t colours = made.fields.size();
    ResultList patterns;
    for (std::size_t c = 0; c < colours; ++c) {
        const Pattern& pattern = encoded.patterns[c];
        const double wavelength = made.fields[c]->grid().wavelength, per_cycle = wavelength / modulator.pitch;
        report(pattern, wavelength, per_cycle, encoded.encoding, session);
        Result result = result_of(pattern, wavelength, per_cycle, encoded.encoding);
        if (!encoded.quality.empty()) {
            report(encoded.quality[c], wavelength, session);
            result.emplace_back("photographs", result_of(encoded.quality[c]));
        }
        patterns.push_back(std::move(result));
    }
    if (colours == 3) session.say(powers_of(std::span(encoded.patterns).first(colours)));
    return patterns;
}

// Names a command that photographs a pattern made from a scene or light field on a bench. Its file names the aperture.
void suggest_a_photograph(const Options& options, const Session& session) {
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (extension != ".png" && extension != ".tif") return;
    const double distance = options.pattern.distance;
    session.say(fmt::format("what it shows behind its aperture: hogel photo {} -o look.png --focal 200mm{}",
                            options.output, distance == 0 ? "" : " --focus=" + lengths_text({-distance})));
}

// Writes the patterns, one file for each that is shown in turn.
void write_files(const Options& options, const SuitablePatterns& patterns, std::size_t colours,
                 const Metadata& metadata) {
    const std::span<const Pattern> all = patterns.patterns;
    const std::size_t frames = all.size() / colours;
    for (std::size_t frame = 0; frame < frames; ++frame)
        write_levels(frames == 1 ? std::filesystem::path(options.output) : numbered(options.output, frame),
                     joined_levels(all.subspan(frame * colours, colours)), all[0].max_level, metadata);
}

int slm(Options& options, const Session& session) {
    const Modulator modulator = options.pattern.options().modulator;
    require_levels_name(options.output, modulator.levels - 1);
    const std::size_t frames = options.pattern.looks();
    if (frames > 1 && !is_numbered(options.output))
        throw Error(ErrorCode::usage, "output",
                    fmt::format("{}: expected name####.png for {} patterns", options.output, frames));
    require_writable(options.output, {&options.input, 1});
    ResumableOutput resumable(session, options.resume, options.output,
                              options.resume ? describe_input(options.input) : "");
    if (session.command->given("--pitch") && !session.command->given("--like"))
        options.field.require_described(options.input);
    const InputKind kind = options.field.is_external(options.input) ? InputKind::hologram : input_kind(options.input);
    const bool is_automatic = options.pattern.encoding == "auto";
    Encoded made =
        kind == InputKind::hologram ? encode_hologram(options, session) : encode_light_field(options, kind, session);
    const Fields& fields = made.fields;
    SuitablePatterns& encoded = made.patterns;
    const std::size_t colours = fields.size();
    options.pattern.resolve(encoded.encoding);
    const std::string& encoding = options.pattern.encoding;
    if (is_automatic) session.detail(fmt::format("encoding {} suits the field", encoding));
    Metadata metadata = run_metadata(session);
    for (auto& entry : options.pattern.metadata(encoded, fields)) metadata.push_back(std::move(entry));
    for (const std::string& note : options.pattern.notes(fields)) session.say(note);
    const ResultList patterns = report_patterns(made, modulator, session);
    if (!is_root_rank()) return 0;
    std::vector<Array<std::uint16_t, 2>> sent = options.pattern.panel_levels(encoded, fields);
    for (std::size_t i = 0; i < sent.size(); ++i) encoded.patterns[i].levels = std::move(sent[i]);
    write_files(options, encoded, colours, with_history(metadata, to_metadata(fields.front()->provenance())));
    resumable.complete();
    session.say(fmt::format("{}: {}{}x{} pixels of {}", options.output,
                            frames == 1 ? "" : fmt::format("{} patterns of ", frames), modulator.width,
                            modulator.height, format_length(modulator.pitch)));
    if (kind != InputKind::hologram && frames == 1) suggest_a_photograph(options, session);
    report_file(session, options.output,
                {{"width", modulator.width},
                 {"height", modulator.height},
                 {"pixel_pitch_m", modulator.pitch},
                 {"levels", modulator.levels},
                 {"encoding", encoding},
                 {"patterns", patterns}});
    return 0;
}

}  // namespace

void add_slm(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel slm photo.jpg -o pattern.png --device pluto --wavelength 520nm --distance 200mm\n"
        "  hogel hologram pumpkin -o f.h5 --hogels 60x33 --size 12.288mm --pitch 6.4um \\\n"
        "    --fov 2.5deg --wavelength 532nm\n"
        "  hogel slm f.h5 -o pattern.png --device leto --encoding double-phase\n"
        "  hogel slm lf.h5 -o turn####.png --device pluto --wavelength 532nm --encoding supervised --frames 8");
    command.basics({"device", "pixels", "pixel-pitch", "levels", "encoding", "reference", "window", "phase-code",
                    "pitch", "wavelength"});
    command.positional("input", options->input, "F.h5|X.h5|SCENE",
                       "Hologram, light field, picture, mesh file, built-in scene, or another program's field");
    command
        .text("-o,--output", options->output, "FILE",
              "Pattern to write, levels without colour management:\n"
              ".png, .bmp: 8 bits; .png of 16 bits for more than 256 levels, with the numbers 0 to levels - 1\n"
              ".npy: array of NumPy, [y][x] or [wavelength][y][x]\n"
              ".h5: as slmsuite's SLM.save_phase() writes it, of one wavelength")
        .required()
        .never_acts();
    add_resume_flag(command, options->resume);
    options->pattern.declare(command);
    options->hologram.declare(command);
    options->render.declare(command);
    options->field.code_option = "--input-phase-code";
    options->field.declare(command, false);
    options->field.declare_reconstruction(command);
    command.add_like_option();
    command.work([options, &session] { return slm(*options, session); });
}

}  // namespace hogel::cli
