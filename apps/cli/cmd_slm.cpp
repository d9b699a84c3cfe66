// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands.h"
#include "hogel/communicator.h"
#include "hogel/image.h"
#include "hogel/pattern.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

// Correlation below which a picture differs visibly from that of the hologram.
constexpr double poor_correlation = 0.9;

struct Options {
    std::string input, output;
    PatternParameters pattern;
    FieldParameters field;
    bool resume = false;
};

// Returns the efficiency and the aperture of a pattern.
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

// Returns the widest field of view, radians, that passes an aperture of a quarter of the band. Double-phase encoding
// shows it well.
double max_field_of_view(double per_cycle) { return 2 * std::asin(std::min(1.0, per_cycle / 8)); }

void report(const Pattern& pattern, double wavelength, double per_cycle, Encoding encoding, const Session& session) {
    const std::string name = format_length(wavelength);
    const bool phases = is_phase_only(encoding);
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
std::string powers_of(const std::vector<Pattern>& patterns) {
    std::vector<std::string> ratio;
    for (const Pattern& pattern : patterns) ratio.push_back(fmt::format("{:.3g}", pattern.power / patterns[1].power));
    return fmt::format("illumination powers that reproduce the colours of the hologram: {}", fmt::join(ratio, " : "));
}

int slm(Options& options, const Session& session) {
    const Modulator modulator = options.pattern.options().modulator;
    require_raw_pixels_name(options.output, modulator.levels);
    require_writable(options.output, {&options.input, 1});
    ResumableOutput resumable(session, options.resume, options.output,
                              options.resume ? describe_input(options.input) : "");
    const Fields fields = open_and_reconstruct(session, options.input, options.field);
    const std::size_t colours = fields.size();
    if (colours != 1 && colours != 3)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: has {} wavelengths; a pattern takes one or three", options.input, colours));

    Stage stage(session, "pattern");
    const SuitablePatterns encoded = options.pattern.encode(fields, stage.progress());
    const bool is_automatic = options.pattern.encoding == "auto";
    options.pattern.resolve(encoded.encoding);
    const std::string& encoding = options.pattern.encoding;
    if (is_automatic) session.detail(fmt::format("encoding {} suits the field", encoding));
    Metadata metadata = run_metadata(session);
    for (auto& entry : options.pattern.metadata(encoded, fields)) metadata.push_back(std::move(entry));
    for (const std::string& note : options.pattern.notes(fields)) session.say(note);
    ResultList patterns;
    for (std::size_t c = 0; c < colours; ++c) {
        const Pattern& pattern = encoded.patterns[c];
        const double wavelength = fields[c]->grid().wavelength, per_cycle = wavelength / modulator.pitch;
        report(pattern, wavelength, per_cycle, encoded.encoding, session);
        patterns.push_back(result_of(pattern, wavelength, per_cycle, encoded.encoding));
    }
    if (colours == 3) session.say(powers_of(encoded.patterns));
    if (!is_root_rank()) return 0;
    write_patterns(options.output, encoded.patterns, with_history(metadata, to_metadata(fields.front()->provenance())));
    resumable.complete();
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
    command
        .text("-o,--output", options->output, "FILE",
              "Pattern to write, levels without colour management: .png or .bmp of 8 bits; .png of 16 bits for more "
              "than 256 levels, with the numbers 0 to levels - 1")
        .required()
        .never_acts();
    add_resume_flag(command, options->resume);
    options->pattern.declare(command);
    options->field.code_option = "--input-phase-code";
    options->field.declare(command);
    options->field.declare_reconstruction(command);
    command.add_like_option();
    command.work([options, &session] { return slm(*options, session); });
}

}  // namespace hogel::cli
