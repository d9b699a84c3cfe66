// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <strings.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands.h"
#include "hogel/image.h"
#include "hogel/pattern.h"
#include "hogel/pipeline.h"
#include "hogel/team.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

// Below that a picture is unlike that of the hologram.
constexpr double poor_correlation = 0.9;

struct Options {
    std::string input, output, encoding = "auto", device;
    Counts pixels{0, 0};
    double pixel_pitch = 0;
    std::size_t levels = 256;
    PatternOptions pattern;
    std::string phase_code = "hogel";
    FieldParameters field;
    bool resume = false;

    /// Whether the encoding, once it is chosen, is one of these.
    bool is_one_of(std::initializer_list<Encoding> these) const {
        return std::ranges::count(these, encodings().find(encoding).encoding) > 0;
    }
};

// A device as the table writes it, typed in small letters or capitals.
std::string device_name(const std::string& typed) {
    for (const std::string& name : modulators().names())
        if (strcasecmp(name.c_str(), typed.c_str()) == 0) return name;
    return typed;
}

Modulator modulator_of(const Options& options) {
    const bool described = options.pixels.columns > 0 || options.pixel_pitch > 0;
    if (options.device.empty() == !described)
        throw Error(ErrorCode::usage,
                    "name a modulator with --device, or describe one with --pixels and --pixel-pitch");
    if (!described) return modulators().find(device_name(options.device));
    if (options.pixels.columns == 0 || options.pixel_pitch == 0)
        throw Error(ErrorCode::usage, "--pixels and --pixel-pitch: a modulator is described by both");
    if (std::max(options.pixels.columns, options.pixels.rows) > 65536)
        throw Error(ErrorCode::usage, "--pixels: at most 65536 were expected on a side");
    if (options.levels < 2 || options.levels > 256) throw Error(ErrorCode::usage, "--levels: 2 to 256 were expected");
    return {"", options.pixels.columns, options.pixels.rows, options.pixel_pitch,
            static_cast<unsigned>(options.levels)};
}

// The share of light that a pattern uses, and its direction.
// @param per_cycle  wavelength over pixel pitch
Result result_of(const Pattern& pattern, double wavelength, double per_cycle, Encoding encoding) {
    Result result{{"wavelength_m", wavelength}, {"efficiency", pattern.efficiency}, {"power", pattern.power}};
    if (is_phase_only(encoding)) {
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

// The patterns by the encoding that was asked for, or by the one that suits the fields of all wavelengths.
SuitablePatterns encode(const Options& options, const Fields& fields, PatternOptions& pattern,
                        const Progress& progress) {
    if (options.encoding == "auto") return encode_suitably(fields, pattern, progress);
    pattern.encoding = encodings().find(options.encoding).encoding;
    return SuitablePatterns{pattern.encoding, encode_patterns(fields, pattern, progress)};
}

constexpr double example_focal_length = 0.2;

// The aperture in words: in cycles, as an angle, and in millimetres behind a lens.
std::string in_words(const Aperture& aperture, double per_cycle) {
    std::string middle;
    if (aperture.x != 0 || aperture.y != 0)
        middle = fmt::format(" around {:.4f} to the right and {:.4f} up", aperture.x, 0.0 - aperture.y);
    return fmt::format("radius {:.4f} cycles a pixel{}, {:.2f} mm at a lens of 200 mm", aperture.radius, middle,
                       aperture.radius * per_cycle * example_focal_length / 1e-3);
}

// The widest field of view, radians, whose light an aperture of a quarter of the band lets through; double phases show
// that well.
double fine_view(double per_cycle) { return 2 * std::asin(std::min(1.0, per_cycle / 8)); }

// What is said of one pattern, and stored with it.
void report(const Pattern& pattern, double wavelength, double per_cycle, Encoding encoding, const Session& session,
            Metadata& metadata) {
    const std::string name = format_length(wavelength);
    const bool phases = is_phase_only(encoding);
    std::string line = fmt::format("{}: efficiency {:.2f} %", name, 100 * pattern.efficiency);
    metadata.emplace_back("efficiency at " + name, fmt::format("{:.6f}", pattern.efficiency));
    if (phases) {
        line += fmt::format(", of its light field {:.2f} %, correlation {:.4f}", 100 * pattern.light_field_efficiency,
                            pattern.correlation);
        metadata.emplace_back("correlation at " + name, fmt::format("{:.6f}", pattern.correlation));
    }
    if (pattern.iterations > 0) {
        line += fmt::format(" after {} iterations", pattern.iterations);
        metadata.emplace_back("iterations at " + name, fmt::format("{}", pattern.iterations));
    }
    if (pattern.reference_angle != 0) {
        const double degrees = pattern.reference_angle * 180 / std::numbers::pi;
        line += fmt::format(", the hologram's order at {:.3f} degrees", -degrees);
        metadata.emplace_back("reference angle at " + name, fmt::format("{:.6f}deg", degrees));
    }
    session.say(line);
    metadata.emplace_back("power at " + name, fmt::format("{:.6g}", pattern.power));
    const std::string aperture = in_words(pattern.aperture, per_cycle);
    session.say(fmt::format("{}: aperture: {}", name, aperture));
    metadata.emplace_back("aperture at " + name, aperture);
    if (phases && pattern.correlation < poor_correlation)
        session.say(
            fmt::format("{}: warning: what this aperture lets through differs from the hologram (correlation "
                        "below {}); light within {:.2g} degrees would do, as of hogel hologram --method olas "
                        "--phase fixed --fov {:.2g}deg, by --encoding double-phase",
                        name, poor_correlation, fine_view(per_cycle) * 90 / std::numbers::pi,
                        fine_view(per_cycle) * 180 / std::numbers::pi));
}

// The ratio of the powers that show the colours of the hologram, that of the second wavelength being 1.
std::string powers_of(const std::vector<Pattern>& patterns) {
    std::vector<std::string> ratio;
    for (const Pattern& pattern : patterns) ratio.push_back(fmt::format("{:.3g}", pattern.power / patterns[1].power));
    return fmt::format("the colours of the hologram by light on the modulator of the powers {}",
                       fmt::join(ratio, " : "));
}

// The texts by which the file describes its field.
Metadata pattern_entries(const Fields& fields, Encoding encoding, const PatternOptions& options) {
    using Values = ExternalField::Values;
    ExternalField what{.pitch_x = options.modulator.pitch, .pitch_y = options.modulator.pitch};
    what.values = is_phase_only(encoding) ? Values::phase : Values::amplitude;
    what.phase_code = options.phase_code;
    std::vector<double> wavelengths;
    for (const auto& field : fields) wavelengths.push_back(field->grid().wavelength);
    return field_entries(what, wavelengths);
}

std::string name_of(Encoding encoding) {
    for (const EncodingInfo& info : encodings().rows())
        if (info.encoding == encoding) return info.name;
    return "";
}

int slm(Options& options, const Session& session) {
    PatternOptions pattern_options = options.pattern;
    pattern_options.modulator = modulator_of(options);
    require_raw_pixels_name(options.output);
    require_writable(options.output, {&options.input, 1});
    Kept kept(session, options.resume, options.output, options.resume ? describe_input(options.input) : "");
    const Fields fields = open_and_reconstruct(session, options.input, options.field);
    const std::size_t colours = fields.size();
    if (colours != 1 && colours != 3)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: has {} wavelengths; a pattern takes one or three", options.input, colours));

    pattern_options.phase_code = parse_phase_code(options.phase_code);
    const Modulator& modulator = pattern_options.modulator;
    Array<std::uint8_t, 3> levels({modulator.height, modulator.width, colours});
    Stage stage(session, "pattern");
    const SuitablePatterns encoded = encode(options, fields, pattern_options, stage.progress());
    const std::string encoding = name_of(encoded.encoding);
    if (options.encoding == "auto") session.detail(fmt::format("encoding {} suits the field", encoding));
    options.encoding = encoding;
    if (!options.device.empty()) options.device = device_name(options.device);
    Metadata metadata = run_metadata(session);
    ResultList patterns;
    for (std::size_t c = 0; c < colours; ++c) {
        const Pattern& pattern = encoded.patterns[c];
        for (std::size_t i = 0; i < pattern.levels.size(); ++i)
            levels.data()[i * colours + c] = pattern.levels.data()[i];
        const double wavelength = fields[c]->grid().wavelength, per_cycle = wavelength / modulator.pitch;
        report(pattern, wavelength, per_cycle, encoded.encoding, session, metadata);
        patterns.push_back(result_of(pattern, wavelength, per_cycle, encoded.encoding));
    }
    if (colours == 3) session.say(powers_of(encoded.patterns));
    for (auto& entry : pattern_entries(fields, encoded.encoding, pattern_options)) metadata.push_back(std::move(entry));
    if (!is_first_process()) return 0;
    write_raw_pixels(options.output, levels, with_history(metadata, to_metadata(fields.front()->provenance())));
    kept.complete();
    session.say(fmt::format("{}: {}x{} pixels of {}", options.output, modulator.width, modulator.height,
                            format_length(modulator.pitch)));
    report_file(session, options.output,
                {{"width", modulator.width},
                 {"height", modulator.height},
                 {"pixel_pitch_m", modulator.pitch},
                 {"levels", modulator.levels},
                 {"encoding", encoding},
                 {"patterns", patterns}});
    return 0;
}

void add_pattern_options(Command& command, Options& options) {
    std::vector<std::string> names = encodings().names();
    names.insert(names.begin(), "auto");
    command.group("Pattern");
    command.choice(
        "--encoding", options.encoding, names, "NAME",
        "auto: phase, double-phase or gradient: the first that correlates with the field by 0.998, or the best\n"
        "phase: the field's phase alone: for fields of even modulus, such as plane and spherical waves\n"
        "double-phase: the modulus as the difference of two phases: for any field, dark, without iteration\n"
        "gerchberg-saxton: phases iterated to show the spectra of hogels: for random phases, not smooth ones\n"
        "gradient: phases that show the field behind its aperture, which must be of that size: for any field\n"
        "intensity: |F + R|² with a reference beam R\n"
        "bipolar: 2 Re(F R*), raised to be positive\n"
        "burckhardt, lee: three or four real components, in columns by turns\n"
        "binary: where Re(F R*) is positive");
    command
        .angle("--reference", options.pattern.reference_angle,
               "Angle of the reference beam; 0: between the least and the most that will do")
        .acts_if([&options] {
            return options.is_one_of({Encoding::intensity, Encoding::bipolar, Encoding::binary});
        });
    command.number("--clip", options.pattern.clip, "0..1",
                   "Share of the samples whose modulus may be cut to the largest");
    command.count("--window", options.pattern.window, "Gerchberg-Saxton: pixels of a hogel's side").acts_if([&options] {
        return options.is_one_of({Encoding::gerchberg_saxton});
    });
    command
        .count("--iterations", options.pattern.iterations,
               "Gerchberg-Saxton: how many steps (default: 40); gradient: at most (default: 200), until the\n"
               "correlation with the field no longer gains")
        .no_default()
        .acts_if([&options] {
            return options.is_one_of({Encoding::gerchberg_saxton, Encoding::gradient});
        });
}

void add_modulator_options(Command& command, Options& options) {
    std::string devices = "Modulator:";
    for (const Modulator& modulator : modulators().rows())
        devices += fmt::format("\n{}: {}x{} at {}, {} levels", modulator.name, modulator.width, modulator.height,
                               format_length(modulator.pitch), modulator.levels);
    command.group("Modulator");
    const Parameter& device = command.text("--device", options.device, "NAME", devices)
                                  .sets_parameter("pixel_pitch")
                                  .knows(modulators().names());
    command.counts("--pixels", options.pixels, "Any other: pixels across and down")
        .no_default()
        .excludes(device)
        .acts_if([&options] { return options.device.empty(); });
    command.positive_length("--pixel-pitch", options.pixel_pitch, "Distance of its pixels")
        .no_default()
        .excludes(device)
        .acts_if([&options] { return options.device.empty(); });
    command.count("--levels", options.levels, "Levels of its pixels").excludes(device).acts_if([&options] {
        return options.device.empty() && !options.is_one_of({Encoding::binary});
    });
    std::string codes = "Levels of phases as this program writes them:";
    for (const PhaseCodeInfo& code : phase_codes().rows()) codes += fmt::format("\n{}: {}", code.name, code.text);
    command
        .text("--phase-code", options.phase_code, "CODE",
              codes + "\nany other: range=ANGLE,offset=ANGLE,invert, in deg, rad or pi (2pi)")
        .acts_if([&options] { return is_phase_only(encodings().find(options.encoding).encoding); });
}

}  // namespace

void add_slm(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel hologram pumpkin -o f.h5 --hogels 60x33 --size 12.288mm --pitch 6.4um \\\n"
        "    --fov 2.5deg --wavelength 532nm\n"
        "  hogel slm f.h5 -o pattern.png --device leto --encoding double-phase");
    command.basics({"device", "pixels", "pixel-pitch", "levels", "encoding", "reference", "window", "phase-code",
                    "pitch", "wavelength"});
    command.positional("input", options->input, "F.h5|F.npy|P.png", "Hologram, or another program's field");
    command.text("-o,--output", options->output, "FILE", "Pattern to write: .png or .bmp, 8 bits as they are")
        .required()
        .never_acts();
    add_resume_flag(command, options->resume);
    add_pattern_options(command, *options);
    add_modulator_options(command, *options);
    options->field.code_option = "--input-phase-code";
    options->field.declare(command);
    options->field.declare_reconstruction(command);
    command.add_like_option();
    command.work([options, &session] { return slm(*options, session); });
}

}  // namespace hogel::cli
