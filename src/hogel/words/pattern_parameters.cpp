// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/pattern.h"
#include "hogel/requests.h"
#include "hogel/units.h"

namespace hogel {
namespace {

constexpr const char* automatic_encoding = "auto";
constexpr std::size_t max_frames = 64;

std::string encoding_name(Encoding encoding) {
    for (const EncodingInfo& info : encodings().rows())
        if (info.encoding == encoding) return info.name;
    return "";
}

// Returns whether the selected encoding is one of these.
bool is_one_of(const std::string& encoding, std::initializer_list<Encoding> these) {
    return std::ranges::count(these, encodings().find(encoding).encoding) > 0;
}

Metadata pattern_entries(const Pattern& pattern, double wavelength, const Modulator& modulator, Encoding encoding) {
    const std::string name = format_length(wavelength);
    Metadata entries{{"efficiency at " + name, fmt::format("{:.6f}", pattern.efficiency)}};
    if (is_phase_only(encoding) && encoding != Encoding::supervised)
        entries.emplace_back("correlation at " + name, fmt::format("{:.6f}", pattern.correlation));
    if (pattern.iterations > 0) entries.emplace_back("iterations at " + name, fmt::format("{}", pattern.iterations));
    if (pattern.reference_angle != 0)
        entries.emplace_back("reference angle at " + name,
                             fmt::format("{:.6f}deg", pattern.reference_angle * 180 / std::numbers::pi));
    entries.emplace_back("power at " + name, fmt::format("{:.6g}", pattern.power));
    entries.emplace_back("aperture at " + name, describe(pattern.aperture, wavelength / modulator.pitch));
    return entries;
}

void declare_pattern(Parameters& parameters, PatternParameters& asked) {
    std::vector<std::string> names = encodings().names();
    names.insert(names.begin(), automatic_encoding);
    parameters.group("Pattern");
    parameters.choice(
        "--encoding", asked.encoding, names, "NAME",
        "auto: the first of phase, double-phase and gradient with a correlation of 0.998, or else the best\n"
        "phase: only the field's phase: for fields of uniform modulus, such as plane and spherical waves\n"
        "double-phase: the modulus as the difference of two phases: for any field, dark, without iteration\n"
        "gerchberg-saxton: phases iterated to show the spectra of hogels: for random phases, not smooth ones\n"
        "gradient: phases optimised to show the field behind an aperture of its size: for any field\n"
        "supervised: phases optimised by photographs through random pupils: for scenes and light fields; slow\n"
        "intensity: |F + R|² with a reference beam R\n"
        "bipolar: 2 Re(F R*), raised to be positive\n"
        "burckhardt, lee: three or four real components, in alternating columns\n"
        "binary: 1 where Re(F R*) is positive");
    parameters
        .angle("--reference", asked.pattern.reference_angle,
               "Angle of the reference beam; 0: midway between the smallest and the largest possible")
        .acts_if([&asked] {
            return is_one_of(asked.encoding, {Encoding::intensity, Encoding::bipolar, Encoding::binary});
        });
    parameters.number("--clip", asked.pattern.clip, "0..1", "Fraction of the samples with clipped modulus");
    parameters.count("--window", asked.pattern.window, "Gerchberg-Saxton: pixels along a side of a hogel")
        .acts_if([&asked] { return is_one_of(asked.encoding, {Encoding::gerchberg_saxton}); });
    parameters
        .count("--iterations", asked.pattern.iterations,
               "Number of steps of Gerchberg-Saxton (default: 40) and supervised (default: 300); gradient: maximum "
               "number (default: 200), until the correlation with the field stops rising")
        .no_default()
        .acts_if([&asked] {
            return is_one_of(asked.encoding, {Encoding::gerchberg_saxton, Encoding::gradient, Encoding::supervised});
        });
    parameters
        .length("--distance", asked.distance,
                "Distance of the hologram plane in front of the modulator, where the picture is in focus")
        .acts_if([&asked] { return !is_one_of(asked.encoding, {Encoding::supervised}); });
    parameters
        .count("--frames", asked.frames,
               "Supervised: number of patterns that are shown in turn, with less speckle together; the output is "
               "name####.png")
        .acts_if([&asked] { return is_one_of(asked.encoding, {Encoding::supervised}); });
}

std::string summary_of(const Modulator& modulator) {
    if (!modulator.fault.empty()) return "has a fault in its profile";
    return fmt::format("{}x{} at {}, {} levels{}", modulator.width, modulator.height, format_length(modulator.pitch),
                       modulator.levels, modulator.verified ? "" : " (not verified)");
}

void declare_modulator(Parameters& parameters, PatternParameters& asked) {
    std::string devices = "Modulator, as in its profile:";
    for (const Modulator& modulator : modulators().rows())
        devices += fmt::format("\n{}: {}", modulator.name, summary_of(modulator));
    parameters.group("Modulator");
    const Parameter& device = parameters.text("--device", asked.device, "NAME", devices)
                                  .sets_parameter("pixel_pitch")
                                  .knows(modulator_names());
    const auto is_described = [&asked] { return asked.device.empty(); };
    parameters.counts("--pixels", asked.pixels, "Another modulator: pixels across and down")
        .no_default()
        .excludes(device)
        .acts_if(is_described);
    parameters.positive_length("--pixel-pitch", asked.pixel_pitch, "Another modulator: pixel pitch")
        .no_default()
        .excludes(device)
        .acts_if(is_described);
    parameters.count("--levels", asked.levels, "Another modulator: levels of a pixel, up to 65536")
        .excludes(device)
        .acts_if([&asked] { return asked.device.empty() && !is_one_of(asked.encoding, {Encoding::binary}); });
    std::string codes = "Encoding of phases as levels, as other programs use it:";
    for (const PhaseCodeInfo& code : phase_codes().rows()) codes += fmt::format("\n{}: {}", code.name, code.text);
    parameters
        .text("--phase-code", asked.phase_code, "CODE",
              codes + "\nany other: range=ANGLE,offset=ANGLE,invert, in deg, rad or pi (2pi)")
        .default_text("of the device, or hogel")
        .acts_if([&asked] { return is_phase_only(encodings().find(asked.encoding).encoding); });
}

void declare_panel(Parameters& parameters, PatternParameters& asked) {
    const auto has_phases = [&asked] { return is_phase_only(encodings().find(asked.encoding).encoding); };
    parameters.group("Panel");
    parameters
        .text("--lut", asked.lut, "FILE",
              "Level table: a line for each level, with the level to send, or with its index and that level")
        .default_text("of the device");
    parameters
        .text("--correction", asked.correction, "PICTURE",
              "Wavefront correction: a picture of the modulator's pixels, whose levels are added to those of phases")
        .default_text("of the device")
        .acts_if(has_phases);
    parameters
        .choice("--flip", asked.flip, {"none", "horizontal", "vertical", "both"}, "none|horizontal|vertical|both",
                "Send columns (horizontal), rows (vertical) or both in reverse order")
        .default_text("of the device, or none");
    parameters.length("--lens", asked.lens, "Add a lens of this focal length to the phases; negative: a diverging lens")
        .no_default()
        .acts_if([&asked, has_phases] { return has_phases() && asked.lens != 0; });
    parameters
        .text("--blaze", asked.blaze, "FX,FY",
              "Add a blazed grating to the phases: cycles a pixel to the right and upwards, as --order of hogel photo")
        .no_default()
        .acts_if(has_phases);
}

// Returns the two frequencies of a grating.
std::pair<double, double> parse_blaze(const std::string& text) {
    if (text.empty()) return {0, 0};
    const std::size_t comma = text.find(',');
    const auto x = parse_number(text.substr(0, comma));
    const auto y = comma == std::string::npos ? std::nullopt : parse_number(text.substr(comma + 1));
    if (!x || !y || !(std::abs(*x) <= 0.5 && std::abs(*y) <= 0.5))
        throw Error(ErrorCode::usage, "blaze",
                    fmt::format("'{}' is not FX,FY, from -0.5 to 0.5 cycles a pixel, e.g. 0.25,0", text));
    return {*x, *y};
}

}  // namespace

Modulator PatternParameters::modulator() const {
    const bool is_described = pixels.columns > 0 || pixel_pitch > 0;
    if (device.empty() == !is_described)
        throw Error(ErrorCode::usage, "device, pixels, pixel_pitch",
                    "name a modulator by device, or describe one by pixels and pixel pitch");
    if (!is_described) return find_modulator(device);
    if (pixels.columns == 0 || pixel_pitch == 0)
        throw Error(ErrorCode::usage, "pixels, pixel_pitch", "give both to describe a modulator");
    if (std::max(pixels.columns, pixels.rows) > max_modulator_side)
        throw Error(ErrorCode::usage, "pixels", fmt::format("expected at most {} on a side", max_modulator_side));
    if (levels < 2 || levels > max_modulator_levels)
        throw Error(ErrorCode::usage, "levels", fmt::format("expected 2 to {}", max_modulator_levels));
    return {"", pixels.columns, pixels.rows, pixel_pitch, static_cast<unsigned>(levels)};
}

std::string PatternParameters::code() const {
    if (!phase_code.empty()) return phase_code;
    const std::string of_device = modulator().phase_code;
    return of_device.empty() ? phase_code_text({}) : of_device;
}

PanelOptions PatternParameters::panel() const {
    const Modulator device_used = modulator();
    const auto chosen = [](const std::string& own, const std::string& devices) { return own.empty() ? devices : own; };
    const std::string table = chosen(lut, device_used.lut), added = chosen(correction, device_used.correction),
                      order = chosen(flip, device_used.flip);
    PanelOptions options{.lens = lens};
    // Amplitudes leave out the correction of a profile.
    const bool is_phases = encoding == automatic_encoding || is_phase_only(encodings().find(encoding).encoding);
    if (!table.empty()) options.levels.table = read_level_table(table);
    if (!added.empty() && (!correction.empty() || is_phases)) {
        options.correction = read_raw_pixels(added).values;
        options.levels.correction = added;
    }
    options.levels.flipped_x = order == "horizontal" || order == "both";
    options.levels.flipped_y = order == "vertical" || order == "both";
    std::tie(options.blaze_x, options.blaze_y) = parse_blaze(blaze);
    return options;
}

std::vector<Array<std::uint16_t, 2>> PatternParameters::panel_levels(const SuitablePatterns& encoded,
                                                                     const Fields& fields) const {
    PatternOptions chosen = options();
    chosen.encoding = encoded.encoding;
    const PanelOptions added = panel();
    std::vector<Array<std::uint16_t, 2>> panels;
    for (std::size_t i = 0; i < encoded.patterns.size(); ++i)
        panels.push_back(
            hogel::panel_levels(encoded.patterns[i], chosen, added, fields[i % fields.size()]->grid().wavelength));
    return panels;
}

std::vector<std::string> PatternParameters::notes(const Fields& fields) const {
    std::vector<double> wavelengths;
    for (const auto& field : fields) wavelengths.push_back(field->grid().wavelength);
    return notes_about(modulator(), wavelengths);
}

PatternOptions PatternParameters::options() const {
    PatternOptions chosen = pattern;
    chosen.modulator = modulator();
    chosen.phase_code = parse_phase_code(code());
    if (encoding != automatic_encoding) chosen.encoding = encodings().find(encoding).encoding;
    return chosen;
}

Fields PatternParameters::at_modulator(const Fields& fields, const Progress& progress) const {
    if (distance == 0) return fields;
    if (encoding != automatic_encoding && is_one_of(encoding, {Encoding::supervised}))
        throw Error(ErrorCode::usage, "distance",
                    "supervised shows the light field at the modulator; leave it out, and move the scene by move");
    const Modulator& panel = modulator();
    Fields moved;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const FieldGrid& grid = fields[i]->grid();
        PropagateOptions propagation;
        propagation.output = Grid{panel.width,        panel.height,        grid.plane.pitch_x,
                                  grid.plane.pitch_y, grid.plane.center_x, grid.plane.center_y};
        auto field =
            std::make_shared<Field>(propagate(*fields[i], -distance, propagation, progress.part(i, fields.size())));
        field->set_provenance(fields[i]->provenance());
        moved.push_back(std::move(field));
    }
    return moved;
}

SuitablePatterns PatternParameters::encode(const Fields& fields, const Progress& progress) const {
    const PatternOptions chosen = options();
    require_panel(panel(), chosen);
    if (encoding == automatic_encoding) return encode_suitably(fields, chosen, progress);
    return {chosen.encoding, encode_patterns(fields, chosen, progress)};
}

std::size_t PatternParameters::looks() const {
    if (frames == 0 || frames > max_frames)
        throw Error(ErrorCode::usage, "frames", fmt::format("expected 1 to {}", max_frames));
    return encoding == automatic_encoding || !is_one_of(encoding, {Encoding::supervised}) ? 1 : frames;
}

SuitablePatterns PatternParameters::encode(const Fields& holograms, const LightField& light_field,
                                           const HologramRequest& request, const Progress& progress) const {
    const PatternOptions chosen = options();
    if (chosen.encoding != Encoding::supervised) return encode(holograms, progress);
    require_panel(panel(), chosen);
    std::vector<std::size_t> channels;
    for (const Channel& channel : request.channels)
        channels.push_back(request.options(channel, light_field.grids()).channel.index);
    SuitablePatterns encoded{chosen.encoding, {}};
    auto supervised = encode_supervised(holograms, light_field.front(), channels, chosen, progress);
    for (std::size_t frame = 0; frame < frames; ++frame)
        for (SupervisedPatterns& of_field : supervised) encoded.patterns.push_back(std::move(of_field.frames[frame]));
    for (const SupervisedPatterns& of_field : supervised) encoded.quality.push_back(of_field.quality);
    return encoded;
}

void PatternParameters::resolve(Encoding chosen) {
    encoding = encoding_name(chosen);
    phase_code = code();
    if (device.empty()) return;
    const Modulator found = find_modulator(device);
    device = found.name;
    if (lut.empty()) lut = found.lut;
    if (flip.empty()) flip = found.flip;
    if (correction.empty() && is_phase_only(chosen)) correction = found.correction;
}

Metadata PatternParameters::metadata(const SuitablePatterns& encoded, const Fields& fields) const {
    using Values = ExternalField::Values;
    const Modulator device_used = modulator();
    Metadata entries;
    std::vector<double> wavelengths;
    for (std::size_t c = 0; c < fields.size(); ++c) {
        wavelengths.push_back(fields[c]->grid().wavelength);
        for (auto& field_entry : pattern_entries(encoded.patterns[c], wavelengths[c], device_used, encoded.encoding))
            entries.push_back(std::move(field_entry));
        if (encoded.quality.empty()) continue;
        entries.emplace_back(
            "photographs through pupils at " + format_length(wavelengths[c]),
            fmt::format("{:.2f} dB, contrast {:.3f}", encoded.quality[c].psnr, encoded.quality[c].contrast));
    }
    ExternalField external{.pitch_x = device_used.pitch, .pitch_y = device_used.pitch};
    external.values = is_phase_only(encoded.encoding) ? Values::phase : Values::amplitude;
    external.phase_code = parse_phase_code(code());
    external.panel = panel().levels;
    external.largest = encoded.patterns[0].max_level;
    for (auto& field_entry : field_entries(external, wavelengths)) entries.push_back(std::move(field_entry));
    return entries;
}

void PatternParameters::declare(Parameters& parameters) {
    declare_pattern(parameters, *this);
    declare_modulator(parameters, *this);
    declare_panel(parameters, *this);
}

}  // namespace hogel
