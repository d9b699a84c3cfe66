// SPDX-License-Identifier: Apache-2.0
#include "fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hogel/error.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/reconstruct.h"
#include "hogel/units.h"

namespace hogel::cli {
namespace {

// Work on another program's field, whose errors then name the options that say what is missing.
template <class Work>
auto with_field_options(const FieldOptions& options, const Work& work) {
    return with_renamed_parameters({{"phase_code", std::string_view(options.code_option).substr(2)}}, work);
}

// Throws where options of other programs' fields are given for a hologram of hogel.
void refuse_options(const std::string& name, const FieldOptions& options, const Command& command) {
    for (const std::string& option :
         {std::string("--values"), options.code_option, std::string("--imaginary"), std::string("--phases"),
          std::string("--zero"), std::string("--variable"), std::string("--conjugate")})
        if (command.given(option))
            throw Error(ErrorCode::usage,
                        fmt::format("{}: is for fields of other programs; {} is a hologram", option, name));
    for (const char* option : {"--pitch", "--wavelength"})
        if (command.given(option))
            throw Error(ErrorCode::usage, fmt::format("{}: {} comes from the file itself", name, option));
}

// Whether options say what a file's numbers are.
bool are_described(const FieldOptions& options) {
    return !options.values.empty() || !options.phase_code.empty() || !options.imaginary.empty() ||
           !options.phases.empty();
}

// Lengths as messages say them.
std::string short_lengths(const std::vector<double>& lengths) {
    std::vector<std::string> texts;
    for (const double length : lengths) std::erase(texts.emplace_back(format_length(length)), ' ');
    return fmt::format("{}", fmt::join(texts, ","));
}

// Says that an option was taken where the file says something else. @param said  empty: nothing
void state_contradiction(const Session& session, const std::string& name, const std::string& option,
                         const std::string& taken, const std::string& said) {
    if (!session.command->given(option) || said.empty() || said == taken) return;
    session.say(fmt::format("{}: {} {} is taken, but the file says {}", name, option, taken, said));
}

// See state_contradiction().
void state_contradictions(const Session& session, const std::string& name, const FieldOptions& options,
                          const ExternalFacts& facts, const ExternalField& what,
                          const std::vector<double>& wavelengths) {
    if (facts.pitch_x > 0 && (facts.pitch_x != what.pitch_x || facts.pitch_y != what.pitch_y))
        state_contradiction(session, name, "--pitch", short_lengths({what.pitch_x}),
                            short_lengths(facts.pitch_x == facts.pitch_y ? std::vector{facts.pitch_x}
                                                                         : std::vector{facts.pitch_x, facts.pitch_y}));
    state_contradiction(session, name, "--wavelength", short_lengths(wavelengths), short_lengths(facts.wavelengths));
    state_contradiction(session, name, "--values", options.values, facts.values);
    if (facts.phase_code.empty() || !what.phase_code || *what.phase_code == parse_phase_code(facts.phase_code)) return;
    state_contradiction(session, name, options.code_option, options.phase_code, facts.phase_code);
}

// Sets the options that say what numbers are to what the file says where they are not given.
void complete_values(FieldOptions& options, const ExternalFacts& facts, const ExternalField& what,
                     const Command& command) {
    const bool phases = options.values.empty() || options.values == "phase";
    if (!command.given(options.code_option)) {
        if (phases && !facts.phase_code.empty())
            options.phase_code = facts.phase_code;
        else if (!command.given("--values"))
            options.values = facts.values;
    }
    // Numbers that are not whole have the zero 0 by default.
    const bool whole = facts.numbers.starts_with("whole");
    if (!what.imaginary.empty() && !whole && !command.given("--zero")) options.zero = "0";
}

// The pitch and the wavelengths of a field, from the options or else from the file.
void complete_sampling(const std::string& name, const ExternalFacts& facts, const Command& command, double& pitch,
                       std::vector<double>& wavelengths, ExternalField& what) {
    const std::string why = facts.complaint.empty() ? "" : fmt::format(": {}", facts.complaint);
    if (command.given("--pitch")) {
        what.pitch_x = what.pitch_y = pitch;
    } else if (facts.pitch_x > 0 && facts.pitch_y > 0) {
        what.pitch_x = facts.pitch_x;
        what.pitch_y = facts.pitch_y;
        pitch = facts.pitch_x == facts.pitch_y ? facts.pitch_x : 0;
    } else {
        throw Error(
            ErrorCode::usage,
            fmt::format("--pitch: is needed, because {} does not say how far its samples are apart{}", name, why));
    }
    if (!command.given("--wavelength")) {
        if (facts.wavelengths.empty())
            throw Error(
                ErrorCode::usage,
                fmt::format("--wavelength: is needed, because {} does not say of which light it is{}", name, why));
        wavelengths = facts.wavelengths;
    }
    if (wavelengths.size() != facts.colours)
        throw Error(ErrorCode::usage,
                    fmt::format("--wavelength: {} given, but {} holds {} ({})",
                                wavelengths.size() == 1 ? "one is" : fmt::format("{} are", wavelengths.size()), name,
                                facts.colours == 1 ? "one field" : fmt::format("{} fields", facts.colours),
                                facts.colours == 1 ? "one is needed" : "e.g. 638nm,520nm,450nm"));
}

OrderSelection selection_of(const FieldOptions& options, const Command& command) {
    using Which = OrderSelection::Which;
    OrderSelection selection;
    selection.without_mean = options.values == "intensity";
    if (command.given("--reference-source")) selection.reference_source = options.reference_source;
    selection.radius = options.aperture;
    if (options.order == "+1") selection.which = Which::right;
    if (options.order == "-1") selection.which = Which::left;
    const std::size_t comma = options.order.find(',');
    if (comma != std::string::npos) {
        const std::optional<double> x = parse_number(options.order.substr(0, comma)),
                                    y = parse_number(options.order.substr(comma + 1));
        if (x && y) {
            selection.which = Which::at;
            selection.frequency_x = *x;
            selection.frequency_y = *y;
            return selection;
        }
    }
    for (const char* known : {"", "0", "+1", "-1"})
        if (options.order == known) return selection;
    throw Error(
        ErrorCode::usage,
        fmt::format("--order: '{}' is none of +1, -1, 0 and FX,FY in cycles per sample, e.g. 0.25,0", options.order));
}

}  // namespace

void add_field_options(Command& command, FieldOptions& options, bool sampling, bool brief) {
    command.group(brief ? "Fields of other programs (see 'hogel help photo')" : "Fields of other programs",
                  [&options] { return options.is_external; });
    if (sampling) {
        command.positive_length("--pitch", options.pitch, "Of another program's samples")
            .default_text("what the file says")
            .acts_if([&options] { return options.pitch > 0; });  // one number says nothing of two
        command.wavelengths(options.wavelengths).default_text("what the file says");
    }
    std::string values = "What real numbers are", codes = "How numbers stand for phases";
    if (brief) {
        values += ": amplitude, phase, intensity; of pairs real-imaginary, amplitude-phase";
        codes += fmt::format(": {}, or a description", fmt::join(phase_codes().names(), ", "));
    } else {
        values +=
            ", in arrays and pictures:\namplitude, phase: phases in radians, or as whole numbers in a phase code\n"
            "intensity: light that a camera recorded; its mean is subtracted\n"
            "real-imaginary, amplitude-phase: of arrays with two numbers a sample";
        codes += ":";
        for (const PhaseCodeInfo& code : phase_codes().rows()) codes += fmt::format("\n{}: {}", code.name, code.text);
        codes += "\nany other: range=ANGLE,offset=ANGLE,invert, in deg, rad or pi (2pi)";
    }
    command.choice("--values", options.values, {"amplitude", "phase", "intensity", "real-imaginary", "amplitude-phase"},
                   "KIND", values);
    command.text(options.code_option, options.phase_code, "CODE", codes);
    command.text("--imaginary", options.imaginary, "P", "Picture of imaginary parts; the input has the real ones");
    command.text("--phases", options.phases, "P", "Picture of phases; the input has the amplitudes");
    command
        .text("--zero", options.zero, "LEVEL|median",
              "Level of 0 in pictures of real and imaginary parts; median: that of each")
        .acts_if([&options] { return !options.imaginary.empty(); });
    command.text("--variable", options.variable, "NAME", "Array of a file that has several, or two: re,im");
    command.flag("--conjugate", options.conjugate, "Its waves go as e^(+iwt)");
}

void add_reconstruction_options(Command& command, FieldOptions& options) {
    command.group("Reconstruction");
    command.text("--order", options.order, "0|+1|-1|FX,FY",
                 "Diffraction order that is the object's, cut out and moved to the middle of the spectrum:\n"
                 "+1, -1: the brightest to the right or left of frequency zero\n"
                 "FX,FY: about this frequency, cycles per sample to the right and upwards");
    command
        .number("--aperture", options.aperture, "CYCLES",
                "Radius of the opening around the order, cycles per sample (default: half its distance from 0)")
        .no_default();
    command
        .point("--reference-source", options.reference_source,
               "Source of the spherical reference wave; in front of the hologram (z > 0): where it converges")
        .no_default();
    command
        .choice("--reconstruct", options.reconstruct, {"none", "fourier", "fresnel"}, "none|fourier|fresnel",
                "What stands between the hologram and its image, which is then in the plane of depth 0:\n"
                "fourier: a lens, at its focal length --focal from both\n"
                "fresnel: the distance --focal, by one Fourier transform")
        .no_default();
    command.length("--focal", options.focal, "Focal length of that lens, or that distance").no_default();
}

bool is_external(const std::string& name, const FieldOptions& options) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(name, status)) return false;
    const bool described = are_described(options);
    // An array of four axes can be a light field or a field of several colours: who says what its numbers are means the
    // latter.
    if (!described && is_view_set(name)) return false;
    if (is_external_field(name)) return true;
    return described && file_kind(name) == FileKind::picture;
}

bool is_pattern(const std::string& name, const FieldOptions& options) {
    return !are_described(options) && is_external(name, options) && external_facts(name).format == "picture";
}

void require_described(const std::string& name, const FieldOptions& options) {
    std::error_code status;
    if (std::filesystem::is_regular_file(name, status) && file_kind(name) == FileKind::picture)
        throw Error(ErrorCode::usage,
                    fmt::format("{}: is a picture; say what its numbers are by {}, --values, --imaginary or --phases",
                                name, options.code_option));
}

ExternalField external_field(const FieldOptions& options) {
    using Values = ExternalField::Values;
    ExternalField what;
    what.values = options.values == "phase"             ? Values::phase
                  : options.values == "real-imaginary"  ? Values::real_imaginary
                  : options.values == "amplitude-phase" ? Values::amplitude_phase
                  : options.values.empty()              ? Values::complex
                                                        : Values::amplitude;
    if (!options.phase_code.empty()) {
        what.phase_code = with_field_options(options, [&] { return parse_phase_code(options.phase_code); });
        if (options.values.empty() && options.phases.empty()) what.values = Values::phase;
    }
    what.imaginary = options.imaginary;
    what.phases = options.phases;
    if (options.zero != "median") {
        what.zero = parse_number(options.zero);
        if (!what.zero)
            throw Error(ErrorCode::usage, fmt::format("--zero: '{}' is neither median nor a number", options.zero));
    }
    what.variable = options.variable;
    what.conjugate = options.conjugate;
    return what;
}

Fields open_fields(const Session& session, const std::string& name, FieldOptions& options, double& pitch,
                   std::vector<double>& wavelengths) {
    const Command& command = *session.command;
    if (!is_external(name, options)) {
        require_described(name, options);
        std::error_code status;
        if (!std::filesystem::exists(name, status))
            throw Error(ErrorCode::bad_input, fmt::format("{}: no such file", name));
        if (std::filesystem::is_regular_file(name, status) && file_kind(name) == FileKind::unknown)
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: is neither a hologram nor a field of a format that is read: .npy, .npz, .mat "
                                    "of MATLAB 5 to 7.3 (save -v7), .ohc, .exr and pictures",
                                    name));
        refuse_options(name, options, command);
        return open_hologram(name);
    }
    return with_field_options(options, [&] {
        ExternalField what = external_field(options);
        const ExternalFacts facts = external_facts(name, what);
        if (!what.variable.empty() && facts.format != "npz" && facts.format != "mat" && facts.format != "exr")
            throw Error(ErrorCode::usage, fmt::format("--variable: {} has no variables with names", name));
        options.is_external = true;
        complete_sampling(name, facts, command, pitch, wavelengths, what);
        state_contradictions(session, name, options, facts, what, wavelengths);
        complete_values(options, facts, what, command);
        Fields fields;
        for (what.colour = 0; what.colour < facts.colours; ++what.colour) {
            what.wavelength = wavelengths[what.colour];
            fields.push_back(open_external_field(name, what));
        }
        return fields;
    });
}

Fields open_and_reconstruct(const Session& session, const std::string& name, FieldOptions& options, double& pitch,
                            std::vector<double>& wavelengths) {
    const Command& command = *session.command;
    Fields fields = open_fields(session, name, options, pitch, wavelengths);
    const bool image = options.reconstruct != "none";
    if (image != command.given("--focal"))
        throw Error(ErrorCode::usage, image ? "--reconstruct: needs the focal length or distance; give --focal"
                                            : "--focal: is that of a reconstruction; give --reconstruct");
    const OrderSelection selection = selection_of(options, command);
    const bool select =
        !options.order.empty() || options.aperture != 0 || selection.without_mean || selection.reference_source;
    if (options.aperture < 0) throw Error(ErrorCode::usage, "--aperture: a positive radius was expected");
    if (!select && !image) return fields;
    Stage stage(session, "reconstruction");
    for (std::size_t c = 0; c < fields.size(); ++c) {
        if (select) {
            SelectedOrder order = select_order(*fields[c], selection, stage.progress(c, fields.size()));
            session.say(fmt::format("{}: the order at {:.4f}, {:.4f} cycles per sample, within {:.4f}",
                                    format_length(fields[c]->grid().wavelength), order.frequency_x, order.frequency_y,
                                    order.radius));
            fields[c] = std::make_shared<Field>(std::move(order.field));
        }
        if (image)
            fields[c] = with_parameter("focal", [&] {
                return std::make_shared<Field>(options.reconstruct == "fourier"
                                                   ? fourier_image(*fields[c], options.focal)
                                                   : fresnel_image(*fields[c], options.focal));
            });
    }
    return fields;
}

}  // namespace hogel::cli
